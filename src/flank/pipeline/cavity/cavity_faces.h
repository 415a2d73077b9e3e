/// The two sides of a cavity: from the faces of a job to targets whose machining sides face each other.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "flank/setup/setup.h"
#include "flank/setup/targets.h"
#include "flank/trochoid/sides/side_fit.h"

namespace flank::internal {

/// Largest radius of a tool, as a share of the width of the cavity: thicker, and no cycle has room.
inline constexpr double kMostOfWidth = 0.38;

struct CavityFaces {
  std::vector<TargetGroup> sides;  ///< left, right
  CavityWidth width;               ///< between them, at first as if nothing else were there
  double ball_mm = 1e300;          ///< radius of the largest ball that the part lets touch the sides: gap, fillets
};

/// The ball that says what of the sides has to be reached, mm: the job's, else the part's, or the tool's own where that is thinner.
[[nodiscard]] inline double asked_ball(const TrochoidJob& job, const CavityFaces& faces, const RadialFunction& tool) {
  return job.judge.reach_radius_mm.value_or(std::min(faces.ball_mm, tool.smallest()));
}

[[nodiscard]] inline CavitySide side_of(const TargetGroup& group) {
  return {group.target.get(), group.obstacles.get()};
}

/// Throws InputError, with the figure that shows it, for sides that are not two, or do not face each other.
[[nodiscard]] CavityFaces cavity_faces(const TrochoidJob& job, const Setup& setup);

}  // namespace flank::internal
