#include "flank/strip/kinks.h"

#include <algorithm>
#include <span>

#include "flank/motion/written_path.h"
#include "flank/path/turning.h"

namespace flank::internal {
namespace {

/// Of a motion as it is written.
struct Written {
  SampledMotion samples;
  double axis_length = 0.0;
  TurnLimit limit;

  Written(const RuledMotion& motion, const TurnLimit& asked, double tolerance_mm)
      : samples(sample_motion(motion, written_path(tolerance_mm))), axis_length(motion.axis_length), limit(asked) {}

  /// Of the poses from `first` to `last`; its poses count from `first`.
  [[nodiscard]] Turning turn(std::size_t first, std::size_t last) const {
    return sharpest_turn(std::span(samples.poses).subspan(first, last - first + 1), axis_length, limit.window_mm);
  }
};

void add_stretches(const Written& written, std::size_t first, std::size_t last, std::vector<TimeRange>& out) {
  const TimeRange range{written.samples.t[first], written.samples.t[last]};
  if (range.last - range.first < kShortestStretch) return;
  const Turning turn = written.turn(first, last);
  if (turn.angle_rad <= written.limit.most_rad) {
    out.push_back(range);
    return;
  }
  // Both legs lose a pose at least, so that this ends.
  add_stretches(written, first, first + turn.from_pose, out);
  add_stretches(written, std::min(last, first + turn.pose + 1), last, out);
}

}  // namespace

std::vector<TimeRange> stretches_between_kinks(const RuledMotion& motion, const TurnLimit& limit, double tolerance_mm) {
  if (limit.most_rad <= 0.0) return {{0.0, 1.0}};
  const Written written(motion, limit, tolerance_mm);
  std::vector<TimeRange> stretches;
  add_stretches(written, 0, written.samples.poses.size() - 1, stretches);
  return stretches;
}

bool has_kink(const RuledMotion& motion, const TurnLimit& limit, double tolerance_mm) {
  if (limit.most_rad <= 0.0) return false;
  const Written written(motion, limit, tolerance_mm);
  return written.turn(0, written.samples.poses.size() - 1).angle_rad > limit.most_rad;
}

}  // namespace flank::internal
