/// The fit of a target that a motion moves into itself: a screw, a worm, a helical tooth.
#pragma once

#include <functional>

#include "flank/fit.h"
#include "flank/seed/orbit_chart.h"

namespace flank::internal {

/// The motion keeps the target within a share of the tolerance: then hardly any other does better.
[[nodiscard]] bool is_exact(const OrbitSection& section, double tolerance_mm);

/// What an orbit fit begins with: one strip a motion, of which the line at half time counts.
struct OrbitStart {
  const Target* target = nullptr;
  const ObstacleField* obstacles = nullptr;  ///< what the flank must not enter; null: nothing
  std::vector<RuledMotion> motions;
  RadialFunction tool;
  std::vector<int> free_parameters;
  std::function<bool(const SurfaceSample&)> reachable;  ///< is this place of the target to be touched?
};

struct OrbitFit {
  std::vector<RuledMotion> motions;  ///< the target's own, over as much of it as each line touches
  RadialFunction tool;
  double score = 0.0;  ///< share of the section within the tolerance, less a price for what is cut deeper
};

/// Lines and tool, changed until they cover as much of the section as they can.
[[nodiscard]] OrbitFit orbit_fit(const OrbitSection& section, const OrbitStart& start, const FlankFitOptions& options);

}  // namespace flank::internal
