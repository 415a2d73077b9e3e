#include "flank/wheel/blade_copies.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "flank/base/parallel.h"
#include "flank/wheel/point/tip_room.h"

namespace flank::internal {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

constexpr int kSpheres = 16, kRounds = 3;
constexpr double kNearMm = 3.0;      ///< from a sphere to a side: farther ones say nothing
constexpr double kContactMm = 0.15;  ///< a sphere so far off counts half
constexpr double kDamping = 1e-3;    ///< of motions that no distance asks for
constexpr double kArmMm = 10.0;      ///< a turn counts as the way at such a radius
constexpr int kMeanPoses = 5;        ///< to either side
constexpr double kSampleMm = 1.0;

/// What a pose is moved by: a shift, and a small turn about the middle of its axis.
using Move = Vec6;

Pose moved(const Pose& pose, const Move& move, double length) {
  const Vec3 turn = move.tail<3>(), pivot = pose.at(0.5 * length);
  const double angle = turn.norm();
  Vec3 axis = pose.axis;
  if (angle > 0.0) axis = Eigen::AngleAxisd(angle, turn / angle) * axis;
  const Vec3 middle = pivot + move.head<3>();
  return {middle - 0.5 * length * axis, axis.normalized()};
}

struct Wanted {
  double s = 0.0, distance = 0.0, weight = 0.0;
  const std::vector<const Target*>* from = nullptr;
};

/// The distances that a pose has on its own side, and over the floor.
std::vector<Wanted> wanted_of(const Pose& pose, const RadialFunction& radial, const std::vector<const Target*>& side,
                              const std::vector<const Target*>& other, const std::vector<const Target*>& floor) {
  std::vector<Wanted> out;
  for (int k = 0; k < kSpheres; ++k) {
    const double s = radial.axis_length() * k / (kSpheres - 1.0), r = radial.at(s).r;
    const Footpoint foot = nearest_foot(side, pose.at(s), r + kNearMm);
    if (foot.patch < 0 || foot.location != Location::kInside) continue;
    const double off = std::max(0.0, foot.distance - r) / kContactMm;
    out.push_back({s, foot.distance, 1.0 / (1.0 + off * off), &other});
  }
  const double tip = radial.at(0.0).r;
  const Footpoint foot = nearest_foot(floor, pose.tip, tip + kNearMm);
  if (foot.patch >= 0 && foot.location == Location::kInside) {
    const double off = std::max(0.0, foot.distance - tip) / kContactMm;
    out.push_back({0.0, foot.distance, 1.0 / (1.0 + off * off), &floor});
  }
  return out;
}

/// The least motion that gives the pose the distances; none where it is near nothing.
std::optional<Move> move_of(const Pose& pose, const std::vector<Wanted>& wanted, const RadialFunction& radial) {
  Move sum = Move::Zero();
  double found = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    const Pose here = moved(pose, sum, radial.axis_length());
    const Vec3 pivot = here.at(0.5 * radial.axis_length());
    Mat6 left = Mat6::Zero();
    Vec6 right = Vec6::Zero();
    found = 0.0;
    for (const Wanted& w : wanted) {
      const Vec3 center = here.at(w.s);
      const Footpoint foot = nearest_foot(*w.from, center, radial.at(w.s).r + 2.0 * kNearMm);
      if (foot.patch < 0 || foot.location != Location::kInside) continue;
      Vec6 row;
      row << foot.normal, (center - pivot).cross(foot.normal);
      left += w.weight * row * row.transpose();
      right += w.weight * (w.distance - foot.distance) * row;
      found += w.weight;
    }
    for (int i = 0; i < 6; ++i) left(i, i) += kDamping * (i < 3 ? 1.0 : kArmMm * kArmMm);
    sum += left.ldlt().solve(right);
  }
  return found > 0.3 ? std::optional(sum) : std::nullopt;
}

/// Poses that are near nothing move as their neighbours; and all as the mean of a few.
std::vector<Move> evened_out(const std::vector<std::optional<Move>>& found) {
  const int count = static_cast<int>(found.size());
  std::vector<Move> full(found.size(), Move::Zero()), out = full;
  for (int k = 0; k < count; ++k)
    for (int off = 0; off < count; ++off) {
      const int before = k - off, after = k + off;
      if (before >= 0 && found[static_cast<std::size_t>(before)]) {
        full[static_cast<std::size_t>(k)] = *found[static_cast<std::size_t>(before)];
        break;
      }
      if (after < count && found[static_cast<std::size_t>(after)]) {
        full[static_cast<std::size_t>(k)] = *found[static_cast<std::size_t>(after)];
        break;
      }
    }
  for (int k = 0; k < count; ++k) {
    const int low = std::max(0, k - kMeanPoses), high = std::min(count - 1, k + kMeanPoses);
    Move sum = Move::Zero();
    for (int n = low; n <= high; ++n) sum += full[static_cast<std::size_t>(n)];
    out[static_cast<std::size_t>(k)] = sum / (high - low + 1.0);
  }
  return out;
}

}  // namespace

double side_difference(const std::vector<const Target*>& side, const std::vector<const Target*>& other,
                       const WheelAxis& axis, double radians) {
  const Eigen::Isometry3d turn = axis.turn(radians);
  double most = 0.0;
  for (const Target* target : side)
    for (const SurfaceSample& s : target->samples(kSampleMm)) {
      const Footpoint foot = nearest_foot(other, turn * s.point, kNearMm);
      if (foot.patch >= 0 && foot.location == Location::kInside) most = std::max(most, std::abs(foot.distance));
    }
  return most;
}

Strip carried_over(const Strip& strip, const RadialFunction& radial, const std::vector<const Target*>& side,
                   const std::vector<const Target*>& other, const std::vector<const Target*>& floor,
                   const WheelAxis& axis, double radians) {
  const Eigen::Isometry3d turn = axis.turn(radians);
  Strip out = strip;
  std::vector<std::optional<Move>> found(strip.poses.size());
  parallel_for(strip.poses.size(), [&](std::size_t k) {
    const Pose& pose = strip.poses[k];
    out.poses[k] = {turn * pose.tip, (turn.linear() * pose.axis).normalized()};
    found[k] = move_of(out.poses[k], wanted_of(pose, radial, side, other, floor), radial);
  });
  const std::vector<Move> moves = evened_out(found);
  for (std::size_t k = 0; k < moves.size(); ++k) out.poses[k] = moved(out.poses[k], moves[k], radial.axis_length());
  return out;
}

}  // namespace flank::internal
