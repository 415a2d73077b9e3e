#include "flank/fit/rank.h"

#include <algorithm>
#include <cmath>

#include "flank/base/tolerance_budget.h"

namespace flank::internal {
namespace {

/// What a motion that plunges, one with a kink, and a tool that is too slender cost, in shares of coverage: no machine runs the first two
/// well, and nobody wants the third.
constexpr double kUnsteadyPrice = 0.02, kSlenderPrice = 0.02;

/// Of the score of what is no result as it is: it enters something; and of that where its tool is none.
constexpr double kUncleanShare = 0.45, kNoToolShare = 0.65;

double worth(const CoverageEstimate& estimate, const FlankFitOptions& options) {
  const double prices =
      (is_steady(estimate, options) ? 0.0 : kUnsteadyPrice) + (is_stiff(estimate, options) ? 0.0 : kSlenderPrice);
  if (is_clean(estimate, options.tolerance_mm) && estimate.unheld <= 0.0) return estimate.at_tolerance - prices;
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

bool is_steady(const CoverageEstimate& estimate, const FlankFitOptions& options) {
  return estimate.largest_c < 1.0 && estimate.turn_rad <= options.most_turn_rad;
}

bool is_stiff(const CoverageEstimate& estimate, const FlankFitOptions& options) {
  constexpr double kRounding = 1.005;  // less is not seen in the figure that is shown
  return estimate.slenderness <= kRounding * std::max(options.bounds.slenderest, estimate.least_slenderness);
}

bool meets(const CoverageEstimate& estimate, double share, const FlankFitOptions& options) {
  return estimate.at_tolerance >= share && is_clean(estimate, options.tolerance_mm) && estimate.unheld <= 0.0 &&
         is_steady(estimate, options) && is_stiff(estimate, options);
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
