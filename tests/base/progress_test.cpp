// Progress hands its calls on, and does without what was not given.
#include "flank/progress.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace flank::internal {
namespace {

TEST(Progress, WithoutCallbacksNothingHappensAndNothingStops) {
  const Progress silent;
  silent.step("fit", 0.5);
  EXPECT_FALSE(silent.stop());
}

TEST(Progress, HandsStageAndShareToTheReport) {
  std::vector<std::pair<std::string, double>> calls;
  Progress progress;
  progress.report = [&](std::string_view stage, double share) { calls.emplace_back(stage, share); };
  progress.step("seed", 0.0);
  progress.step("fit", 0.25);
  const std::vector<std::pair<std::string, double>> expected{{"seed", 0.0}, {"fit", 0.25}};
  EXPECT_EQ(calls, expected);
  EXPECT_FALSE(progress.stop()) << "a report alone cancels nothing";
}

TEST(Progress, AsksWhetherItIsCancelledEachTime) {
  int asked = 0;
  Progress progress;
  progress.cancelled = [&] { return ++asked > 2; };
  EXPECT_FALSE(progress.stop());
  EXPECT_FALSE(progress.stop());
  EXPECT_TRUE(progress.stop());
  progress.step("fit", 1.0);
  EXPECT_EQ(asked, 3) << "a step does not ask";
}

TEST(Progress, APartOfTheWholeHasSharesOfTheWhole) {
  std::vector<double> shares;
  double found = 0.0;
  Progress progress;
  progress.report = [&](std::string_view, double share) { shares.push_back(share); };
  progress.cancelled = [] { return true; };
  progress.found = [&](const BestSoFar& best) { found = best.coverage; };
  const Progress part = progress.part(0.2, 0.6);
  part.step("fit", 0.0);
  part.step("fit", 0.5);
  part.part(0.5, 1.0).step("fit", 1.0);
  ASSERT_EQ(shares.size(), 3u);
  EXPECT_DOUBLE_EQ(shares[0], 0.2);
  EXPECT_DOUBLE_EQ(shares[1], 0.4);
  EXPECT_DOUBLE_EQ(shares[2], 0.6);
  EXPECT_TRUE(part.stop());
  part.found({.coverage = 0.7, .deepest_mm = 0.0, .clean = true});
  EXPECT_EQ(found, 0.7);
  Progress().part(0.0, 0.5).step("fit", 0.5);  // nobody listens
}

}  // namespace
}  // namespace flank::internal
