// The ways beside other faces: what is cut off an axis or a path, and which of two results is the better one.
#include "flank/fit/ways.h"
#include "flank/fit/coverage.h"
#include "flank/fit/rank.h"

#include <gtest/gtest.h>

#include "fit/flat_scene.h"
#include "flank/fit/coverage.h"
#include "flank/fit/rank.h"

namespace flank::internal {
namespace {

using testing::hub;
using testing::only;
using testing::quad;
using testing::standing_blade;

constexpr double kDepth = 0.02;

/// A free tool of radius 5, upright before the flat blade, from x = 4 to 56, its axis from z = 2 to 32.
FitDraft upright_draft(const Target& blade, const ObstacleField& obstacles) {
  FitDraft draft;
  draft.targets = {&blade};
  draft.obstacles = {&obstacles};
  draft.motions = {testing::upright_motion()};
  draft.tool = RadialFunction::spline(30.0, Eigen::VectorXd::Constant(6, 5.0));
  draft.free_tool = true;
  return draft;
}

/// The plane x = 50, seen from smaller x.
ObstacleFace end_wall() {
  return {make_target({quad(Vec3(50, 50, -20), Vec3(50, -50, -20), Vec3(50, 50, 60), Vec3(50, -50, 60), "F3")}), true};
}

double deepest(const FitDraft& draft) { return flank_gouge(draft.motions, draft.obstacles, draft.tool, {}, 400); }

TEST(ShortenedPath, EndsWhereTheFlankTouchesTheWall) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(only(end_wall()), *blade, 2.0, 0.0);
  ASSERT_NE(obstacles.sign(0), 0);
  const FitDraft draft = upright_draft(*blade, obstacles);
  ASSERT_GT(deepest(draft), 10.0);
  const std::optional<FitDraft> part = shortened_path(draft, kDepth);
  ASSERT_TRUE(part.has_value());
  EXPECT_LE(deepest(*part), 1.1 * kDepth);
  EXPECT_NEAR(part->motions.front().pose(1.0).tip.x(), 45.0 + kDepth, 1e-3) << "no shorter than the wall asks";
  EXPECT_NEAR(part->motions.front().pose(0.0).tip.x(), 4.0, 1e-9);
  EXPECT_EQ(part->motions.front().axis_length, 30.0);
}

TEST(ShortenedAxis, BeginsWhereTheFlankTouchesTheHub) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(only(hub(true)), *blade, 2.0, 0.0);
  const FitDraft draft = upright_draft(*blade, obstacles);
  ASSERT_NEAR(deepest(draft), 3.0, 1e-6) << "a ball of radius 5 at z = 2";
  const std::optional<FitDraft> part = shortened_axis(draft, kDepth);
  ASSERT_TRUE(part.has_value());
  EXPECT_LE(deepest(*part), 1.1 * kDepth);
  EXPECT_NEAR(part->motions.front().pose(0.5).tip.z(), 5.0 - kDepth, 1e-3);
  EXPECT_NEAR(part->motions.front().axis_length, 27.0 + kDepth, 1e-3);
  EXPECT_NEAR(part->tool.axis_length(), part->motions.front().axis_length, 1e-12);
  EXPECT_NEAR(part->tool.at(10.0).r, 5.0, 1e-9);
}

TEST(Shortened, NothingIsCutOffWhatIsFreeNorOffAGivenTool) {
  const auto blade = standing_blade(0.0);
  const ObstacleField hub_only(only(hub(true)), *blade, 2.0, 0.0);
  FitDraft draft = upright_draft(*blade, hub_only);
  draft.motions = {testing::upright_motion({.z = 6.0})};
  EXPECT_FALSE(shortened_path(draft, kDepth).has_value());
  EXPECT_FALSE(shortened_axis(draft, kDepth).has_value());
  FitDraft given = upright_draft(*blade, hub_only);
  given.free_tool = false;
  EXPECT_FALSE(shortened_axis(given, kDepth).has_value());
}

TEST(Shortened, ATrunkIsNoResult) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(only(hub(true)), *blade, 2.0, 0.0);
  FitDraft draft = upright_draft(*blade, obstacles);
  draft.motions = {testing::upright_motion({.z = -20.0})};
  EXPECT_FALSE(shortened_axis(draft, kDepth).has_value());
  EXPECT_FALSE(shortened_path(draft, kDepth).has_value());
}

CoverageEstimate covering(double share, double gouge_mm, double overcut_mm = 0.0) {
  CoverageEstimate estimate;
  estimate.at_tolerance = estimate.at_four_tolerances = share;
  estimate.gouge_mm = gouge_mm;
  estimate.overcut_mm = overcut_mm;
  return estimate;
}

/// The best of a first result and of the ways that begin with the upright draft, before the blade with a wall at its end.
FlankFitResult best_beside_wall(double first_covers, double free_x_last) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(only(end_wall()), *blade, 2.0, 0.0);
  FlankFitOptions options;
  options.tolerance_mm = kDepth;
  options.obstacles = &obstacles;
  options.bounds = {1.0, 9.0, 0.5};
  options.sample_share = 1.0 / 15.0;
  FitDraft draft = upright_draft(*blade, obstacles);
  FlankFitResult first;
  first.motions = draft.motions;
  first.tool = draft.tool;
  first.after.at_tolerance = first_covers;
  draft.motions = {testing::upright_motion({.x_last = free_x_last})};
  return best_way(*blade, {}, options, first,
                  [&](const FlankFitOptions& of) {
                    EXPECT_EQ(of.obstacles, nullptr);
                    FlankFitResult free;
                    free.motions = draft.motions;
                    free.tool = draft.tool;
                    return free;
                  },
                  {});
}

TEST(BestWay, SaysWhetherAnotherWayIsTheResult) {
  const FlankFitResult better = best_beside_wall(0.1, 56.0);
  EXPECT_EQ(better.unobstructed_search, UnobstructedSearch::kBest);
  EXPECT_GT(better.after.at_tolerance, 0.3) << "on a shorter path";
  EXPECT_LE(better.after.gouge_mm, 1.1 * kDepth);
  const FlankFitResult beaten = best_beside_wall(1.0, 46.0);
  EXPECT_EQ(beaten.unobstructed_search, UnobstructedSearch::kBeaten) << "1 mm in the wall";
  EXPECT_EQ(beaten.after.at_tolerance, 1.0);
  const FlankFitResult hopeless = best_beside_wall(1.0, 56.0);
  EXPECT_EQ(hopeless.unobstructed_search, UnobstructedSearch::kBeaten) << "the axis ends 6 mm behind the wall";
  EXPECT_EQ(hopeless.after.at_tolerance, 1.0);
}

TEST(CannotWin, WhatCoversLessOrIsTooDeepToBeMended) {
  FlankFitOptions options;
  options.tolerance_mm = 0.05;
  const CoverageEstimate clean = covering(0.9, 0.0);
  EXPECT_TRUE(cannot_win(covering(0.85, 0.0), clean, options));
  EXPECT_FALSE(cannot_win(covering(0.895, 0.0), clean, options)) << "a last look may cover a little more";
  EXPECT_FALSE(cannot_win(covering(0.95, 0.0), clean, options));
  EXPECT_FALSE(cannot_win(covering(1.0, 0.1), clean, options)) << "a little too deep can be mended";
  EXPECT_TRUE(cannot_win(covering(1.0, 2.0), clean, options));
  EXPECT_FALSE(cannot_win(covering(1.0, 2.0), covering(0.3, 0.0), options)) << "clean, but not worth having";
  EXPECT_FALSE(cannot_win(covering(0.5, 0.0), covering(0.9, 2.0), options)) << "the rival is not clean";
  CoverageEstimate plunging = clean;
  plunging.largest_c = 1.2;
  EXPECT_FALSE(cannot_win(covering(0.85, 0.0), plunging, options));
}

}  // namespace
}  // namespace flank::internal
