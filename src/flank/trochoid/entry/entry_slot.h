/// The slot with which a layer begins inside the material: from a place beside one side of a cavity to a place beside the
/// other, and the same way at any height above it.
#pragma once

#include "flank/ruled_motion.h"

namespace flank::internal {

/// A place of the slot: `along` is 0 at the first side and 1 at the second one, and the tool is drawn back along its own axis
/// by `height_mm`, at full depth 0.
struct SlotPlace {
  double along = 0.0, height_mm = 0.0;
};

/// Tip and axis go evenly from one pose to the other, and bulge by as much as `bulge` (mm) to one side. Drawn back along its own
/// axis a tool keeps clear of walls that are straight along it.
struct EntrySlot {
  Pose from, to;
  Vec3 bulge = Vec3::Zero();
  double axis_length = 0.0;

  /// From one place to another, evenly in both numbers.
  [[nodiscard]] RuledMotion move(const SlotPlace& a, const SlotPlace& b) const;
  [[nodiscard]] Pose pose(const SlotPlace& place) const;
  /// Least way of the tip per unit of `along`, mm, at any height from 0 to `most_mm`: a rise over it is a slope no steeper.
  [[nodiscard]] double least_way(double most_mm) const;
};

}  // namespace flank::internal
