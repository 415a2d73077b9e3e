#include "flank/pipeline/search/strip_gain.h"

#include <gtest/gtest.h>

#include <vector>

namespace flank::internal {
namespace {

constexpr double kTolerance = 0.1;

FlankFitResult result_of(double covers, double gouge_mm) {
  FlankFitResult result;
  result.after.at_tolerance = covers;
  result.after.gouge_mm = gouge_mm;
  return result;
}

/// After how many results, each clean and covering so much, the search ends; 0: it would go on.
int ends_after(const std::vector<double>& covers) {
  StripGain gain(kTolerance, 0.99);
  for (std::size_t k = 0; k < covers.size(); ++k)
    if (!gain.goes_on(result_of(covers[k], 0.05))) return static_cast<int>(k) + 1;
  return 0;
}

TEST(StripGain, EndsAfterTwoCountsThatGainNothing) { EXPECT_EQ(ends_after({0.8, 0.803, 0.806}), 3); }

TEST(StripGain, AGainBetweenTwoThatAreNoneGoesOn) { EXPECT_EQ(ends_after({0.8, 0.8, 0.85, 0.85, 0.85}), 5); }

TEST(StripGain, WhereLittleIsMissingLessIsAGainAndFourMayBeNone) {
  // 0.986 gains a third of what is missing.
  EXPECT_EQ(ends_after({0.98, 0.98, 0.98, 0.986, 0.987, 0.987, 0.987, 0.987}), 8);
}

TEST(StripGain, WhereFacetsLimitWhatCanBeCoveredOneThatGainsNothingIsTheLast) {
  StripGain gain(kTolerance, 0.99, true);
  EXPECT_TRUE(gain.goes_on(result_of(0.6, 0.05)));
  EXPECT_TRUE(gain.goes_on(result_of(0.93, 0.05)));
  EXPECT_FALSE(gain.goes_on(result_of(0.932, 0.05)));
}

TEST(StripGain, WhereAllIsCoveredAndSomethingElseIsAmissOneMoreIsTried) {
  EXPECT_EQ(ends_after({0.995, 0.996, 0.997}), 2);
}

TEST(StripGain, WhatRunsThroughAnotherFaceIsNothingToBeat) {
  StripGain gain(kTolerance, 0.99);
  // One strip covers all but a little, straight through the hub; two cover less and enter nothing.
  EXPECT_TRUE(gain.goes_on(result_of(0.93, 20.0)));
  EXPECT_TRUE(gain.goes_on(result_of(0.85, 0.05)));
  EXPECT_TRUE(gain.goes_on(result_of(0.85, 0.05)));
}

TEST(StripGain, WhatRunsThroughAnotherFaceTellsNothingOfWhatFacetsLimit) {
  StripGain gain(kTolerance, 0.99, true);
  EXPECT_TRUE(gain.goes_on(result_of(0.6, 20.0)));
  EXPECT_TRUE(gain.goes_on(result_of(0.93, 0.05)));
  EXPECT_FALSE(gain.goes_on(result_of(0.93, 0.05)));
}

TEST(StripGain, AToolThatWasBeatenButIsNearlyCleanIsAPromise) {
  StripGain gain(kTolerance, 0.99);
  EXPECT_TRUE(gain.goes_on(result_of(0.5, 0.05)));
  EXPECT_TRUE(gain.goes_on(result_of(0.5, 0.05)));
  FlankFitResult third = result_of(0.5, 0.05);
  RejectedTool rejected;
  rejected.estimate.at_tolerance = 0.9;
  rejected.estimate.gouge_mm = 3.0 * kTolerance;
  third.rejected.push_back(rejected);
  EXPECT_TRUE(gain.goes_on(third));
}

}  // namespace
}  // namespace flank::internal
