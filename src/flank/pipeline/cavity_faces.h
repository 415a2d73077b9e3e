/// The two sides of a cavity: from the faces of a job to targets whose machining sides face each other.
#pragma once

#include <string>
#include <vector>

#include "flank/setup/setup.h"
#include "flank/setup/targets.h"

namespace flank::internal {

struct CavityFaces {
  std::vector<TargetGroup> sides;  ///< left, right
  double narrowest_mm = 0.0;       ///< between them
};

/// Throws InputError, with the figure that shows it, for sides that are not two, or do not face each other.
[[nodiscard]] CavityFaces cavity_faces(const TrochoidJob& job, const Setup& setup);

}  // namespace flank::internal
