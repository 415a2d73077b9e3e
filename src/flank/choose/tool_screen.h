/// What can be said of a tool before a strip is grown (docs/algorithms/catalogue.md): where it reaches, where its
/// meridian suits the target to second order, and where it stands free while it does.
#pragma once

#include <string>
#include <vector>

#include "flank/obstacle/line_guard.h"
#include "flank/target.h"
#include "flank/tool.h"

namespace flank::internal {

/// Places of a target at which tools are screened; the same for every tool.
struct ScreenPlaces {
  std::vector<Footpoint> feet;
  std::vector<double> area;  ///< mm^2, one a footpoint
  double diagonal_mm = 0.0;
  double width_mm = 0.0;  ///< across the longest extent: the second principal extent of the footpoints
};
/// About `places` of them, spread evenly.
[[nodiscard]] ScreenPlaces screen_places(const Target& target, int places);

struct ScreenOptions {
  double tolerance_mm = 0.01;
  double slack = 3.0;   ///< of the filter of directions (direction_filter.h)
  int spheres = 9;      ///< values of s
  int directions = 12;  ///< of the axis over half a turn, besides the admissible ones
};

/// Shares of the target's area, each of those places that the one before it leaves.
struct ToolScreen {
  double reachable = 0.0;  ///< a ball of the tool's smallest radius touches and enters no obstacle (MATH section 9)
  double fits = 0.0;       ///< that ball fits the hollow, but for slack * tolerance
  double accepted = 0.0;   ///< the filter accepts a direction for one of the tool's spheres
  double open = 0.0;       ///< laid along such a direction the tool enters no obstacle: about what it can cover
  double least_error_mm = 1e300;  ///< of the filter, over what is reachable; 1e300: nothing is
  double mean_error_mm = 1e300;   ///< each place with its own least error, at most kMostErrorMm
  std::string reason;             ///< why the tool cannot work, with its figure; empty where it may
};
inline constexpr double kMostErrorMm = 10.0;

/// Second order and samples only: a promise in neither direction. Costs milliseconds to a second.
[[nodiscard]] ToolScreen screen_tool(const ScreenPlaces& places, const Tool& tool, const CoverObstacles& obstacles,
                                     const ScreenOptions& options);

/// The meridian alone, as if nothing were in the way: reachable and fits are 1 and open is accepted. Fast.
[[nodiscard]] ToolScreen screen_meridian(const ScreenPlaces& places, const RadialFunction& radial,
                                         const ScreenOptions& options);

}  // namespace flank::internal
