#include "flank/fit/rank.h"

#include <algorithm>
#include <cmath>

#include "flank/base/tolerance_budget.h"

namespace flank::internal {
namespace {

/// What a motion that plunges and a tool that is too slender cost, in shares of coverage: no machine runs the first well, and nobody wants
/// the second.
constexpr double kPlungingPrice = 0.02, kSlenderPrice = 0.02;

/// Of the score of what is no result as it is: it enters something, nothing holds its tool, or it has a kink; and of that where its tool is
/// none.
constexpr double kUncleanShare = 0.45, kNoToolShare = 0.65;

double worth(const CoverageEstimate& estimate, const FlankFitOptions& options) {
  const double prices =
      (estimate.largest_c < 1.0 ? 0.0 : kPlungingPrice) + (is_stiff(estimate, options) ? 0.0 : kSlenderPrice);
  const bool result = is_clean(estimate, options.tolerance_mm) && estimate.unheld <= 0.0 && estimate.turn <= 1.0;
  if (result) return estimate.at_tolerance - prices;
  const double share = estimate.legitimate ? kUncleanShare : kUncleanShare * kNoToolShare;
  return share * (estimate.score(options.tolerance_mm) - prices);
}

/// Steps of a figure; of one that is not a number, fewer than any.
long steps(double figure, double step) {
  constexpr double kMost = 1e12;
  const double steps = std::round(figure / step);
  return std::isnan(steps) ? static_cast<long>(-kMost) : static_cast<long>(std::clamp(steps, -kMost, kMost));
}

}  // namespace

bool is_clean(const CoverageEstimate& estimate, double tolerance_mm) {
  return estimate.legitimate &&
         std::max(estimate.overcut_mm, estimate.gouge_mm) <= kToleranceBudget.fit.clean * tolerance_mm;
}

bool is_steady(const CoverageEstimate& estimate) { return estimate.largest_c < 1.0 && estimate.turn <= 1.0; }

bool is_stiff(const CoverageEstimate& estimate, const FlankFitOptions& options) {
  constexpr double kRounding = 1.005;  // less is not seen in the figure that is shown
  return estimate.slenderness <= kRounding * std::max(options.bounds.slenderest, estimate.least_slenderness);
}

bool covers(const CoverageEstimate& estimate, double share, const FlankFitOptions& options) {
  return estimate.at_tolerance >= share && is_clean(estimate, options.tolerance_mm);
}

bool meets(const CoverageEstimate& estimate, double share, const FlankFitOptions& options) {
  return covers(estimate, share, options) && estimate.unheld <= 0.0 && is_steady(estimate) &&
         is_stiff(estimate, options);
}

Rank rank_of(const CoverageEstimate& estimate, const FlankFitOptions& options, bool exact) {
  constexpr double kMillionth = 1e-6;
  Rank rank;
  rank.meets = meets(estimate, options.least_coverage, options);
  rank.exact = rank.meets && exact;
  rank.worth =
      steps(rank.meets ? estimate.of_whole - kSlendernessPrice * estimate.slenderness : worth(estimate, options),
            kSameCoverage);
  rank.score = steps(estimate.score(options.tolerance_mm), kMillionth);
  return rank;
}

}  // namespace flank::internal
