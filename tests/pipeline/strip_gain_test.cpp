#include "flank/pipeline/search/strip_gain.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

constexpr double kTolerance = 0.1;

FlankFitResult result_of(double covers, double gouge_mm) {
  FlankFitResult result;
  result.after.at_tolerance = covers;
  result.after.gouge_mm = gouge_mm;
  return result;
}

TEST(StripGain, EndsAfterTwoCountsThatGainNothing) {
  StripGain gain(kTolerance);
  EXPECT_TRUE(gain.goes_on(result_of(0.8, 0.05)));
  EXPECT_TRUE(gain.goes_on(result_of(0.803, 0.05)));
  EXPECT_FALSE(gain.goes_on(result_of(0.806, 0.05)));
}

TEST(StripGain, AGainBetweenTwoThatAreNoneGoesOn) {
  StripGain gain(kTolerance);
  EXPECT_TRUE(gain.goes_on(result_of(0.8, 0.05)));
  EXPECT_TRUE(gain.goes_on(result_of(0.8, 0.05)));
  EXPECT_TRUE(gain.goes_on(result_of(0.85, 0.05)));
  EXPECT_TRUE(gain.goes_on(result_of(0.85, 0.05)));
  EXPECT_FALSE(gain.goes_on(result_of(0.85, 0.05)));
}

TEST(StripGain, WhereLittleIsMissingLessIsAGainAndFourMayBeNone) {
  StripGain gain(kTolerance);
  EXPECT_TRUE(gain.goes_on(result_of(0.98, 0.05)));
  EXPECT_TRUE(gain.goes_on(result_of(0.98, 0.05)));
  EXPECT_TRUE(gain.goes_on(result_of(0.98, 0.05)));
  EXPECT_TRUE(gain.goes_on(result_of(0.986, 0.05))) << "a third of what is missing";
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(gain.goes_on(result_of(0.987, 0.05)));
  EXPECT_FALSE(gain.goes_on(result_of(0.987, 0.05)));
}

TEST(StripGain, WhatRunsThroughAnotherFaceIsNothingToBeat) {
  StripGain gain(kTolerance);
  // One strip covers all but a little, straight through the hub; two cover less and enter nothing.
  EXPECT_TRUE(gain.goes_on(result_of(0.93, 20.0)));
  EXPECT_TRUE(gain.goes_on(result_of(0.85, 0.05)));
  EXPECT_TRUE(gain.goes_on(result_of(0.85, 0.05)));
}

TEST(StripGain, AToolThatWasBeatenButIsNearlyCleanIsAPromise) {
  StripGain gain(kTolerance);
  EXPECT_TRUE(gain.goes_on(result_of(0.5, 0.05)));
  EXPECT_TRUE(gain.goes_on(result_of(0.5, 0.05)));
  FlankFitResult third = result_of(0.5, 0.05);
  TriedTool tried;
  tried.estimate.at_tolerance = 0.9;
  tried.estimate.gouge_mm = 3.0 * kTolerance;
  third.tried.push_back(tried);
  EXPECT_TRUE(gain.goes_on(third));
}

}  // namespace
}  // namespace flank::internal
