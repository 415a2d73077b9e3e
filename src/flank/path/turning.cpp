#include "flank/path/turning.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "flank/path/joined_pose.h"
#include "flank/path/strip_kind.h"
#include "flank/vec.h"

namespace flank::internal {
namespace {

/// Of the window: the length of the chords that give the directions. Shorter ones would tell of a program's rounding, longer ones would
/// not see both legs of a corner.
constexpr double kChordShare = 1.0 / 32.0;
/// Chords that are shorter have no direction.
constexpr double kStillMm = 1e-7;

using Vec6 = Eigen::Matrix<double, 6, 1>;

/// Of two unit vectors, to all digits also where they are nearly alike or opposed.
double angle_between(const Vec6& a, const Vec6& b) { return 2.0 * std::atan2((a - b).norm(), (a + b).norm()); }

/// The largest angle by which a point of the axis changes its direction. What touches the face beside a point depends on the direction of its
/// velocity alone, not on its speed: where no direction jumps, nothing marks the face, however the speeds change.
double turn_of_points(const Vec6& a, const Vec6& b) {
  constexpr int kPoints = 8;
  constexpr double kStill = 1e-6;  // of the motion's own speed: a point that is as slow has no direction
  double largest = 0.0;
  for (int k = 0; k <= kPoints; ++k) {
    const double s = static_cast<double>(k) / kPoints;
    const Vec3 before = (1.0 - s) * a.head<3>() + s * a.tail<3>(), after = (1.0 - s) * b.head<3>() + s * b.tail<3>();
    if (before.norm() < kStill || after.norm() < kStill) return std::numbers::pi;
    largest = std::max(largest, std::atan2(before.cross(after).norm(), before.dot(after)));
  }
  return largest;
}

Vec6 ends_of(const Pose& pose, double axis_length) {
  Vec6 ends;
  ends << pose.tip, pose.at(axis_length);
  return ends;
}

/// A chord of the motion.
struct Chord {
  Vec6 direction;
  double at_mm = 0.0;    ///< its middle, along the way
  std::size_t pose = 0;  ///< before it ends
};

/// As many as divide the way evenly, none longer than `longest_mm`.
std::vector<Chord> chords_of(std::span<const Pose> poses, double axis_length, double longest_mm) {
  std::vector<double> ways{0.0};
  for (std::size_t i = 1; i < poses.size(); ++i)
    ways.push_back(ways.back() + (ends_of(poses[i], axis_length) - ends_of(poses[i - 1], axis_length)).norm());
  const auto count = static_cast<std::size_t>(std::ceil(ways.back() / longest_mm));
  std::vector<Chord> chords;
  if (count == 0) return chords;
  const double step = ways.back() / static_cast<double>(count);
  Vec6 from = ends_of(poses.front(), axis_length);
  for (std::size_t k = 1, i = 0; k <= count; ++k) {
    const double way = step * static_cast<double>(k);
    while (i + 2 < poses.size() && ways[i + 1] < way) ++i;
    const double t = std::clamp((way - ways[i]) / (ways[i + 1] - ways[i]), 0.0, 1.0);
    const Vec6 to = ends_of(joined_pose(poses[i], poses[i + 1], t), axis_length);
    const double length = (to - from).norm();
    if (length > kStillMm) chords.push_back({(to - from) / length, way - 0.5 * step, i});
    from = to;
  }
  return chords;
}

}  // namespace

double turn_window(double diagonal_mm) { return std::numbers::sqrt2 * kTurnStretch * diagonal_mm; }

Turning sharpest_turn(std::span<const Pose> poses, double axis_length, double window_mm) {
  const std::vector<Chord> chords = chords_of(poses, axis_length, kChordShare * window_mm);
  double least = 1.0;  // cosine of the sharpest one
  Turning sharpest;
  std::size_t first = 0;
  for (std::size_t i = 0; i < chords.size(); ++i) {
    while (chords[i].at_mm - chords[first].at_mm > window_mm) ++first;
    for (std::size_t k = first; k < i; ++k) {
      const Vec6 &from = chords[k].direction, &to = chords[i].direction;
      if (from.dot(to) >= least) continue;
      const double angle = std::min(angle_between(from, to), turn_of_points(from, to));
      if (angle <= sharpest.angle_rad) continue;
      least = std::cos(angle);
      sharpest = {angle, 0, chords[i].pose, chords[k].pose};
    }
  }
  return sharpest;
}

Turning sharpest_turn(const Path& path, double axis_length, const std::function<double(const Strip&)>& window_mm) {
  Turning sharpest;
  for (std::size_t k = 0; k < path.strips.size(); ++k) {
    if (path.strips[k].kind == kLinkKind) continue;
    Turning here = sharpest_turn(path.strips[k].poses, axis_length, window_mm(path.strips[k]));
    here.strip = k;
    if (here.angle_rad > sharpest.angle_rad) sharpest = here;
  }
  return sharpest;
}

}  // namespace flank::internal
