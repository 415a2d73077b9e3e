/// The line of a channel that its passes run beside: where a side stands on the floor, without what a pass cannot follow.
#pragma once

#include <vector>

#include "flank/wheel/point/floor_map.h"

namespace flank::internal {

/// The two sides of a channel together cross each place along the floor. Round the foot of a thick blade, or where samples say by a
/// tenth of a millimetre where it stands, a side's line bends more sharply than a pass may turn: passes would be cut there into
/// pieces. So the line is evened out until it does not, and the passes leave beside it what they cannot follow.
class GentleLine {
 public:
  /// Of `own`, beside `other` where it has ended; nowhere does it bend more than a circle of `radius_mm`, but where 64 mm of it
  /// evened out do not suffice.
  GentleLine(const SideLine& own, const SideLine& other, const FloorMap& map, double radius_mm);
  [[nodiscard]] double angle(double way) const;
  /// How far the line of the side itself is beside it, radians.
  [[nodiscard]] double off(double way) const;

 private:
  std::vector<double> exact_, angles_;  ///< from the floor's begin on, every quarter of a millimetre
};

}  // namespace flank::internal
