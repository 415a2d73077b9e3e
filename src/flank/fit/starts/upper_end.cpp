#include "flank/fit/starts/upper_end.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/clearance.h"

namespace flank::internal {
namespace {

/// Whether a rod from the upper end of a pose on is free: its axis, and lines along its rim.
bool is_free_rod(const Pose& pose, double length_mm, double rod_mm, const FlankFitOptions& options) {
  constexpr int kRim = 6;
  const Vec3 end = pose.at(length_mm);
  if (!options.is_free_line(end, pose.axis)) return false;
  const Vec3 x = pose.axis.unitOrthogonal(), y = pose.axis.cross(x);
  for (int k = 0; k < kRim && rod_mm > 0.0; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kRim;
    if (!options.is_free_line(end + rod_mm * (std::cos(angle) * x + std::sin(angle) * y), pose.axis)) return false;
  }
  return true;
}

}  // namespace

RuledMotion turned_over(const RuledMotion& motion) {
  RuledMotion over = motion;
  over.tip.poles += motion.axis_length * motion.direction.poles;
  over.direction.poles *= -1.0;
  return over;
}

double unheld_share(const RuledMotion& motion, double rod_mm, const FlankFitOptions& options) {
  constexpr int kTimes = 33;
  if (!options.is_free_line) return 0.0;
  int blocked = 0;
  for (int i = 0; i < kTimes; ++i)
    blocked += is_free_rod(motion.pose(i / (kTimes - 1.0)), motion.axis_length, rod_mm, options) ? 0 : 1;
  return static_cast<double>(blocked) / kTimes;
}

double unheld_share(const std::vector<RuledMotion>& motions, const RadialFunction& tool,
                    const FlankFitOptions& options) {
  const double rod = kRodShare * std::max(0.0, tool.at(tool.axis_length()).r);
  double largest = 0.0;
  for (const RuledMotion& motion : motions) largest = std::max(largest, unheld_share(motion, rod, options));
  return largest;
}

void hold_from_free_end(const FlankFitOptions& options, std::vector<FitTask>& tasks) {
  double upper = 0.0, lower = 0.0;
  for (const FitTask& task : tasks) {
    upper += unheld_share(task.motion, 0.0, options);
    lower += unheld_share(turned_over(task.motion), 0.0, options);
  }
  if (upper <= lower) return;
  for (FitTask& task : tasks) task.motion = turned_over(task.motion);
}

}  // namespace flank::internal
