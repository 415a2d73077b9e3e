/// What the strategy `curves` is tuned with (curves.h).
#pragma once

#include <cstdint>

#include "flank/cover/integral_curves.h"

namespace flank {

struct CurvesOptions {
  int places = 300, spheres = 7;  ///< seeds: footpoints, values of s; paper B: 700 and 30 radii
  int steps = 16;                 ///< of an integral curve over the whole axis
  double straightness_rad = 0.0;  ///< paper B: kStraightnessRad
  bool step_by_step = false;      ///< straightness between successive steps (paper B (13)), not from the seed
  double slack = 3.0;      ///< tolerances that lines, and the strips through them, may be off before they are smoothed
  bool refine = false;     ///< REFINE each line to one tolerance; paper B takes the lines as they are
  int clusters = 200;      ///< k of the clustering
  std::uint64_t seed = 1;  ///< of the clustering
  double most_overlap = 0.05;  ///< of a strip's area with those chosen before it; paper B's 5 percent
  double least_gain = 0.02;    ///< share of the area that a strip must add before SMOOTH, which closes smaller gaps
};

}  // namespace flank
