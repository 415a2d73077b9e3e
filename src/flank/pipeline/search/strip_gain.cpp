#include "flank/pipeline/search/strip_gain.h"

#include <algorithm>

namespace flank::internal {

bool StripGain::goes_on(const FlankFitResult& best) {
  constexpr double kGain = 0.01;   // of the face: less is not worth a strip
  constexpr double kNotFar = 4.0;  // tolerances deep
  constexpr int kMostWithout = 2;
  // A flank that runs through another face can cover all of the target, and is no result that one more strip could beat.
  const auto covers = [&](const CoverageEstimate& estimate) {
    return std::max(estimate.overcut_mm, estimate.gouge_mm) <= kNotFar * tolerance_mm_ ? estimate.at_tolerance : 0.0;
  };
  const double covered = covers(best.after);
  double promised = covered;
  for (const TriedTool& tried : best.tried) promised = std::max(promised, covers(tried.estimate));
  const bool gains = covered > covered_ + kGain || promised > promised_ + kGain;
  without_gain_ = gains ? 0 : without_gain_ + 1;
  covered_ = covered;
  promised_ = std::max(promised_, promised);
  return without_gain_ < kMostWithout;
}

}  // namespace flank::internal
