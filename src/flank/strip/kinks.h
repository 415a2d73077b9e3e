/// Kinks of strips: where a motion turns more sharply than it may (path/turning.h). Asked of the poses that are written, as the judge does.
#pragma once

#include <vector>

#include "flank/ruled_motion.h"
#include "flank/strip/used_times.h"

namespace flank::internal {

/// Share of a motion's parameter range: what is left of a strip after cutting must be at least this long, else it is dropped. A shorter one is
/// hardly worth the moves to and from it.
inline constexpr double kShortestStretch = 0.1;

/// What a motion may turn by.
struct TurnLimit {
  double most_rad = 0.0;   ///< <= 0: by any angle
  double window_mm = 0.0;  ///< > 0, of the motion of both ends of the axis: within how much of its way
};

/// The stretches between the kinks of a motion, in their order: all of it if it has none. What turns, at most a window each time, is left
/// out, and so is what is shorter than kShortestStretch. `tolerance_mm`: of the path that is written.
[[nodiscard]] std::vector<TimeRange> stretches_between_kinks(const RuledMotion& motion, const TurnLimit& limit,
                                                             double tolerance_mm);

[[nodiscard]] bool has_kink(const RuledMotion& motion, const TurnLimit& limit, double tolerance_mm);

}  // namespace flank::internal
