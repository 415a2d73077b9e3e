/// What the search of one cycle hands on to the next.
#pragma once

#include <array>
#include <cstddef>

#include "flank/base/step_codec.h"
#include "flank/trochoid/cycle_guard.h"
#include "flank/trochoid/cycle_shape.h"

namespace flank::internal {

/// Of the steps that were too long, the one that engaged least; none: its engagement is 0.
struct LeastRejectedStep {
  double step_mm = 0.0, largest_rad = 0.0;
};
void code(StepCodec& codec, LeastRejectedStep& step);

/// What the next cycle is planned from.
struct CycleState {
  Trial last;
  CycleShape shape;
  /// By which the shares of the shape are changed.
  std::array<double, CycleShape::kShares> span = {0.05, 0.05, 0.08, 0.05, 0.05, 0.08, 0.05};
  std::array<int, CycleShape::kShares> rest = {};  ///< turns for which a share is left alone
  std::size_t turn = 0;
  int improved = 0;    ///< cycles whose shape was searched
  int short_rest = 0;  ///< cycles with short steps for which no other front is looked for: the last look gained nothing
  /// By which fine samples are expected to see more engagement than those of the search, radians.
  double excess_rad = 0.0;
  double step_mm = 0.0;
  double largest_front_mm3 = 0.0;
  std::size_t sweeps = 0;     ///< in the stock
  LeastRejectedStep refused;  ///< beyond the limit since the last cycle was looked for
  /// Counts a step that engages farther than the limit. A search that aims lower refuses what the limit allows.
  void refuse(double by_mm, double engaged_rad, double limit_rad) {
    if (engaged_rad > limit_rad && (refused.largest_rad == 0.0 || engaged_rad < refused.largest_rad))
      refused = {by_mm, engaged_rad};
  }
};

/// Among the values of a finished step (base/step_codec.h).
void code(StepCodec& codec, CycleState& state);

}  // namespace flank::internal
