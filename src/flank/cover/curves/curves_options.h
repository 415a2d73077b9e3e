/// What the strategy `curves` can be tuned with (curves.h); what the choices do is measured in docs/algorithms/curves.md.
#pragma once

#include <cstdint>

#include "flank/cover/curves/integral_curves.h"

namespace flank::internal {

struct CurvesOptions {
  int places = 300, spheres = 7;  ///< seeds: footpoints times values of s; paper B: 700 times 30 radii
  int steps = 16;                 ///< of an integral curve over the whole axis
  /// How far a curve may turn; paper B: kStraightnessRad. 0: as far as its line may cost `slack` tolerances,
  /// 8 sqrt(2 r slack tolerance) / L, and that at least.
  double straightness_rad = 0.0;
  bool step_by_step = false;   ///< the turn is from one step to the next (paper B (13) as printed), not from the seed
  double slack = 3.0;          ///< tolerances that lines, and strips through them, may be off before SMOOTH
  bool refine = false;         ///< REFINE each line, to one tolerance; paper B takes the lines as they are
  int clusters = 200;          ///< k
  std::uint64_t seed = 1;      ///< of the clustering
  double most_overlap = 0.05;  ///< share of a strip's area with those chosen before it; paper B's 5 percent
  double least_gain = 0.02;    ///< share of the area that a strip must add before SMOOTH, which closes smaller gaps
};

}  // namespace flank::internal
