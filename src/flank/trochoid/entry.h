/// How a layer of a cavity begins where no end is open, or where that is asked for: its first front is opened from above
/// (docs/algorithms/trochoid.md).
#pragma once

#include <numbers>
#include <optional>
#include <vector>

#include "flank/trochoid/cycles.h"
#include "flank/trochoid/paths/half_guard.h"
#include "flank/trochoid/paths/retract.h"
#include "flank/trochoid/paths/side_path.h"

namespace flank::internal {

enum class EntryMethod {
  kAuto,    ///< open where an end is open, else ramp
  kOpen,    ///< before the blank, where nothing is cut
  kRamp,    ///< to and fro over the first front, sinking by a slope
  kPlunge,  ///< along the tool's axis, at places along the first front
};

struct EntryOptions {
  EntryMethod method = EntryMethod::kAuto;
  double slope_rad = 3.0 * std::numbers::pi / 180.0;  ///< steepest of a ramp, > 0
};

/// Moves from above the material to the end of the first front, which is the last of them. They cut a slot: their engagement is
/// held to no limit.
struct Entry {
  EntryMethod method = EntryMethod::kRamp;
  std::vector<RuledMotion> moves;  ///< each begins where the one before ends
  FirstFront front;
  double largest_rad = 0.0, volume_mm3 = 0.0, way_mm = 0.0;
  double slope_rad = 0.0;   ///< of a ramp
  double depth_mm = 0.0;    ///< along the axis: of a pass of a ramp, of a plunge
  double width_mm = 0.0;    ///< of all plunges but the first
  double entered_mm = 0.0;  ///< deepest that it enters a face, by samples
};

/// The entry of a layer, for a method that is kRamp or kPlunge; `stock` then holds its sweeps. A slot goes straight across from
/// the start of one side to that of the other, or bulges, or begins farther on, as it takes to enter no face deeper than the
/// tolerance leaves for halves (or than the ends of the sides do themselves); moves above full depth keep off the sides as it
/// takes. Passes at full depth then widen it to a front that is tangential to both sides: the next one need not begin in a
/// corner. None if there is no such way, or if the search for one was stopped.
[[nodiscard]] std::optional<Entry> plan_entry(const LayerSides& sides, const HalfGuard& guard, SweptStock& stock,
                                              const ClearPlane& clear, const EntryOptions& options,
                                              const CycleOptions& cycles, const Progress& progress);

}  // namespace flank::internal
