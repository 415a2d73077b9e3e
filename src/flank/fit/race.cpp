#include "flank/fit/race.h"

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
#include "flank/fit/swept_polish.h"
#include "flank/fit/tried.h"

namespace flank::internal {
namespace {

/// Candidates that are polished side by side before anybody asks whether one is enough.
constexpr std::size_t kAbreast = 2;

/// An envelope, found to the last digits.
bool has_last_digits(const Runner& runner, const FlankFitOptions& options) {
  return runner.polished.exact &&
         runner.polished.estimate.overcut_mm <= exact_overcut(runner.polished.draft, options.tolerance_mm);
}

/// Stable, so that equal ones keep the order of their promise. What was looked at closely and is enough goes before all others.
void sort_by_rank(std::vector<Runner>& runners, const FlankFitOptions& options) {
  const auto place_of = [&](const Runner& runner) {
    return std::pair(runner.enough, rank_of(runner.polished.estimate, options, has_last_digits(runner, options)));
  };
  std::stable_sort(runners.begin(), runners.end(),
                   [&](const Runner& a, const Runner& b) { return place_of(a) > place_of(b); });
}

/// These starts, polished side by side.
std::vector<Runner> polished_abreast(std::span<const FitDraft> starts, const std::vector<SurfaceSample>& samples,
                                     const FlankFitOptions& options, const Progress& progress) {
  const std::vector<FitDraft> inputs(starts.begin(), starts.end());
  const auto work = [&] {
    std::vector<Runner> runners(starts.size());
    parallel_for(starts.size(), [&](std::size_t k) {
      runners[k].polished = polish(starts[k], samples, options, &runners[k].trace);
      settle_if_enough(runners[k], samples, options);
    });
    return runners;
  };
  std::vector<Runner> runners = journaled(progress, "polish", work, inputs);
  if (runners.size() != starts.size())
    throw InputError(
        "resume.json does not fit this run; start without --resume: a step has another number of candidates than there "
        "are starts");
  for (std::size_t k = 0; k < runners.size(); ++k) {
    runners[k].start = starts[k];
    tie(runners[k].polished.draft, starts[k]);
  }
  return runners;
}

double score_of(const Runner& runner, const FlankFitOptions& options) {
  return runner.polished.estimate.score(options.tolerance_mm);
}

/// The first of the last passes, cheap: they tell whether the others may lead anywhere.
void begin(Runner& runner, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options,
           const Progress& progress) {
  if (runner.begun) return;
  advance(runner, progress, "first passes", [&](Runner& next) {
    const double before = score_of(next, options);
    next.polished = first_passes(next.polished, samples, options, &next.trace);
    next.begun = true;
    next.gained = score_of(next, options) - before;
    settle_if_enough(next, samples, options);
  });
}

/// The last passes of one runner. They cost more than all before.
void pass(Runner& runner, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options,
          const Progress& progress) {
  advance(runner, progress, "last passes", [&](Runner& next) {
    // Of one that has only begun, what it gained by that counts.
    const double before = score_of(next, options) - (next.passed ? 0.0 : next.gained);
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
    Polished passed = last_passes(next.polished, samples, options, &next.trace, enough, next.begun && !next.passed);
    if (!next.enough) {
      next.polished = std::move(passed);
      settle_if_enough(next, samples, options);
    }
    next.begun = next.passed = true;
    next.gained = score_of(next, options) - before;
  });
  tell_found(progress, runner.polished.estimate, options.tolerance_mm);
}

/// The best so far, if it is all but enough, gets the last passes at once: they cost less than to polish all others. If it is
/// not, it may be after the first of them: residuals at the axis tell little of what several strips will cover.
void pass_if_near(std::vector<Runner>& runners, const std::vector<SurfaceSample>& samples,
                  const FlankFitOptions& options, const Progress& progress) {
  constexpr double kNear = 0.9;  // of the face: the last passes gain a tenth where they lead anywhere
  const auto best = std::max_element(runners.begin(), runners.end(), [&](const Runner& a, const Runner& b) {
    return score_of(a, options) < score_of(b, options);
  });
  if (best->polished.estimate.at_tolerance < kNear) begin(*best, samples, options, progress);
  if (!best->enough && best->polished.estimate.at_tolerance >= kNear) pass(*best, samples, options, progress);
}

std::vector<Runner> polish_until_enough(const std::vector<FitDraft>& starts, const std::vector<SurfaceSample>& samples,
                                        const FlankFitOptions& options, const Progress& progress) {
  const std::size_t most = std::min(starts.size(), static_cast<std::size_t>(options.kept_after_quick));
  std::vector<Runner> runners;
  const auto any_enough = [&] {
    return std::any_of(runners.begin(), runners.end(), [](const Runner& runner) { return runner.enough; });
  };
  while (runners.size() < most && !any_enough()) {
    // The user has had enough: the best start alone is still worth a polish, so that there is a result.
    if (progress.stop() && !runners.empty()) break;
    const std::size_t first = runners.size(), count = progress.stop() ? 1 : std::min(kAbreast, most - first);
    for (Runner& runner : polished_abreast(std::span(starts).subspan(first, count), samples, options, progress)) {
      tell_found(progress, runner.polished.estimate, options.tolerance_mm);
      runners.push_back(std::move(runner));
    }
    progress.step("polish", 0.5 + 0.2 * static_cast<double>(runners.size()) / static_cast<double>(most));
    const bool passed = std::any_of(runners.begin(), runners.end(), [](const Runner& r) { return r.passed; });
    if (!passed && !any_enough() && !progress.stop()) pass_if_near(runners, samples, options, progress);
  }
  return runners;
}

/// Runners of which the best covers less than what the caller calls hopeless: the first of the last passes tell whether it is.
void look_for_hope(std::vector<Runner>& runners, const std::vector<SurfaceSample>& samples,
                   const FlankFitOptions& options, const Progress& progress) {
  const std::size_t most = std::min(runners.size(), static_cast<std::size_t>(options.kept_after_polish));
  for (std::size_t k = 0; k < most && !progress.stop(); ++k) begin(runners[k], samples, options, progress);
  sort_by_rank(runners, options);
}

/// Hopeless fits are left without the last passes if the caller says what is hopeless.
void pass_until_enough(std::vector<Runner>& runners, const std::vector<SurfaceSample>& samples,
                       const FlankFitOptions& options, const Progress& progress) {
  const double least = options.least_coverage_for_last_passes;
  if (runners.front().polished.estimate.at_tolerance < least) look_for_hope(runners, samples, options, progress);
  if (runners.front().enough || runners.front().polished.estimate.at_tolerance < least) return;
  const auto score = [&](const Runner& runner) { return score_of(runner, options); };
  /// Who is behind by more than this many times what the passes gained so far, and this share of coverage, cannot win.
  constexpr double kGains = 2.0, kBehind = 0.02;
  double best = -1.0, gained = 0.0;
  const std::size_t most = std::min(runners.size(), static_cast<std::size_t>(options.kept_after_polish));
  for (std::size_t k = 0; k < most; ++k) {
    Runner& runner = runners[k];
    const bool behind = score(runner) + kGains * gained + kBehind < best;
    if (k > 0 && (progress.stop() || behind)) continue;
    if (!runner.passed) pass(runner, samples, options, progress);
    if (runner.enough) return;
    gained = std::max(gained, runner.gained);
    best = std::max(best, score(runner));
    progress.step("polish", 0.7 + 0.2 * static_cast<double>(k + 1) / static_cast<double>(most));
  }
}

/// Passes once more, as long as they gain, of a fit that covers all but a little: a strip more would cost several times as much.
void pass_again(Runner& runner, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options,
                const Progress& progress) {
  constexpr double kLittle = 0.02;  // of the face
  constexpr double kGains = 0.2;    // of what is missing: three more such passes halve it
  constexpr int kMost = 3;
  if (runner.gained <= 0.0) return;
  const auto missing = [&] { return options.enough_coverage - runner.polished.estimate.at_tolerance; };
  const auto goes_on = [&] { return !runner.enough && runner.passed && !progress.stop(); };
  for (int k = 0; k < kMost && goes_on() && missing() > 0.0 && missing() <= kLittle; ++k) {
    const double before = missing();
    pass(runner, samples, options, progress);
    if (missing() > (1.0 - kGains) * before) return;
  }
  if (!goes_on() || missing() > 0.0) return;
  // What is covered and short otherwise, as by plunging, is led out of that by one pass, or by none.
  Runner again = runner;
  pass(again, samples, options, progress);
  if (again.enough) runner = std::move(again);
}

/// The runners behind the first.
std::vector<TriedTool> beaten_by_first(const std::vector<Runner>& runners, const RadiusBounds& bounds) {
  std::vector<TriedTool> beaten;
  for (std::size_t k = 1; k < runners.size(); ++k) {
    const Polished& polished = runners[k].polished;
    beaten.push_back(tried_tool(polished.draft.tool, polished.draft.motions.size(), polished.estimate, bounds));
  }
  return beaten;
}

/// The winner, taken to the last digits where its target seems to be an envelope; as it was where that gains nothing.
Runner with_last_digits(const Runner& winner, const std::vector<SurfaceSample>& samples,
                        const FlankFitOptions& options) {
  if (has_last_digits(winner, options)) return winner;
  Runner exact = winner;
  exact.polished = last_digits(winner.polished, samples, options, &exact.trace);
  if (!exact.polished.exact) return winner;
  exact.enough = false;
  settle_if_enough(exact, samples, options);
  // A given tool was lifted out of all overcut, at the price of what a lift leaves everywhere: a few digits of it are worth more.
  const FitDraft& draft = winner.polished.draft;
  const double none = draft.free_tool ? 0.0 : kDigitsShare * draft.targets.front()->diagonal();
  const bool deeper = exact.polished.estimate.overcut_mm > std::max(winner.polished.estimate.overcut_mm, none);
  return deeper || (winner.enough && !exact.enough) ? winner : exact;
}

}  // namespace

void code(StepCodec& codec, Runner& runner) {
  code(codec, runner.polished);
  code(codec, runner.trace);
  code(codec, runner.enough);
  code(codec, runner.passed);
  codec.number(runner.gained);
  code(codec, runner.begun);
  codec.number(runner.called_short);
}

void advance(Runner& runner, const Progress& progress, const char* step, const std::function<void(Runner&)>& work) {
  const auto advanced = [&] {
    Runner next = runner;
    work(next);
    return next;
  };
  Runner next = journaled(progress, step, advanced, runner);
  tie(next.polished.draft, runner.start);
  next.start = std::move(runner.start);
  runner = std::move(next);
}

Polished looked_at_closely(const Polished& polished, const std::vector<SurfaceSample>& samples,
                           const FlankFitOptions& options) {
  return settled(without_overcut(polished, samples, options), options);
}

void settle_if_enough(Runner& runner, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options) {
  const double score = runner.polished.estimate.score(options.tolerance_mm);
  if (!meets(runner.polished.estimate, options.enough_coverage, options) || score == runner.called_short) return;
  Polished close = looked_at_closely(runner.polished, samples, options);
  runner.enough = meets(close.estimate, options.enough_coverage, options);
  close.exact = runner.polished.exact;
  if (runner.enough) {
    runner.polished = std::move(close);
  } else {
    runner.called_short = score;
    runner.close = std::move(close);
  }
}

void look_closely(Runner& runner, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options) {
  const bool known = runner.close && score_of(runner, options) == runner.called_short;
  runner.polished = known ? *runner.close : looked_at_closely(runner.polished, samples, options);
}

Runner race(const std::vector<FitDraft>& starts, const std::vector<SurfaceSample>& samples,
            const FlankFitOptions& options, const Progress& progress) {
  FLANK_ASSERT(!starts.empty() && options.kept_after_quick >= 1 && options.kept_after_polish >= 1);
  std::vector<Runner> runners = polish_until_enough(starts, samples, options, progress);
  sort_by_rank(runners, options);
  if (!runners.front().enough) {
    pass_until_enough(runners, samples, options, progress);
    sort_by_rank(runners, options);
  }
  Runner winner = std::move(runners.front());
  pass_again(winner, samples, options, progress);
  if (!winner.enough)
    advance(winner, progress, "partial passes", [&](Runner& next) {
      next.polished = partial_polish(next.polished, samples, options, &next.trace);
      settle_if_enough(next, samples, options);
    });
  advance(winner, progress, "last digits", [&](Runner& next) { next = with_last_digits(next, samples, options); });
  winner.beaten = beaten_by_first(runners, options.bounds);
  return winner;
}

}  // namespace flank::internal
