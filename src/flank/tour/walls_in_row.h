/// The walls of a chain with what lies between them, and how near a tool may come to all of it.
#pragma once

#include <optional>
#include <vector>

#include "flank/obstacle_field.h"
#include "flank/tour/straight_flank.h"
#include "flank/tour/wall.h"

namespace flank::internal {

/// What a tour does between a wall and the next.
enum class Corner {
  kNone,    ///< the chain ends
  kSmooth,  ///< goes on
  kRoll,    ///< an outer corner: turns about the edge
  kPass,    ///< an inner corner so flat that what stays in it is nothing: goes on from where it touches both
  kLeft,    ///< an inner corner: stops where it touches the next wall
};

/// The walls in the order in which a tool that climbs passes them, its tip at their feet.
struct WallsInRow {
  Chain chain;
  std::vector<Wall> walls;
  std::vector<char> too_tight;  ///< of each: bends more than the tool does
  std::vector<Corner> corners;  ///< behind each wall
  std::vector<double> turns;    ///< of each corner, rad

  [[nodiscard]] Corner before(std::size_t i) const;
  [[nodiscard]] std::size_t next(std::size_t i) const { return i + 1 < walls.size() ? i + 1 : 0; }
};

/// What a pose must keep clear of.
struct TourScene {
  const ObstacleField* obstacles = nullptr;
  double tolerance_mm = 0.01;
  double allowance_mm = 0.0;  ///< by which the flank is thicker than the tool: the obstacles know of it
};

/// `faces` must outlive it. None where a face is no wall.
[[nodiscard]] std::optional<WallsInRow> walls_in_row(const std::vector<Face>& faces, const Chain& chain);

/// Says of each wall and corner what a flank with this much of its axis over the feet can do there.
void look_at_corners(const StraightFlank& flank, double foot_s, double tolerance_mm, WallsInRow& row);

/// Does the flank, from the tip to `length` of the axis, keep out of other faces, and of the walls of the row but number `own`?
[[nodiscard]] bool is_clear(const Pose& pose, const StraightFlank& flank, double length, const WallsInRow& row,
                            std::size_t own, const TourScene& scene);
/// The same of other faces alone; the sphere of the tip stays this far off them.
[[nodiscard]] bool is_clear_of_others(const Pose& pose, const StraightFlank& flank, double length, double tip_off_mm,
                                      const TourScene& scene);

/// How far the first or the last line of wall i keeps back: nothing on edges that the tour passes; else as far as it must. None where
/// the wall has no room for the tool.
[[nodiscard]] std::optional<WallEnd> end_of_wall(const WallsInRow& row, std::size_t i, bool last,
                                                 const StraightFlank& flank, double foot_s, const TourScene& scene);

}  // namespace flank::internal
