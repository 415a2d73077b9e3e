/// A tour: walls in a row, each exactly, in one motion of a tool whose meridian is straight (docs/algorithms/tour.md).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "flank/face.h"
#include "flank/obstacle_field.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"

namespace flank::internal {

/// What a tour is asked for. Lengths in mm, in the frame of the part.
struct TourRequest {
  std::vector<Face> walls;  ///< their normals point to the machined side
  /// The tool of an axis length.
  std::function<RadialFunction(double axis_length)> tool;
  std::optional<double> axis_length_mm;      ///< none: as the walls need
  const ObstacleField* obstacles = nullptr;  ///< what the flank must not enter; null: nothing
  /// Whether a line, from a place on in a direction, is free; empty: it always is.
  std::function<bool(const Vec3& from, const Vec3& direction)> is_free_line;
  double tolerance_mm = 0.01;
  double allowance_mm = 0.0;  ///< left on the walls; of the obstacles it is part of their clearance
};

struct Tour {
  RadialFunction tool;
  std::vector<RuledMotion> motions;  ///< in the order of machining; all climb
  int levels = 1;                    ///< of walls that are higher than the tool
  bool closed = false;               ///< one motion all round
  double twist_rad = 0.0;  ///< the most that the normals of a wall turn along one of its lines; 0: all is exact
  std::vector<std::string> notes;
};

/// None where the faces are no chain of such walls, the tool's meridian bends, or nothing can be reached.
[[nodiscard]] std::optional<Tour> make_tour(const TourRequest& request);

}  // namespace flank::internal
