/// The candidates of a fit against each other: the most promising one gets the expensive passes first, and none gets any
/// more once one of them meets the request.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "flank/base/step_codec.h"
#include "flank/fit/polish.h"
#include "flank/progress.h"

namespace flank::internal {

/// How far a candidate has come.
enum class PassStage {
  kPolished,  ///< none of the last passes
  kFirst,     ///< the first of them, which are cheap
  kLast,      ///< all of them
};

/// A candidate on its way.
struct FitCandidate {
  FitDraft start;                     ///< as it came from its quick fit
  Polished polished;                  ///< as far as it has come
  std::vector<IterationTrace> trace;  ///< of its passes
  bool enough = false;                ///< does what was asked, looked at closely; `polished` is settled then
  PassStage stage = PassStage::kPolished;
  double gained = 0.0;                            ///< of the score, by them
  std::optional<double> failed_close_score = {};  ///< the score at which a close look found that it is not enough
  std::optional<Polished> close = {};             ///< what that look saw, if it was in this run
  std::vector<RejectedTool> beaten;               ///< of the winner: the others, as far as they have come
};

/// Among the values of a finished step (base/step_codec.h), without its start, the close look, and those that it has beaten.
void code(StepCodec& codec, FitCandidate& candidate);

/// A step of one candidate, which takes its start with it; from the journal if an earlier run has finished it
/// (base/journal.h).
void advance(FitCandidate& candidate, const Progress& progress, const char* step,
             const std::function<void(FitCandidate&)>& work);

/// The last word on a fit: overcut of a given tool taken out, and settled (swept_polish.h, polish.h).
[[nodiscard]] Polished measured_closely(const Polished& polished, const std::vector<SurfaceSample>& samples,
                                        const FlankFitOptions& options);

/// Settles the candidate if it seems to be enough, and keeps that if it still is: samples that rank see no rim that is a
/// little short. What has been called short stays so.
void settle_if_enough(FitCandidate& candidate, const std::vector<SurfaceSample>& samples,
                      const FlankFitOptions& options);

/// The last word on a candidate that is not enough, which may have been said already.
void look_closely(FitCandidate& candidate, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options);

/// The winner by its rank (rank.h).
/// `starts` is not empty and in the order of their promise; at most options.polished_candidates of them are polished,
/// finalists get the last passes. The same for any number of threads.
[[nodiscard]] FitCandidate run_finalists(const std::vector<FitDraft>& starts, const std::vector<SurfaceSample>& samples,
                                         const FlankFitOptions& options, const Progress& progress);

}  // namespace flank::internal
