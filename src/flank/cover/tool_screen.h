/// What can be said of a tool before a strip is grown (docs/algorithms/catalogue.md): where it reaches, where its
/// meridian suits the target to second order, and where it stands free while it does.
#pragma once

#include <string>
#include <vector>

#include "flank/cover/line_guard.h"
#include "flank/surface/target.h"
#include "flank/tool/tool.h"

namespace flank {

/// Places of a target at which tools are screened; the same for every tool.
struct ScreenPlaces {
  std::vector<Footpoint> feet;
  std::vector<double> area;  ///< mm^2, one a footpoint
  double width_mm = 0.0;     ///< across the target's longest extent: second principal extent of the footpoints
};
[[nodiscard]] ScreenPlaces screen_places(const Target& target, int places);

struct ScreenOptions {
  double tolerance_mm = 0.01;
  double slack = 3.0;   ///< of the filter of directions (direction_filter.h)
  int spheres = 9;      ///< values of s
  int directions = 12;  ///< of the axis over half a turn, besides the admissible ones
};

/// Shares are of the target's area.
struct ToolScreen {
  double reachable = 0.0;  ///< a ball of the tool's smallest radius touches and enters no obstacle (MATH section 9)
  double fits = 0.0;       ///< reachable, and one of the tool's spheres fits the hollow
  double accepted = 0.0;   ///< and in some direction the filter's error is at most slack * tolerance
  double open = 0.0;       ///< and laid along such a direction the tool enters no obstacle: about what it can cover
  double least_error_mm = 0.0;  ///< of the filter, over the places that are reachable
  double mean_error_mm = 0.0;   ///< the same over those places, each with its own least error
  std::string reason;           ///< why the tool cannot work, with its figure; empty where it may
};

/// Error of the screen: the filter's (second order), and what lies between the directions and the places.
[[nodiscard]] ToolScreen screen_tool(const ScreenPlaces& places, const Target& target, const Tool& tool,
                                     const CoverObstacles& obstacles, const ScreenOptions& options);

/// The same without obstacles and without the search for a free direction; microseconds a place. `reachable`, `fits` and
/// `open` are left as if nothing were in the way.
[[nodiscard]] ToolScreen screen_meridian(const ScreenPlaces& places, const Target& target, const RadialFunction& radial,
                                         const ScreenOptions& options);

/// Smallest radius of the flank, mm, over 101 samples.
[[nodiscard]] double smallest_radius(const RadialFunction& radial);

}  // namespace flank
