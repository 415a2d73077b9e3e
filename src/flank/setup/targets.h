/// From faces of a part to the targets of a fit and the samples of the judge.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "flank/judge.h"
#include "flank/obstacle_field.h"
#include "flank/part.h"
#include "flank/setup/setup.h"
#include "flank/target.h"

namespace flank::internal {

/// Faces whose borders meet are one target; faces whose borders do not, and pieces of one face, are several, to be machined with one
/// tool.
struct TargetGroup {
  std::string faces;  ///< "F1" or "F1,F2"
  std::unique_ptr<Target> target;
  std::vector<int> indices;                  ///< of these faces
  std::unique_ptr<ObstacleField> obstacles;  ///< what the flank keeps clear of; null: nothing near, or none is avoided
};

/// Machined from the side that the faces' normals point to (setup/machined_side.h); moved to that side by the allowance. Throws
/// UsageError for an allowance that leaves nothing of a face that bends towards the tool.
[[nodiscard]] std::vector<TargetGroup> make_targets(const Setup& setup);

/// Samples of the targets and of the check faces (coarser) for the judge, in the order of the part's faces.
[[nodiscard]] std::vector<FaceSamples> judge_samples(const Setup& setup, double spacing_mm, double check_spacing_mm);

}  // namespace flank::internal
