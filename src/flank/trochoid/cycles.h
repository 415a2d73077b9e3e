/// The trochoidal cycles of one layer of a cavity: front halves as far on as the engagement allows, and back halves
/// between them (MATH section 10, docs/algorithms/trochoid.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/progress.h"
#include "flank/trochoid/cycle_search.h"

namespace flank::internal {

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
  double entered_mm = 0.0;          ///< deepest that a half enters a face, by the planner's samples
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
  LeastRejectedStep stuck;  ///< if it is stuck: of the steps that were tried, the one that exceeds the limit least
  /// No step was found at its end; also where the search was cancelled while it looked for a way past.
  bool ends_stuck = false;
  /// If it is done, but the limit is exceeded in the corners of a wall at its end: so far before it the fronts end, mm.
  double before_wall_mm = 0.0;
  /// Deepest that a half enters a face, by the planner's samples.
  [[nodiscard]] double entered_mm() const;
};

/// Among the values of a finished step (base/step_codec.h).
void code(StepCodec& codec, Cycle& cycle);
void code(StepCodec& codec, LayerCycles& layer);

/// The front that a layer begins with inside the material: an entry has opened it (entry.h).
struct FirstFront {
  double from_x = 0.0, to_x = 0.0;  ///< its ends on the side paths, mm
  RuledMotion motion;
};

/// Plans all cycles of a layer. `stock` holds what was swept before, and holds the new sweeps afterwards. Without a first
/// front one is placed before the blank, where it cuts nothing: the sides are open at their start.
[[nodiscard]] LayerCycles plan_cycles(const LayerSides& sides, const HalfGuard& guard, SweptStock& stock,
                                      const CycleOptions& options, const std::optional<FirstFront>& first,
                                      const Progress& progress);
}  // namespace flank::internal
