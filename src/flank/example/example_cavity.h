/// The free-form cavity: two facing walls given by a formula, of any size.
#pragma once

#include <vector>

#include "flank/face.h"

namespace flank::internal {

/// A channel along x, open at the top (+z), and at both ends unless one has a wall.
struct CavityShape {
  double width_mm = 35.0;   ///< across (y), of the bounding box of both walls
  double depth_mm = 42.0;   ///< along a wall, from its bottom to its top
  double length_mm = 50.0;  ///< along the channel
  double twist_deg = 16.0;  ///< of both walls about x, from one end to the other
  double lean_deg = 4.0;    ///< of a wall, outwards towards the top: deep cavities have less, or their walls meet
  /// How deep a wall is hollow between its bottom and its top, mm. A cone leaves about half of it.
  double hollow_mm = 1.0;
  bool end_wall = false;    ///< a plane across its end at +x: then it is open at the other end alone
  bool start_wall = false;  ///< the same at -x
};

/// Both walls, F1 at +y and F2 at -y, open sheets that look at each other; half a turn about z carries each into the other.
/// Every section across the channel is the same hollow profile, leaning outwards towards the top, turned by the twist and
/// shifted along an S: smooth, not ruled, and no envelope of a tool. Walls at its ends look inwards, F3 and F4, that of the end first. Throws UsageError
/// for sizes that are not > 0, a twist beyond 60 or a lean beyond 45 degrees, and walls that would meet.
[[nodiscard]] std::vector<Face> cavity_walls(const CavityShape& shape);

}  // namespace flank::internal
