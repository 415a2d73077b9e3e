#include "flank/fit/starts/upper_end.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/tool.h"

namespace flank::internal {
namespace {

/// Whether a rod from a place of the axis on is free: its axis, and lines along its rim.
bool is_free_rod(const Pose& pose, double from_mm, double rod_mm, const FlankFitOptions& options) {
  constexpr int kRim = 6;
  const Vec3 end = pose.at(from_mm);
  if (!options.is_free_line(end, pose.axis)) return false;
  const Vec3 x = pose.axis.unitOrthogonal(), y = pose.axis.cross(x);
  for (int k = 0; k < kRim && rod_mm > 0.0; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kRim;
    if (!options.is_free_line(end + rod_mm * (std::cos(angle) * x + std::sin(angle) * y), pose.axis)) return false;
  }
  return true;
}

/// Share of the times at which a rod from there on runs into something.
double blocked_share(const RuledMotion& motion, double from_mm, double rod_mm, const FlankFitOptions& options) {
  constexpr int kTimes = 65;
  if (!options.is_free_line) return 0.0;
  int blocked = 0;
  for (int i = 0; i < kTimes; ++i)
    blocked += is_free_rod(motion.pose(i / (kTimes - 1.0)), from_mm, rod_mm, options) ? 0 : 1;
  return static_cast<double>(blocked) / kTimes;
}

}  // namespace

RuledMotion turned_over(const RuledMotion& motion) {
  RuledMotion over = motion;
  over.tip.poles += motion.axis_length * motion.direction.poles;
  over.direction.poles *= -1.0;
  return over;
}

double unheld_share(const RuledMotion& motion, const FlankFitOptions& options) {
  return blocked_share(motion, motion.axis_length, options.bounds.shank_in_the_way ? options.bounds.shank_radius : 0.0,
                       options);
}

double unheld_share(const std::vector<RuledMotion>& motions, const RadialFunction& tool,
                    const FlankFitOptions& options) {
  // Where the flank ends, as the judge has it, which is not beside the end of the axis where the flank is steep.
  const Vec2 top = meridian_point(tool, tool.axis_length());
  double largest = 0.0;
  for (const RuledMotion& motion : motions)
    largest = std::max(largest, blocked_share(motion, top.x(), kRodShare * std::max(0.0, top.y()), options));
  return largest;
}

void hold_from_free_end(const FlankFitOptions& options, std::vector<FitTask>& tasks) {
  double upper = 0.0, lower = 0.0;
  for (const FitTask& task : tasks) {
    upper += unheld_share(task.motion, options);
    lower += unheld_share(turned_over(task.motion), options);
  }
  if (upper <= lower) return;
  for (FitTask& task : tasks) task.motion = turned_over(task.motion);
}

}  // namespace flank::internal
