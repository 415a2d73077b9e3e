#include "flank/pipeline/search/strip_gain.h"

#include <algorithm>

namespace flank::internal {

bool StripGain::goes_on(const FlankFitResult& best) {
  constexpr double kGain = 0.01, kGainOfRest = 0.25;  // of the face, or of what is missing: less is not worth a strip
  constexpr double kNotFar = 4.0;                     // tolerances deep
  /// Where little is missing a number of strips that is no better says little of the next one.
  constexpr double kNearlyAll = 0.9;
  constexpr int kMostWithout = 2, kMostWithoutNear = 4;
  // A flank that runs through another face can cover all of the target, and is no result that one more strip could beat.
  const auto covers = [&](const CoverageEstimate& estimate) {
    const bool near = std::max(estimate.overcut_mm, estimate.gouge_mm) <= kNotFar * tolerance_mm_;
    return near && estimate.unheld <= 0.0 ? estimate.at_tolerance : 0.0;
  };
  const double covered = covers(best.after);
  double promised = covered;
  for (const RejectedTool& rejected : best.rejected) promised = std::max(promised, covers(rejected.estimate));
  const auto gains_on = [&](double now, double before) {
    return now > before + std::min(kGain, kGainOfRest * (1.0 - before));
  };
  const bool gains = gains_on(covered, covered_) || gains_on(promised, promised_);
  without_gain_ = gains ? 0 : without_gain_ + 1;
  covered_ = covered;
  promised_ = std::max(promised_, promised);
  const int most = covered >= kNearlyAll ? kMostWithoutNear : kMostWithout;
  // What has covered nothing yet, because it runs through other faces, tells nothing of what facets leave.
  const bool all_there_is = covered >= wanted_ || (facets_limit_ && promised_ > 0.0);
  return without_gain_ < (all_there_is ? 1 : most);
}

}  // namespace flank::internal
