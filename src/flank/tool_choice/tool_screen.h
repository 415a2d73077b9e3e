/// What is known of a tool before a strip is grown (docs/algorithms/catalogue.md): where it reaches, where its meridian
/// suits the target to second order, and where it is also clear of obstacles.
#pragma once

#include <string>
#include <vector>

#include "flank/obstacle/pose_guard.h"
#include "flank/target.h"
#include "flank/tool.h"

namespace flank::internal {

/// Places of a target at which tools are screened; the same for every tool. Made once for each side of a target.
struct ScreenPlaces {
  std::vector<Footpoint> feet;  ///< on the target; their curvatures are what the meridian is compared with
  std::vector<double> area;     ///< mm^2, of each footpoint
  double diagonal_mm = 0.0;     ///< of the target's box
  double width_mm = 0.0;        ///< across the longest extent: the second principal extent of the footpoints
};
/// About `places` > 0 of them, spread evenly, in a fixed order.
[[nodiscard]] ScreenPlaces screen_places(const Target& target, int places);

struct ScreenOptions {
  double tolerance_mm = 0.01;  ///< > 0
  double slack = 3.0;  ///< tolerances, > 0: of the filter of directions (direction_filter.h says when to change it)
  /// Values of s, >= 1: the middles of equal pieces of the axis. Barrels suit a place with one part of their meridian
  /// only, so more of them find more; the time is proportional.
  int spheres = 9;
  /// Of the axis over half a turn, >= 0, besides the admissible ones: where a tool is free may be to the side of where
  /// it suits best. Each costs a query of the obstacles.
  int directions = 12;
};

/// Shares of the target's area, in [0, 1], each of those places that the one before it leaves: so they fall.
struct ToolScreen {
  double reachable = 0.0;  ///< a ball of the tool's smallest radius touches and enters no obstacle (MATH section 9)
  double fits = 0.0;       ///< that ball fits the hollow, but for slack * tolerance
  double accepted = 0.0;   ///< the filter accepts a direction for one of the tool's spheres
  double open = 0.0;       ///< laid along such a direction the tool enters no obstacle: about what it can cover
  double least_error_mm = 1e300;  ///< of the filter, over what is reachable; 1e300: nothing is
  double mean_error_mm = 1e300;   ///< each place with its own least error, at most kMostErrorMm
  std::string reason;             ///< why the tool cannot work, with its figure; empty if it may
};
/// mm: errors count as this at most, so that a mean over places is finite when the filter's error is not.
inline constexpr double kMostErrorMm = 10.0;

/// The screen of a tool among obstacles. Second order and samples only: a promise in neither direction, and rather too
/// kind, most of all to short tools. Costs milliseconds to a second. `places` must not be empty.
[[nodiscard]] ToolScreen screen_tool(const ScreenPlaces& places, const Tool& tool, const Obstacles& obstacles,
                                     const ScreenOptions& options);

/// The meridian alone, as if nothing were in the way: reachable is 1 and open equals accepted. Fast.
[[nodiscard]] ToolScreen screen_meridian(const ScreenPlaces& places, const RadialFunction& radial,
                                         const ScreenOptions& options);

}  // namespace flank::internal
