/// What is said of a cavity beside its figures: where it is open, what was left and why, and which request would be met.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "flank/fit.h"
#include "flank/pipeline/cavity/cavity_search.h"
#include "flank/run.h"
#include "flank/trochoid/program.h"

namespace flank::internal {

/// Where cycles got stuck or entered a face, what they left, and at which ends the cavity is open. Of a job with a tolerance, as below.
void note_what_is_open(const TrochoidJob& job, const CavityProgram& program, std::vector<std::string>& notes);

/// Of a layer that is not done: what ended it, how far it got, and what the sides of all layers finish.
[[nodiscard]] std::string why_not_done(const TrochoidJob& job, const PlannedLayer& layer,
                                       const CoverageEstimate& sides);

/// The search reached its limit of work: said in a note, and in the reason of a layer that ended there.
void note_limit_of_work(Result& result);

/// Of a plan without cycles: what its sides do, what is required, and why there are none.
[[nodiscard]] std::string no_cycles_sentence(const TrochoidJob& job, const CoverageEstimate& sides,
                                             const WhyNoCycles& why);

/// Where coverage is what misses, and other faces keep the tool's thicker places off: so much of what it can reach with the radius
/// that it has there is covered. `reach` gives the share of both sides, as a ball of the least radius has it in the report: it is
/// slow to find, and asked only where a note may need it.
void note_own_reach(const TrochoidJob& job, const std::function<double()>& reach, Result& result);

/// Of a judged result that misses its request by coverage or depth alone: the nearest request that it meets.
void note_nearest(Result& result);

}  // namespace flank::internal
