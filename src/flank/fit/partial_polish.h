/// What the last passes (swept_polish.h) leave: a face of which one strip cannot do all, and places that are cut too deep.
#pragma once

#include <vector>

#include "flank/fit/polished.h"

namespace flank::internal {

/// Of a fit that cannot do all that is asked: passes that give up what is beyond the tolerance, so that it no longer pulls at
/// what is within, and that hold overcut firmly, which would have to be taken back by radii that cost coverage everywhere.
/// Each is kept only if it scores better. Returns its argument where all but nothing is missing, and where too little is
/// covered to be worth it.
[[nodiscard]] Polished partial_polish(const Polished& polished, const std::vector<SurfaceSample>& samples,
                                      const FlankFitOptions& options, std::vector<IterationTrace>* trace);

/// One more pass of a draft that cuts deeper than allowed at `deep`, places of the target that no pass has seen (the
/// passes see 2,500 points, a last look many more): they join the points. A free tool's bounds are asked at its knots,
/// too. `firmness` >= 1: weight of what other faces are entered by, in that of other passes; above 1 every sample asks for
/// them. `covered`: the share that the draft covers; if that is not nearly all, the pass gives up what is beyond the
/// tolerance. `steadiness` >= 1: weight of what plunges and of what lags, in that of other passes. Not assessed: by which
/// samples it is measured is for the caller to say.
[[nodiscard]] FitDraft pass_at(const FitDraft& draft, const std::vector<Vec3>& deep, const FlankFitOptions& options,
                               double firmness, double covered, double steadiness = 1.0);

}  // namespace flank::internal
