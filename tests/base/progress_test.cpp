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

}  // namespace
}  // namespace flank::internal
