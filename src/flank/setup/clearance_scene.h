/// What shank, holder and flank must keep clear of, read and triangulated once for any number of looks.
#pragma once

#include <string>
#include <vector>

#include "flank/clearance.h"
#include "flank/setup/setup.h"

namespace flank::internal {

struct ClearanceScene {
  std::vector<Obstacle> obstacles;  ///< faces of the part, then fixtures
  ClearanceOptions options;
};

/// Triangulates the fixtures and, if the tool has a body above its flank, the part's targets and check
/// faces; no other faces count. `notes` gets what was done to fixtures and what is inaccurate.
[[nodiscard]] ClearanceScene make_clearance_scene(const Setup& setup, const ObstacleRequest& request, bool has_body,
                                                  std::vector<std::string>& notes);

/// Judges shank, holder and fixtures; an empty report if there is nothing to judge.
[[nodiscard]] ClearanceReport measure_clearance(const ClearanceScene& scene, const Tool& tool, const Path& path);

}  // namespace flank::internal
