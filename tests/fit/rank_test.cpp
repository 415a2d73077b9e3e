// The one answer to "is it good enough", and the one order of results: transitive, whatever the figures are.
#include "flank/fit/rank.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

constexpr double kTolerance = 0.05;

FlankFitOptions asking(double share = 0.99) {
  FlankFitOptions options;
  options.tolerance_mm = kTolerance;
  options.least_coverage = share;
  options.bounds.slenderest = 8.0;
  return options;
}

CoverageEstimate covering(double share, double gouge_mm = 0.0, double overcut_mm = 0.0) {
  CoverageEstimate estimate;
  estimate.at_tolerance = estimate.at_four_tolerances = estimate.of_whole = share;
  estimate.gouge_mm = gouge_mm;
  estimate.overcut_mm = overcut_mm;
  return estimate;
}

TEST(Meets, EachFigureAloneIsANo) {
  const FlankFitOptions options = asking();
  EXPECT_TRUE(meets(covering(0.99), 0.99, options));
  EXPECT_FALSE(meets(covering(0.9899), 0.99, options));
  EXPECT_FALSE(meets(covering(1.0, 0.06), 0.99, options));
  EXPECT_FALSE(meets(covering(1.0, 0.0, 0.06), 0.99, options));
  const auto no = [&](auto&& spoil) {
    CoverageEstimate estimate = covering(1.0);
    spoil(estimate);
    return !meets(estimate, 0.99, options);
  };
  EXPECT_TRUE(no([](CoverageEstimate& e) { e.largest_c = 1.0; }));
  EXPECT_TRUE(no([](CoverageEstimate& e) { e.turn = 1.03; }));
  EXPECT_TRUE(no([](CoverageEstimate& e) { e.legitimate = false; }));
  EXPECT_TRUE(no([](CoverageEstimate& e) { e.slenderness = 9.0; }));
  EXPECT_TRUE(no([](CoverageEstimate& e) { e.at_tolerance = std::numeric_limits<double>::quiet_NaN(); }));
  CoverageEstimate thickest = covering(1.0);
  thickest.slenderness = thickest.least_slenderness = 9.0;
  EXPECT_TRUE(meets(thickest, 0.99, options)) << "as thick as the bounds allow";
}

TEST(IsBetter, WhatEntersNothingGoesFirstUnlessItCoversNextToNothing) {
  const FlankFitOptions options = asking();
  EXPECT_TRUE(is_better(covering(0.6), covering(1.0, 0.5), options));
  EXPECT_FALSE(is_better(covering(1.0, 0.5), covering(0.6), options));
  EXPECT_TRUE(is_better(covering(0.999, 0.44), covering(0.007), options));
  EXPECT_FALSE(is_better(covering(0.007), covering(0.999, 0.44), options));
  EXPECT_TRUE(is_better(covering(0.98), covering(0.97), options));
  EXPECT_FALSE(is_better(covering(0.97), covering(0.98), options));
  EXPECT_TRUE(is_better(covering(0.9), covering(1.0, 0.0, 0.2), options)) << "overcut is no price for coverage";
}

TEST(IsBetter, PlungingCostsTwoPercent) {
  const FlankFitOptions options = asking();
  CoverageEstimate plunging = covering(0.99);
  plunging.largest_c = 1.5;
  EXPECT_TRUE(is_better(covering(0.98), plunging, options));
  EXPECT_FALSE(is_better(covering(0.96), plunging, options));
}

TEST(IsBetter, AKinkIsNoResultThatMoreThanHalfOfTheFaceWouldNotBeat) {
  const FlankFitOptions options = asking();
  CoverageEstimate kinked = covering(0.99);
  kinked.turn = 4.0;
  EXPECT_TRUE(is_better(covering(0.6), kinked, options));
  EXPECT_FALSE(is_better(covering(0.3), kinked, options));
}

TEST(IsBetter, WhatIsNoToolGoesLast) {
  const FlankFitOptions options = asking();
  CoverageEstimate none = covering(1.0);
  none.legitimate = false;
  EXPECT_FALSE(is_clean(none, kTolerance));
  EXPECT_TRUE(is_better(covering(0.6), none, options));
  EXPECT_TRUE(is_better(covering(0.9, 0.5), none, options)) << "even one that enters a face can be made";
  EXPECT_FALSE(is_better(none, covering(0.6), options));
  EXPECT_TRUE(is_better(none, covering(0.3), options));
  EXPECT_FALSE(is_better(covering(0.3), none, options));
}

TEST(IsBetter, OfWhatMeetsTheRequestTheWholeFaceCountsBeforeStiffnessUpToItsPrice) {
  const FlankFitOptions options = asking();
  CoverageEstimate more = covering(0.995), stiffer = covering(0.995);
  more.slenderness = 5.0;
  stiffer.slenderness = 4.0;
  more.of_whole = 0.99;
  stiffer.of_whole = 0.97;
  EXPECT_TRUE(is_better(more, stiffer, options)) << "2 % of the face for one diameter";
  stiffer.of_whole = 0.988;
  EXPECT_TRUE(is_better(stiffer, more, options)) << "0.2 % of the face for one diameter";
  EXPECT_TRUE(is_better(stiffer, covering(0.98), options)) << "which does not meet it";
}

TEST(Rank, AnExactEnvelopeGoesFirstAmongThoseThatMeetAndOnlyThere) {
  const FlankFitOptions options = asking();
  CoverageEstimate slender = covering(1.0);
  slender.slenderness = 7.0;
  EXPECT_GT(rank_of(slender, options, true), rank_of(covering(1.0), options));
  EXPECT_LT(rank_of(covering(0.9), options, true), rank_of(covering(0.95), options));
}

TEST(Rank, IsTransitiveForAnyFigures) {
  const FlankFitOptions options = asking();
  Random random(7);
  std::vector<CoverageEstimate> all;
  for (int k = 0; k < 60; ++k) {
    CoverageEstimate e = covering(random.uniform(0.95, 1.0), random.uniform(0.0, 0.07), random.uniform(0.0, 0.07));
    e.of_whole = e.at_tolerance * random.uniform(0.9, 1.0);
    e.largest_c = random.uniform(0.0, 1.2);
    e.turn = random.uniform(0.0, 1.5);
    e.slenderness = random.uniform(1.0, 9.0);
    e.legitimate = random.uniform(0.0, 1.0) < 0.9;
    all.push_back(e);
  }
  all.push_back(CoverageEstimate{.overcut_mm = std::numeric_limits<double>::infinity()});
  all.push_back(CoverageEstimate{.at_tolerance = std::numeric_limits<double>::quiet_NaN()});
  for (const auto& a : all)
    for (const auto& b : all)
      for (const auto& c : all)
        if (is_better(a, b, options) && is_better(b, c, options)) {
          EXPECT_TRUE(is_better(a, c, options));
        }
}

}  // namespace
}  // namespace flank::internal
