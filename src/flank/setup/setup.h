/// A part with the faces that are machined and those that must not be entered: what every command begins with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/job.h"
#include "flank/judge.h"
#include "flank/part.h"

namespace flank::internal {

struct Setup {
  Part part;                 ///< the targets' normals point to the side that is machined
  std::vector<int> targets;  ///< indices of faces
  std::vector<int> checks;   ///< of the faces that must not be entered, ascending
  double tolerance_mm = 0.01;
  std::vector<Part> fixtures;
  std::vector<int> unread = {};  ///< faces that are in the file and could not be read, but for those ignored by name
  std::vector<SheetSide> sides = {};  ///< of the targets that bound no material
};

/// Reads the part, finds its faces, and reads the fixtures. Without a tolerance the targets get their default_tolerance. `notes` gets what
/// was repaired, which faces are not checked, and that tolerance. Throws UsageError and InputError.
[[nodiscard]] Setup read_setup(const PartRequest& part, const ObstacleRequest& obstacles,
                               std::optional<double> tolerance_mm, std::vector<std::string>& notes);

}  // namespace flank::internal
