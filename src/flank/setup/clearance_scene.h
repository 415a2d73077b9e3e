/// What shank, holder and flank must keep clear of, read once, and triangulated where something comes near, for any number of looks.
#pragma once

#include <string>
#include <vector>

#include "flank/clearance.h"
#include "flank/judge.h"
#include "flank/setup/setup.h"

namespace flank::internal {

struct ClearanceScene {
  ObstacleSet obstacles;  ///< faces of the part, then fixtures
  /// The part's faces alone and coarsely, in milliseconds: for what needs not be known to a hundredth of a millimetre, as whether anything stands in a line.
  ObstacleSet sight;
  ClearanceOptions options;
  bool has_body =
      false;  ///< shank or holder are measured; else the part's faces are there for what might hold the tool alone
};

/// The fixtures and the part's targets and check faces, to be triangulated coarsely if the tool has no body above its flank; no other faces
/// count. `notes` gets what was done to fixtures.
[[nodiscard]] ClearanceScene make_clearance_scene(const Setup& setup, const ObstacleRequest& request, bool has_body,
                                                  std::vector<std::string>& notes);

/// Judges shank, holder and fixtures, and whether anything could hold the tool: fills `clearance` and `hold`.
void measure_bodies(const ClearanceScene& scene, const Tool& tool, const Path& path, VerifyReport& report);

/// What is inexact about the obstacles that its clearances are about.
void add_caveats(const VerifyReport& report, std::vector<std::string>& notes);

/// Judges shank, holder and fixtures alone; an empty report if there is nothing to judge.
[[nodiscard]] ClearanceReport measure_clearance(const ClearanceScene& scene, const Tool& tool, const Path& path);

/// Whether all of them are kept, and shanks keep `shank_least_mm` besides; yes if there is nothing to judge. Ends at the first that is not.
[[nodiscard]] bool keeps_clear(const ClearanceScene& scene, const Tool& tool, const Path& path,
                               double shank_least_mm = -1e300);

}  // namespace flank::internal
