/// Passes of a tool's tip sphere over the floor of a channel (docs/MATH.md, section 14): point contact.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "flank/path.h"
#include "flank/radial_function.h"
#include "flank/target.h"

namespace flank::internal {

/// A channel between two sides that have paths of their own; nothing is owned.
struct FloorChannel {
  std::vector<const Target*> floor;
  std::vector<const Target*> sides;  ///< both, and their edges: what the flank keeps out of
  std::vector<Pose> first, second;   ///< paths of the two sides, with this tool
  /// Where a tip counts as, to find the places that are across from each other: in a wheel along the axis and away from it. Empty: where
  /// it is.
  std::function<Vec3(const Vec3&)> place = {};
};

struct FloorOptions {
  double tolerance_mm = 0.05;
  double scallop_share = 0.5;  ///< of the tolerance, that scallops take; the rest is for chords and the tip's height
  double clearance_mm = 0.0;   ///< of the flank from the sides; < 0: it may enter by so much
};

/// Strips of kind "floor", from the first side to the second; each other one the other way round. Poses lie between the sides'
/// paths, paired by the nearest `place` on the first one's: direction on the great circle, tip on the floor's offset by the tip's
/// radius. No pose is nearer to a side than the clearance: it moves to the middle instead, and where no place across is free it is
/// left out. Empty where the paths do not run beside each other.
[[nodiscard]] std::vector<Strip> floor_passes(const FloorChannel& channel, const RadialFunction& radial,
                                              const FloorOptions& options, const std::string& face);

}  // namespace flank::internal
