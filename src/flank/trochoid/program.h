/// What is planned of a cavity: layers of cycles, finishing sweeps along both sides, entries and links, as one path.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/path.h"
#include "flank/trochoid/cycles.h"
#include "flank/trochoid/entry.h"

namespace flank::internal {

struct ProgramOptions {
  CycleOptions cycles;
  EntryOptions entry;
  bool below_stuck = true;                ///< plan the layers below one whose cycles get stuck, as far as it got
  bool climb = true;                      ///< else conventional; the spindle turns clockwise seen from the holder
  double chord_mm = 1e-3;                 ///< of the joined poses
  std::string left = "F1", right = "F2";  ///< names for the strips
};

/// A layer as it was planned.
struct PlannedLayer {
  std::optional<Entry> entry;  ///< none: open, before the blank, or there is no way in
  bool no_way_in = false;      ///< no entry is free: there are no cycles
  LayerCycles cycles;
  double first_side_rad = 0.0, second_side_rad = 0.0;  ///< largest engagement of the finishing sweeps, in their order
  double sides_mm = 0.0, links_mm = 0.0;
  double side_volume_mm3 = 0.0;
  /// Of the first side's way, cleared by the cycles and finished. Below 1: they did not get through.
  double share = 1.0;
  /// Where the cycles ended: the least angle between the way of a side and the axis there.
  double off_axis_rad = 1.5707963267948966;
  /// Deepest that the entry or a half enters a face, by the planner's samples.
  [[nodiscard]] double entered_mm() const;
  /// Cycles go forward across the axis: they got stuck where the sides lead along it, so that less than half of a step goes across.
  /// The walls say how the axis stands, whatever the tool's radius.
  [[nodiscard]] bool stuck_along_axis() const;
  /// Fronts came from outside of the blank and got stuck before they ended anywhere on the first side.
  [[nodiscard]] bool stuck_before_sides() const;
};

struct CavityProgram {
  Path path;
  std::vector<PlannedLayer> layers;
  std::vector<HalfSpace> blank;
  double chord_bound_mm = 0.0;
  /// The side paths begin, or end, at a wall.
  bool walled_start = false, walled_end = false;
  [[nodiscard]] bool done() const;
  /// Whether that is so in a layer.
  [[nodiscard]] bool stuck_along_axis() const;
  /// Whether that is so in all layers: none has begun on the sides.
  [[nodiscard]] bool stuck_before_sides() const;
  /// Deepest that an entry or a half enters a face, by the planner's samples.
  [[nodiscard]] double entered_mm() const;
};

}  // namespace flank::internal
