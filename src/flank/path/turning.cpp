#include "flank/path/turning.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "flank/vec.h"

namespace flank::internal {
namespace {

/// Steps that are shorter have no direction.
constexpr double kStillMm = 1e-7;

using Vec6 = Eigen::Matrix<double, 6, 1>;

/// Of two unit vectors, to all digits also where they are nearly alike or opposed.
double angle_between(const Vec6& a, const Vec6& b) { return 2.0 * std::atan2((a - b).norm(), (a + b).norm()); }

/// One step of the motion.
struct Step {
  Vec6 direction;
  double at_mm = 0.0;    ///< its middle, along the way
  std::size_t pose = 0;  ///< that it begins at
};

std::vector<Step> steps_of(std::span<const Pose> poses, double axis_length) {
  std::vector<Step> steps;
  double way = 0.0;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    Vec6 step;
    step << poses[i + 1].tip - poses[i].tip, poses[i + 1].at(axis_length) - poses[i].at(axis_length);
    const double length = step.norm();
    if (length > kStillMm) steps.push_back({step / length, way + 0.5 * length, i});
    way += length;
  }
  return steps;
}

}  // namespace

double turn_window(double diagonal_mm) { return std::numbers::sqrt2 * kTurnStretch * diagonal_mm; }

Turning sharpest_turn(std::span<const Pose> poses, double axis_length, double window_mm) {
  const std::vector<Step> steps = steps_of(poses, axis_length);
  double least = 1.0;  // cosine
  Turning sharpest;
  std::size_t first = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    while (steps[i].at_mm - steps[first].at_mm > window_mm) ++first;
    for (std::size_t k = first; k < i; ++k) {
      const double cosine = steps[i].direction.dot(steps[k].direction);
      if (cosine >= least) continue;
      least = cosine;
      sharpest = {angle_between(steps[i].direction, steps[k].direction), 0, steps[i].pose};
    }
  }
  return sharpest;
}

Turning sharpest_turn(const Path& path, double axis_length, double window_mm) {
  Turning sharpest;
  for (std::size_t k = 0; k < path.strips.size(); ++k) {
    Turning here = sharpest_turn(path.strips[k].poses, axis_length, window_mm);
    here.strip = k;
    if (here.angle_rad > sharpest.angle_rad) sharpest = here;
  }
  return sharpest;
}

}  // namespace flank::internal
