/// What no tool whose radii are large enough does better on a face, however many passes it takes (docs/algorithms/bound.md).
#pragma once

#include <vector>

#include "flank/limit/least_error.h"
#include "flank/progress.h"
#include "flank/target.h"

namespace flank::internal {

struct BallBoundOptions {
  double radius_mm = 1.0;      ///< no radius of the tool is smaller
  double tolerance_mm = 0.01;  ///< for the area that is out of reach
  double spacing_mm = 1.0;     ///< of the first net of sites; the next ones are twice as fine
  double gap = 0.05;           ///< a finer net that can only raise the bound by this share is not laid
  int levels = 8;              ///< nets, at most
  int cubes = 20000;           ///< of centres, for each site, at most (BallSearch)
};

struct BallBound {
  double bound_mm = 0.0;  ///< every tool leaves or cuts at least this much somewhere
  double found_mm = 0.0;  ///< at the same site a ball does this
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ(), centre = Vec3::Zero();  ///< the site, and that ball
  double area_mm2 = 0.0, out_of_reach_mm2 = 0.0;  ///< of all sites of the first net; of those that no tool finishes
  int sites = 0;
  bool complete = true;  ///< false: stopped early; what was proved holds
};

/// `scene` holds the face itself, too. Parallel; the same bits for any number of threads.
[[nodiscard]] BallBound ball_bound(const Target& face, const BallScene& scene, const BallBoundOptions& options,
                                   const Progress& progress);

}  // namespace flank::internal
