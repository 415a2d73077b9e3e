/// What a pass of the fit changes from step to step.
#pragma once

#include <vector>

#include "flank/envelope/swept_estimate.h"
#include "flank/obstacle_field.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"
#include "flank/target.h"

namespace flank::internal {

/// The distance from a point of the axis to the obstacles, kept between steps: a place nearby is as far from them,
/// less how far it is from `at`.
struct ObstacleSample {
  ObstacleDistance nearest;  ///< here, by its gradient where that is good enough
  double measured_mm = 0.0;  ///< the distance where it was measured
  Vec3 at = Vec3::Zero();    ///< that place, mm
  bool known = false;        ///< false: never measured
};

/// Everything that changes during a fit. Footpoints, obstacles and contacts are caches of the last `locate`: they are
/// hints for the next one, and wrong for anything else once motions or tool have changed.
struct FitState {
  std::vector<RuledMotion> motions;                    ///< control points are the unknowns
  RadialFunction tool;                                 ///< its free parameters are the others
  std::vector<std::vector<Footpoint>> feet;            ///< of a FitModel: [motion][i * samples_s + j]
  std::vector<std::vector<ObstacleSample>> obstacles;  ///< [motion][i * samples_s + j]; empty without obstacles
  std::vector<SweptContact> contacts;                  ///< of a SweptModel: of each of its points
};

}  // namespace flank::internal
