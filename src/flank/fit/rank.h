/// What counts as good enough in a search, and which of two results is the better one. Everything that a search compares goes through
/// these two questions.
#pragma once

#include <tuple>

#include "flank/fit.h"

namespace flank::internal {

/// What a percent of the whole face is worth in slenderness, among results that meet the request: half a percent pays for one diameter of
/// length more.
inline constexpr double kSlendernessPrice = 0.005;

/// Coverage is known to one of about 2,000 samples (FlankFitOptions::sample_share): shares are compared in steps of two of them.
inline constexpr double kSameCoverage = 1e-3;

/// Enters and cuts nothing by more than the tolerance, by the planner's estimate and with what that may not have seen
/// (FitBudget::clean), with a tool that is one.
[[nodiscard]] bool is_clean(const CoverageEstimate& estimate, double tolerance_mm);

/// The motion neither plunges nor has a kink.
[[nodiscard]] bool is_steady(const CoverageEstimate& estimate);

/// No more slender than the options let a free tool be; true where no cylinder is that is as thick as they allow.
[[nodiscard]] bool is_stiff(const CoverageEstimate& estimate, const FlankFitOptions& options);

/// Covers at least this share of what is reachable, and is clean: strips more, other ways and thinner tools are for what does not.
[[nodiscard]] bool covers(const CoverageEstimate& estimate, double share, const FlankFitOptions& options);

/// The one answer to "is it good enough": covers at least this share of what is reachable, is clean, held, steady and stiff.
[[nodiscard]] bool meets(const CoverageEstimate& estimate, double share, const FlankFitOptions& options);

/// The place of a result among others, larger is better: figures in steps, compared one after the other, so that the order of three never
/// depends on which two were compared first.
struct Rank {
  bool meets = false;  ///< options.least_coverage
  bool exact = false;  ///< of what meets it: an envelope found to the last digits
  /// In kSameCoverage. Of what meets the request: the share of the whole face, less the price of slenderness. Of what does not: the share of
  /// what is reachable, less what plunging and slenderness cost; of what is not clean, not held or has a kink, less than half of its score: a clean result
  /// is given up for one that covers more than twice as much.
  long worth = 0;
  long score = 0;  ///< CoverageEstimate::score, in millionths
  friend bool operator<(const Rank& a, const Rank& b) {
    return std::tie(a.meets, a.exact, a.worth, a.score) < std::tie(b.meets, b.exact, b.worth, b.score);
  }
  friend bool operator>(const Rank& a, const Rank& b) { return b < a; }
};

/// `exact`: the motion is that of an envelope, to the last digits.
[[nodiscard]] Rank rank_of(const CoverageEstimate& estimate, const FlankFitOptions& options, bool exact = false);

[[nodiscard]] inline bool is_better(const CoverageEstimate& a, const CoverageEstimate& b,
                                    const FlankFitOptions& options) {
  return rank_of(a, options) > rank_of(b, options);
}

}  // namespace flank::internal
