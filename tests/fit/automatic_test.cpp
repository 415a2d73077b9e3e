// Whole fits from nothing but a target: a flat blade and a cylinder, small enough to run under every sanitizer.
#include <gtest/gtest.h>

#include <string>

#include "fit/flat_scene.h"
#include "flank/fit.h"
#include "flank/fit/coverage.h"
#include "flank/threads.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

using testing::cylinder;
using testing::standing_blade;
using testing::twisted_blade;

constexpr double kTolerance = 0.02;

FlankFitOptions small_options() {
  FlankFitOptions options;
  options.tolerance_mm = kTolerance;
  options.bounds = {2.0, 8.0, 0.5};
  options.sample_share = 1.0 / 15.0;
  options.polished_candidates = options.finalists = 1;
  return options;
}

ToolModel given_cylinder(double radius) {
  ToolModel tool;
  tool.make = [radius](double length, double) { return cylinder(radius, length); };
  tool.radius = radius;
  return tool;
}

TEST(FitAutomatic, LaysACylinderOntoAFlatBlade) {
  const auto blade = standing_blade(0.0);
  std::vector<std::string> steps;
  double share = -1.0;
  Progress progress;
  progress.report = [&](std::string_view stage, double at) {
    steps.emplace_back(stage);
    EXPECT_GT(at, share);
    share = at;
  };
  const FlankFitResult result = fit_automatic(*blade, given_cylinder(5.0), small_options(), progress);
  EXPECT_EQ(result.status, FitStatus::kWithinTolerance) << result.message;
  EXPECT_EQ(result.after.at_tolerance, 1.0);
  EXPECT_LT(result.after.overcut_mm, 0.1 * kTolerance);
  EXPECT_LT(result.residuals.largest_mm, 1e-5);
  EXPECT_EQ(result.tool.parameters()[0], 5.0);
  EXPECT_EQ(result.candidates, 10) << "two directions, five skews, one radius";
  EXPECT_EQ(result.motions.size(), 1u);
  EXPECT_FALSE(result.trace.empty());
  EXPECT_EQ(steps, (std::vector<std::string>{"starts", "polish", "polish"}));
  EXPECT_GE(result.after.score(kTolerance), result.before.score(kTolerance));
}

TEST(FitAutomatic, IsTheSameForOneAndThreeThreads) {
  const auto blade = standing_blade(0.0);
  std::vector<FlankFitResult> results;
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    results.push_back(fit_automatic(*blade, given_cylinder(5.0), small_options(), {}));
  }
  set_thread_count(0);
  EXPECT_EQ(results[0].motions.front().tip.poles, results[1].motions.front().tip.poles);
  EXPECT_EQ(results[0].motions.front().direction.poles, results[1].motions.front().direction.poles);
  EXPECT_EQ(results[0].after.rms_mm, results[1].after.rms_mm);
  EXPECT_EQ(results[0].message, results[1].message);
}

TEST(FitAutomatic, WhatCoversLessThanTheCallerWantsLookedAtGoesWithoutTheLastLook) {
  const auto blade = standing_blade(0.0);
  FlankFitOptions options = small_options();
  options.enough_coverage = 1.1;  // never
  const FlankFitResult looked = fit_automatic(*blade, given_cylinder(5.0), options, {});
  EXPECT_TRUE(looked.closely_measured);
  options.least_coverage_for_close_look = 1.1;
  const FlankFitResult rough = fit_automatic(*blade, given_cylinder(5.0), options, {});
  EXPECT_FALSE(rough.closely_measured);
  const std::vector<FitTask> tasks = {{blade.get(), rough.motions.front()}};
  const FlankFitResult after = with_close_look(tasks, rough, given_cylinder(5.0), options);
  EXPECT_TRUE(after.closely_measured);
  EXPECT_NEAR(after.after.at_tolerance, looked.after.at_tolerance, 0.01);
  EXPECT_LT(after.after.overcut_mm, 0.1 * kTolerance);
  EXPECT_EQ(after.candidates, rough.candidates);
}

TEST(FitAutomatic, CancelledItPolishesOnlyTheBestCandidate) {
  const auto blade = standing_blade(0.0);
  FlankFitOptions many = small_options();
  many.polished_candidates = 6;
  many.finalists = 3;
  Progress cancelled;
  cancelled.cancelled = [] { return true; };
  const FlankFitResult stopped = fit_automatic(*blade, given_cylinder(5.0), many, cancelled);
  const FlankFitResult one = fit_automatic(*blade, given_cylinder(5.0), small_options(), {});
  EXPECT_EQ(stopped.motions.front().tip.poles, one.motions.front().tip.poles);
  EXPECT_EQ(stopped.trace.size(), one.trace.size());
}

TEST(FitAutomatic, TheAxisHasTheLengthThatIsAskedFor) {
  if (kSanitized) GTEST_SKIP() << "three fits more on the path of the others";
  const auto blade = standing_blade(0.0);
  FlankFitOptions options = small_options();
  EXPECT_GT(fit_automatic(*blade, given_cylinder(5.0), options, {}).motions.front().axis_length, 40.0);
  options.axis_length_mm = 33.0;
  EXPECT_EQ(fit_automatic(*blade, given_cylinder(5.0), options, {}).motions.front().axis_length, 33.0);
  ToolModel tool = given_cylinder(5.0);
  tool.axis_length = 35.0;
  const FlankFitResult fixed = fit_automatic(*blade, tool, options, {});
  EXPECT_EQ(fixed.motions.front().axis_length, 35.0) << "the tool's own length comes first";
  EXPECT_EQ(fixed.tool.axis_length(), 35.0);
}

TEST(FitAutomatic, StripsSideBySideShareTheBlade) {
  if (kSanitized) GTEST_SKIP() << "the same path as one strip";
  const auto blade = standing_blade(0.0);
  FlankFitOptions options = small_options();
  options.strips = 2;
  const FlankFitResult result = fit_automatic(*blade, given_cylinder(5.0), options, {});
  ASSERT_EQ(result.motions.size(), 2u);
  EXPECT_EQ(result.status, FitStatus::kWithinTolerance) << result.message;
}

TEST(FitAutomatic, BesideAHubItStaysOutOfIt) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(testing::only(testing::hub(true)), *blade, 2.0, 0.0);
  FlankFitOptions options = small_options();
  options.obstacles = &obstacles;
  options.reach_radius_mm = 5.0;
  const FlankFitResult result = fit_automatic(*blade, given_cylinder(5.0), options, {});
  EXPECT_LE(result.after.gouge_mm, kTolerance) << result.message;
  EXPECT_LE(flank_gouge(result.motions, {&obstacles}, result.tool, {}, 400), 1.1 * kTolerance);
  EXPECT_GT(result.after.at_tolerance, 0.9) << result.message;
}

TEST(FitAutomatic, BetweenPlatesAToolThatReachesTheirCornersWins) {
  if (kThreadSanitized) GTEST_SKIP() << "a minute; its threads are those of every automatic fit";
  const auto blade = standing_blade(0.0);
  FlankFitOptions options = small_options();
  options.bounds = {0.5, 9.0, 0.5};
  options.reach_radius_mm = 1.0;
  options.polished_candidates = 6;
  options.finalists = 3;
  const ObstacleField obstacles(testing::plates(), *blade, 9.0, kTolerance);
  options.obstacles = &obstacles;
  const FlankFitResult result = fit_automatic(*blade, {}, options, {});
  // A radius of 3 would leave 4 mm of 58 that are within reach.
  EXPECT_GT(result.after.at_tolerance, 0.99);
  EXPECT_LE(std::max(result.after.gouge_mm, result.after.overcut_mm), kTolerance);
  EXPECT_LT(result.tool.largest(), 1.5);
}

TEST(FitAutomatic, BesideAFixtureItKeepsTheClearance) {
  if (kSanitized) GTEST_SKIP() << "the same path as beside a hub";
  constexpr double kClearance = 2.0;
  const auto blade = standing_blade(0.0);
  ObstacleFace fixture = testing::hub(true);
  fixture.clearance_mm = kClearance;
  const ObstacleField obstacles(testing::only(fixture), *blade, 2.0, 0.0);
  FlankFitOptions options = small_options();
  options.obstacles = &obstacles;
  options.reach_radius_mm = 5.0;
  const FlankFitResult result = fit_automatic(*blade, given_cylinder(5.0), options, {});
  EXPECT_GT(result.after.at_tolerance, 0.9) << result.message;
  // The fixture is the plane z = 0: the lowest end of the axis says how near the flank comes.
  for (const RuledMotion& motion : result.motions) {
    for (int i = 0; i <= 400; ++i) {
      const Pose pose = motion.pose(i / 400.0);
      EXPECT_GE(std::min(pose.tip.z(), pose.at(motion.axis_length).z()) - 5.0, kClearance - 1.1 * kTolerance) << i;
    }
  }
}

TEST(FitAutomatic, AFreeToolCoversATwistedBladeWithinItsBounds) {
  if (kSanitized) GTEST_SKIP() << "fifty candidates and every pass";
  const auto target = twisted_blade(10.0);
  const FlankFitResult result = fit_automatic(*target, {}, small_options(), {});
  EXPECT_EQ(result.candidates, 50) << "two directions, five skews, five radii";
  EXPECT_EQ(result.status, FitStatus::kWithinTolerance) << result.message;
  for (int j = 0; j <= 100; ++j) {
    const double r = result.tool.at(result.tool.axis_length() * j / 100.0).r;
    EXPECT_GE(r, 2.0 - 1e-9);
    EXPECT_LE(r, 8.0 + 1e-9);
  }
}

TEST(FitFromStarts, AStartThatIsOffEndsOnTheBlade) {
  const auto blade = standing_blade(0.0);
  const RuledMotion start =
      testing::upright_motion({.y = 5.4, .z = -1.0, .x_first = -3.0, .x_last = 63.0, .length = 42.0});
  const FlankFitResult result = fit_from_starts({{blade.get(), start}}, given_cylinder(5.0), small_options(), {});
  EXPECT_EQ(result.status, FitStatus::kWithinTolerance) << result.message;
  EXPECT_EQ(result.before.at_tolerance, 0.0);
  EXPECT_NEAR(result.before.undercut_mm, 0.4, 1e-3);
  EXPECT_LT(result.residuals.largest_mm, 1e-5);
}

}  // namespace
}  // namespace flank::internal
