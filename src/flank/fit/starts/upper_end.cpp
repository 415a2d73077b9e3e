#include "flank/fit/starts/upper_end.h"

#include <algorithm>

namespace flank::internal {

RuledMotion turned_over(const RuledMotion& motion) {
  RuledMotion over = motion;
  over.tip.poles += motion.axis_length * motion.direction.poles;
  over.direction.poles *= -1.0;
  return over;
}

double unheld_share(const RuledMotion& motion, const FlankFitOptions& options) {
  constexpr int kTimes = 33;
  if (!options.is_free_line) return 0.0;
  int blocked = 0;
  for (int i = 0; i < kTimes; ++i) {
    const Pose pose = motion.pose(i / (kTimes - 1.0));
    blocked += options.is_free_line(pose.at(motion.axis_length), pose.axis) ? 0 : 1;
  }
  return static_cast<double>(blocked) / kTimes;
}

double unheld_share(const std::vector<RuledMotion>& motions, const FlankFitOptions& options) {
  double largest = 0.0;
  for (const RuledMotion& motion : motions) largest = std::max(largest, unheld_share(motion, options));
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
