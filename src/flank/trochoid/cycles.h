/// The trochoidal cycles of one layer of a cavity: front halves as far on as the engagement allows, and back halves
/// between them (MATH section 10, docs/algorithms/trochoid.md).
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "flank/progress.h"
#include "flank/trochoid/engagement/engagement.h"
#include "flank/trochoid/half_guard.h"
#include "flank/trochoid/side_path.h"

namespace flank::internal {

struct CycleOptions {
  double largest_rad = 1.0471975511965976;  ///< engagement, fronts and backs
  double tolerance_mm = 0.01;
  bool optimise = true;  ///< shapes of the halves, cycle by cycle; else the first shapes are kept
  int most_cycles = 400;
  /// Ends of fronts on the first side go no farther than this share of its way: above, the layer before got stuck.
  double most_share = std::numeric_limits<double>::infinity();
};

/// Both side paths of a layer in the direction of the feed. Fronts go from `from` to `to`.
struct LayerSides {
  SidePath from, to;
};

/// A half path that was planned, and what it takes.
struct Half {
  RuledMotion motion;
  Engagement engagement;  ///< at the fine rows
  EngagementPeak peak;    ///< refined
  double way_mm = 0.0;
};

/// A back half from the last front's end, then the front; the first cycle has no back half.
struct Cycle {
  std::optional<Half> back;
  Half front;
  double from_x = 0.0, to_x = 0.0;  ///< of the front's ends on the side paths, mm
};

enum class CycleStatus {
  kDone,   ///< nothing is left in the way of the fronts
  kStuck,  ///< no step is possible within the limit
  kShort,  ///< at the end of what the layer above has cleared
  kCancelled,
};

struct LayerCycles {
  CycleStatus status = CycleStatus::kDone;
  std::vector<Cycle> cycles;
  double stuck_step_mm = 0.0;  ///< the step at which the limit is exceeded, if it is stuck
  double entered_mm = 0.0;     ///< deepest that a half enters a face, by the planner's samples
};

/// Plans all cycles of a layer. `stock` holds what was swept before, and holds the new sweeps afterwards. The first front
/// is placed before the blank, where it cuts nothing: the sides are open at their start.
[[nodiscard]] LayerCycles plan_cycles(const LayerSides& sides, const HalfGuard& guard, SweptStock& stock,
                                      const CycleOptions& options, const Progress& progress);

/// Poses a half path has in a stock: a multiple of its knot spans.
inline constexpr int kHalfIntervals = 48;

}  // namespace flank::internal
