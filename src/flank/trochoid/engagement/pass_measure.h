/// A pass of the tool that several motions make, one after the other, like a finishing sweep with its run-outs.
#pragma once

#include <vector>

#include "flank/trochoid/engagement/swept_stock.h"

namespace flank::internal {

struct PassMeasure {
  double largest_rad = 0.0;  ///< engagement, refined
  double volume_mm3 = 0.0;
};

/// Measures a pass, whose motions are then in the stock. `sweep_intervals`: of each (Sweep::of).
[[nodiscard]] PassMeasure measure_pass(const std::vector<RuledMotion>& motions, int sweep_intervals, SweptStock& stock);

/// Largest engagement of poses that are joined straight, radians; what the way itself takes is not counted as taken, and the stock
/// stays as it is.
[[nodiscard]] double largest_engagement(const std::vector<Pose>& way, const SweptStock& stock);

}  // namespace flank::internal
