#include "flank/fit/finalists.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "flank/base/assert.h"
#include "flank/base/journal.h"
#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/fit/coverage.h"
#include "flank/fit/fit_record.h"
#include "flank/fit/partial_polish.h"
#include "flank/fit/rank.h"
#include "flank/fit/rejected.h"
#include "flank/fit/swept_polish.h"

namespace flank::internal {
namespace {

/// Candidates that are polished side by side before anybody asks whether one is enough.
constexpr std::size_t kAbreast = 2;

/// An envelope, found to the last digits.
bool has_final_fit(const FitCandidate& candidate, const FlankFitOptions& options) {
  return candidate.polished.exact &&
         candidate.polished.estimate.overcut_mm <= exact_overcut(candidate.polished.draft, options.tolerance_mm);
}

/// Stable, so that equal ones keep the order of their promise. What was looked at closely and is enough goes before all others.
void sort_by_rank(std::vector<FitCandidate>& candidates, const FlankFitOptions& options) {
  const auto place_of = [&](const FitCandidate& candidate) {
    return std::pair(candidate.enough,
                     rank_of(candidate.polished.estimate, options, has_final_fit(candidate, options)));
  };
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](const FitCandidate& a, const FitCandidate& b) { return place_of(a) > place_of(b); });
}

/// These starts, polished side by side.
std::vector<FitCandidate> polished_abreast(std::span<const FitDraft> starts, const std::vector<SurfaceSample>& samples,
                                           const FlankFitOptions& options, const Progress& progress) {
  const std::vector<FitDraft> inputs(starts.begin(), starts.end());
  const auto work = [&] {
    std::vector<FitCandidate> candidates(starts.size());
    parallel_for(starts.size(), [&](std::size_t k) {
      candidates[k].polished = polish(starts[k], samples, options, &candidates[k].trace);
      settle_if_enough(candidates[k], samples, options);
    });
    return candidates;
  };
  std::vector<FitCandidate> candidates = journaled(progress, "polish", work, inputs);
  if (candidates.size() != starts.size())
    throw InputError(
        "resume.json does not fit this run; start without --resume: a step has another number of candidates than there "
        "are starts");
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    candidates[k].start = starts[k];
    reattach_targets(candidates[k].polished.draft, starts[k]);
  }
  return candidates;
}

double score_of(const FitCandidate& candidate, const FlankFitOptions& options) {
  return candidate.polished.estimate.score(options.tolerance_mm);
}

/// The first of the last passes, cheap: they tell whether the others may lead anywhere.
void begin(FitCandidate& candidate, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options,
           const Progress& progress) {
  if (candidate.stage != PassStage::kPolished) return;
  advance(candidate, progress, "coarse fit", [&](FitCandidate& next) {
    const double before = score_of(next, options);
    next.polished = first_passes(next.polished, samples, options, &next.trace);
    next.stage = PassStage::kFirst;
    next.gained = score_of(next, options) - before;
    settle_if_enough(next, samples, options);
  });
}

/// The last passes of one candidate. They cost more than all before.
void pass(FitCandidate& candidate, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options,
          const Progress& progress) {
  advance(candidate, progress, "fine fit", [&](FitCandidate& next) {
    // Of one that has only begun, what it gained by that counts.
    const double before = score_of(next, options) - (next.stage == PassStage::kLast ? 0.0 : next.gained);
    // Once: a close look costs as much as a pass, and what it has called short is mostly short after the next as well.
    bool looked = false;
    const auto enough = [&](const Polished& polished) {
      if (looked || !polished.draft.free_tool || !meets(polished.estimate, options.enough_coverage, options))
        return false;
      looked = true;
      next.polished = polished;
      settle_if_enough(next, samples, options);
      return next.enough;
    };
    Polished passed =
        last_passes(next.polished, samples, options, &next.trace, enough, next.stage == PassStage::kFirst);
    if (!next.enough) {
      next.polished = std::move(passed);
      settle_if_enough(next, samples, options);
    }
    next.stage = PassStage::kLast;
    next.gained = score_of(next, options) - before;
  });
  tell_found(progress, candidate.polished.estimate, options.tolerance_mm);
}

/// The best so far, if it is all but enough, gets the last passes at once: they cost less than to polish all others. If it is
/// not, it may be after the first of them: residuals at the axis tell little of what several strips will cover.
void pass_if_near(std::vector<FitCandidate>& candidates, const std::vector<SurfaceSample>& samples,
                  const FlankFitOptions& options, const Progress& progress) {
  constexpr double kNear = 0.9;  // of the face: the last passes gain a tenth where they lead anywhere
  const auto best = std::max_element(
      candidates.begin(), candidates.end(),
      [&](const FitCandidate& a, const FitCandidate& b) { return score_of(a, options) < score_of(b, options); });
  if (best->polished.estimate.at_tolerance < kNear) begin(*best, samples, options, progress);
  if (!best->enough && best->polished.estimate.at_tolerance >= kNear) pass(*best, samples, options, progress);
}

std::vector<FitCandidate> polish_until_enough(const std::vector<FitDraft>& starts,
                                              const std::vector<SurfaceSample>& samples, const FlankFitOptions& options,
                                              const Progress& progress) {
  const std::size_t most = std::min(starts.size(), static_cast<std::size_t>(options.polished_candidates));
  std::vector<FitCandidate> candidates;
  const auto any_enough = [&] {
    return std::any_of(candidates.begin(), candidates.end(),
                       [](const FitCandidate& candidate) { return candidate.enough; });
  };
  while (candidates.size() < most && !any_enough()) {
    // The user has had enough: the best start alone is still worth a polish, so that there is a result.
    if (progress.stop() && !candidates.empty()) break;
    const std::size_t first = candidates.size(), count = progress.stop() ? 1 : std::min(kAbreast, most - first);
    for (FitCandidate& candidate :
         polished_abreast(std::span(starts).subspan(first, count), samples, options, progress)) {
      tell_found(progress, candidate.polished.estimate, options.tolerance_mm);
      candidates.push_back(std::move(candidate));
    }
    progress.step("polish", 0.5 + 0.2 * static_cast<double>(candidates.size()) / static_cast<double>(most));
    const bool passed = std::any_of(candidates.begin(), candidates.end(),
                                    [](const FitCandidate& r) { return r.stage == PassStage::kLast; });
    if (!passed && !any_enough() && !progress.stop()) pass_if_near(candidates, samples, options, progress);
  }
  return candidates;
}

/// Runners of which the best covers less than what the caller calls hopeless: the first of the last passes tell whether it is.
void look_for_hope(std::vector<FitCandidate>& candidates, const std::vector<SurfaceSample>& samples,
                   const FlankFitOptions& options, const Progress& progress) {
  const std::size_t most = std::min(candidates.size(), static_cast<std::size_t>(options.finalists));
  for (std::size_t k = 0; k < most && !progress.stop(); ++k) begin(candidates[k], samples, options, progress);
  sort_by_rank(candidates, options);
}

/// Hopeless fits are left without the last passes if the caller says what is hopeless.
void pass_until_enough(std::vector<FitCandidate>& candidates, const std::vector<SurfaceSample>& samples,
                       const FlankFitOptions& options, const Progress& progress) {
  const double least = options.least_coverage_for_last_passes;
  if (candidates.front().polished.estimate.at_tolerance < least) look_for_hope(candidates, samples, options, progress);
  if (candidates.front().enough || candidates.front().polished.estimate.at_tolerance < least) return;
  const auto score = [&](const FitCandidate& candidate) { return score_of(candidate, options); };
  /// Who is behind by more than this many times what the passes gained so far, and this share of coverage, cannot win.
  constexpr double kGains = 2.0, kBehind = 0.02;
  double best = -1.0, gained = 0.0;
  const std::size_t most = std::min(candidates.size(), static_cast<std::size_t>(options.finalists));
  for (std::size_t k = 0; k < most; ++k) {
    FitCandidate& candidate = candidates[k];
    const bool behind = score(candidate) + kGains * gained + kBehind < best;
    if (k > 0 && (progress.stop() || behind)) continue;
    if (candidate.stage != PassStage::kLast) pass(candidate, samples, options, progress);
    if (candidate.enough) return;
    gained = std::max(gained, candidate.gained);
    best = std::max(best, score(candidate));
    progress.step("polish", 0.7 + 0.2 * static_cast<double>(k + 1) / static_cast<double>(most));
  }
}

/// Passes once more, as long as they gain, of a fit that covers all but a little: a strip more would cost several times as much.
void pass_again(FitCandidate& candidate, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options,
                const Progress& progress) {
  constexpr double kLittle = 0.02;  // of the face
  constexpr double kGains = 0.2;    // of what is missing: three more such passes halve it
  constexpr int kMost = 3;
  if (candidate.gained <= 0.0) return;
  const auto missing = [&] { return options.enough_coverage - candidate.polished.estimate.at_tolerance; };
  const auto goes_on = [&] { return !candidate.enough && candidate.stage == PassStage::kLast && !progress.stop(); };
  for (int k = 0; k < kMost && goes_on() && missing() > 0.0 && missing() <= kLittle; ++k) {
    const double before = missing();
    pass(candidate, samples, options, progress);
    if (missing() > (1.0 - kGains) * before) return;
  }
  if (!goes_on() || missing() > 0.0) return;
  // What is covered and short otherwise, as by plunging, is led out of that by one pass, or by none.
  FitCandidate again = candidate;
  pass(again, samples, options, progress);
  if (again.enough) candidate = std::move(again);
}

/// The candidates behind the first.
std::vector<RejectedTool> beaten_by_first(const std::vector<FitCandidate>& candidates, const RadiusBounds& bounds) {
  std::vector<RejectedTool> beaten;
  for (std::size_t k = 1; k < candidates.size(); ++k) {
    const Polished& polished = candidates[k].polished;
    beaten.push_back(rejected_tool(polished.draft.tool, polished.draft.motions.size(), polished.estimate, bounds));
  }
  return beaten;
}

/// The winner, taken to the last digits where its target seems to be an envelope; as it was where that gains nothing.
FitCandidate with_final_fit(const FitCandidate& winner, const std::vector<SurfaceSample>& samples,
                            const FlankFitOptions& options) {
  if (has_final_fit(winner, options)) return winner;
  FitCandidate exact = winner;
  exact.polished = refine_exact_envelope(winner.polished, samples, options, &exact.trace);
  if (!exact.polished.exact) return winner;
  exact.enough = false;
  settle_if_enough(exact, samples, options);
  // A given tool was lifted out of all overcut, at the price of what a lift leaves everywhere: a few digits of it are worth more.
  const double may = exact_overcut(winner.polished.draft, options.tolerance_mm);
  const bool deeper = exact.polished.estimate.overcut_mm > std::max(winner.polished.estimate.overcut_mm, may);
  return deeper || (winner.enough && !exact.enough) ? winner : exact;
}

}  // namespace

void code(StepCodec& codec, FitCandidate& candidate) {
  code(codec, candidate.polished);
  code(codec, candidate.trace);
  code(codec, candidate.enough);
  code_choice(codec, candidate.stage, static_cast<int>(PassStage::kLast) + 1);
  codec.number(candidate.gained);
  code(codec, candidate.failed_close_score);
}

void advance(FitCandidate& candidate, const Progress& progress, const char* step,
             const std::function<void(FitCandidate&)>& work) {
  const auto advanced = [&] {
    FitCandidate next = candidate;
    work(next);
    return next;
  };
  FitCandidate next = journaled(progress, step, advanced, candidate);
  reattach_targets(next.polished.draft, candidate.start);
  next.start = std::move(candidate.start);
  candidate = std::move(next);
}

Polished measured_closely(const Polished& polished, const std::vector<SurfaceSample>& samples,
                          const FlankFitOptions& options) {
  return repair_closely(without_overcut(polished, samples, options), options);
}

void settle_if_enough(FitCandidate& candidate, const std::vector<SurfaceSample>& samples,
                      const FlankFitOptions& options) {
  const double score = candidate.polished.estimate.score(options.tolerance_mm);
  if (!meets(candidate.polished.estimate, options.enough_coverage, options) || score == candidate.failed_close_score)
    return;
  Polished close = measured_closely(candidate.polished, samples, options);
  candidate.enough = meets(close.estimate, options.enough_coverage, options);
  close.exact = candidate.polished.exact;
  if (candidate.enough) {
    candidate.polished = std::move(close);
  } else {
    candidate.failed_close_score = score;
    candidate.close = std::move(close);
  }
}

void look_closely(FitCandidate& candidate, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options) {
  const bool known = candidate.close && score_of(candidate, options) == candidate.failed_close_score;
  candidate.polished = known ? *candidate.close : measured_closely(candidate.polished, samples, options);
}

FitCandidate run_finalists(const std::vector<FitDraft>& starts, const std::vector<SurfaceSample>& samples,
                           const FlankFitOptions& options, const Progress& progress) {
  FLANK_ASSERT(!starts.empty() && options.polished_candidates >= 1 && options.finalists >= 1);
  std::vector<FitCandidate> candidates = polish_until_enough(starts, samples, options, progress);
  sort_by_rank(candidates, options);
  if (!candidates.front().enough) {
    pass_until_enough(candidates, samples, options, progress);
    sort_by_rank(candidates, options);
  }
  FitCandidate winner = std::move(candidates.front());
  pass_again(winner, samples, options, progress);
  if (!winner.enough)
    advance(winner, progress, "partial fit", [&](FitCandidate& next) {
      next.polished = partial_polish(next.polished, samples, options, &next.trace);
      settle_if_enough(next, samples, options);
    });
  advance(winner, progress, "final fit", [&](FitCandidate& next) { next = with_final_fit(next, samples, options); });
  winner.beaten = beaten_by_first(candidates, options.bounds);
  return winner;
}

}  // namespace flank::internal
