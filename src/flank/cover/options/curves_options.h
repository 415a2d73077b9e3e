/// What the strategy `curves` can be tuned with (curves.h); what the choices do is measured in
/// docs/algorithms/curves.md.
#pragma once

#include <cstdint>

namespace flank::internal {

struct CurvesOptions {
  /// Seeds: footpoints times values of s, both >= 1. Paper B takes 700 times 30 radii; ten times as many seeds cost
  /// twice the time and showed no gain.
  int places = 300, spheres = 7;
  int steps = 16;  ///< of an integral curve over the whole axis, >= 2 (IntegralCurveOptions::steps)
  /// How far a curve may turn; paper B: kStraightnessRad. 0: as far as its line may cost `slack` tolerances,
  /// 8 sqrt(2 r slack tolerance) / L, and that at least.
  double straightness_rad = 0.0;
  bool step_by_step = false;  ///< the turn is from one step to the next (paper B (13) as printed), not from the seed
  /// Tolerances that lines, and strips through them, may be off before SMOOTH, >= 1. With 1 there are too few lines at
  /// fine tolerances (14 % covered instead of 69 % on a blade at 0.02 mm).
  double slack = 3.0;
  /// REFINE each line, to one tolerance; paper B takes the lines as they are. Gives more before SMOOTH; after it the
  /// difference is mostly within the scatter.
  bool refine = false;
  int clusters = 200;      ///< k, >= 1; both 100 and 400 covered less at fine tolerances
  std::uint64_t seed = 1;  ///< of the clustering; it decides over ten percent of a difficult face, so try several
  /// Share of a strip's area in [0, 1] that may be covered by those chosen before it; paper B's 5 percent.
  double most_overlap = 0.05;
  /// Share of the area in [0, 1] that a strip must add before SMOOTH, which closes smaller gaps. Lower it for more
  /// coverage with more strips; 0.04 missed a third of a face.
  double least_gain = 0.02;
};

}  // namespace flank::internal
