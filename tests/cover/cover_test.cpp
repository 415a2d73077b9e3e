// The whole: strips that cover what they can, keep clear of what they must, and say why they cannot.
#include "flank/cover.h"

#include <gtest/gtest.h>

#include "cover/cover_targets.h"
#include "flank/cover/tiles/tile.h"
#include "flank/path/turning.h"
#include "flank/strip/kinks.h"
#include "flank/threads.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

CoverOptions options_for(double tolerance_mm) {
  CoverOptions options;
  options.tolerance_mm = tolerance_mm;
  return options;
}

TEST(Cover, TwistedBladeWithACylinder) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer; its parts are tested there by themselves";
  const Example blade = make_example("twisted-blade");
  const auto target = make_target(blade.faces);
  const double tolerance = 1e-3 * blade.diagonal_mm;
  const CoverResult result = cover(*target, testing::cylinder(5.0, 20.0), {}, options_for(tolerance), {});
  ASSERT_EQ(result.status, CoverStatus::kCovered) << result.message;
  EXPECT_GE(result.coverage_before, 0.97);
  EXPECT_GE(result.coverage, 0.98);
  EXPECT_LE(result.motions.size(), 8u);
  EXPECT_LE(result.overlap, 0.6);
  EXPECT_LE(result.overcut_mm, tolerance);
  EXPECT_EQ(result.reachable, 1.0);
  const CoverOptions options = options_for(tolerance);
  for (const RuledMotion& motion : result.motions)
    EXPECT_FALSE(has_kink(motion, {options.most_turn_rad, turn_window(target->diagonal())}, tolerance));
}

TEST(Cover, SurfaceLongerThanTheTool) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer; its parts are tested there by themselves";
  const testing::LongSurface surface;
  Tool tool;
  tool.radial = surface.tool;
  const double tolerance = 1e-5 * surface.exact.target->diagonal();
  const CoverResult result = cover(*surface.exact.target, tool, {}, options_for(tolerance), {});
  ASSERT_EQ(result.status, CoverStatus::kCovered) << result.message;
  // The tool's own share of the axis is what one motion reaches exactly.
  EXPECT_GE(result.coverage, 0.95 * 24.0 / 40.0);
  EXPECT_LE(result.overcut_mm, tolerance);
}

TEST(Cover, SameForAnyNumberOfThreads) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer; its parts are tested there by themselves";
  const auto target = testing::flat_target(0.0, 50.0, 0.0, 30.0);
  std::vector<CoverResult> results;
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    results.push_back(cover(*target, testing::cylinder(4.0, 16.0), {}, options_for(0.01), {}));
  }
  set_thread_count(0);
  ASSERT_EQ(results[0].motions.size(), results[1].motions.size());
  ASSERT_FALSE(results[0].motions.empty());
  for (std::size_t k = 0; k < results[0].motions.size(); ++k)
    EXPECT_EQ(results[0].motions[k].tip.poles, results[1].motions[k].tip.poles);
}

TEST(Cover, KeepsClearOfAWall) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer; its parts are tested there by themselves";
  const auto target = testing::flat_target(0.0, 50.0, 0.0, 30.0);
  const Obstacles obstacles = testing::wall_at(30.0);
  const Tool tool = testing::cylinder(4.0, 16.0);
  const CoverResult result = cover(*target, tool, obstacles, options_for(0.01), {});
  ASSERT_EQ(result.status, CoverStatus::kCovered) << result.message;
  EXPECT_NEAR(result.reachable, 26.0 / 30.0, 0.02);
  EXPECT_GE(result.coverage, 0.97);
  const PoseChecker checker(tool, obstacles.meshes);
  for (const RuledMotion& motion : result.motions)
    for (int i = 0; i <= 400; ++i) EXPECT_TRUE(checker.is_free(motion.pose(i / 400.0), -0.01));
}

TEST(Cover, ACylinderIsHeldWhereNothingIsInTheWay) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer; its parts are tested there by themselves";
  // Two walls in a corner, far from the flank: whichever way it lies, one of its ends points at a wall, and the other one is free.
  const auto target = testing::flat_target(0.0, 50.0, 0.0, 30.0);
  Obstacles obstacles = testing::wall_at(60.0);
  const Obstacles other =
      testing::triangle_obstacle(Vec3(80.0, -90.0, -1.0), Vec3(80.0, 120.0, -1.0), Vec3(80.0, 15.0, 120.0));
  obstacles.meshes.push_back(other.meshes.front());
  const Tool tool = testing::cylinder(4.0, 16.0);
  const CoverResult result = cover(*target, tool, obstacles, options_for(0.01), {});
  ASSERT_EQ(result.status, CoverStatus::kCovered) << result.message;
  EXPECT_GE(result.coverage, 0.97);
  Tool held = tool;
  held.shank = {{16.0, kRodShare * 4.0}, {300.0, kRodShare * 4.0}};
  const PoseChecker checker(held, obstacles.meshes);
  for (const RuledMotion& motion : result.motions)
    for (int i = 0; i <= 400; ++i) EXPECT_TRUE(checker.is_free(motion.pose(i / 400.0), -0.01));
}

TEST(Cover, SaysWhichCurvatureForbidsTheTool) {
  // The hollow side of a round sheet: 45 to 49 mm of radius.
  const auto hollow = make_target(make_example("elliptic-side").faces, -1);
  const CoverResult result = cover(*hollow, testing::cylinder(80.0, 60.0), {}, options_for(1e-3), {});
  EXPECT_EQ(result.status, CoverStatus::kNoLine);
  EXPECT_TRUE(result.motions.empty());
  EXPECT_NE(result.message.find("the concave face needs a tool radius below 4"), std::string::npos) << result.message;
  EXPECT_NE(result.message.find("the smallest of this tool is 80"), std::string::npos) << result.message;
}

TEST(Cover, SaysThatNothingCanBeReached) {
  // A lid a millimetre above the sheet.
  const auto target = testing::flat_target(0.0, 20.0, 0.0, 20.0);
  const Obstacles obstacles = testing::lid_at(1.0);
  const CoverResult result = cover(*target, testing::cylinder(4.0, 10.0), obstacles, options_for(0.01), {});
  EXPECT_NE(result.status, CoverStatus::kCovered);
  EXPECT_EQ(result.reachable, 0.0);
  EXPECT_TRUE(result.motions.empty());
  EXPECT_NE(result.message.find("nowhere"), std::string::npos) << result.message;
}

TEST(Cover, TakesTheUsersSeeds) {
  const auto target = testing::flat_target(0.0, 50.0, 0.0, 30.0);
  CoverOptions options = options_for(0.01);
  options.seeds = {{Vec3(25.0, 15.0, 0.0), Vec3::UnitZ(), Vec3::UnitY(), 8.0}};
  const CoverResult result = cover(*target, testing::cylinder(4.0, 16.0), {}, options, {});
  EXPECT_EQ(result.seeds, 1);
  EXPECT_EQ(result.lines, 1);
  EXPECT_GE(result.coverage, 0.97) << "neighbours of the one strip are found beside it";
}

TEST(Tile, ASetIsWorthItsCoverLessItsPrice) {
  const auto target = testing::flat_target(0.0, 10.0, 0.0, 10.0);
  CoverSamples samples = cover_samples(*target, 1.0);
  const PoseGuard guard;
  CoverOptions options;
  options.strip_price = 0.1;
  const RadialFunction radial = testing::cylinder(1.0, 5.0).radial;
  const TileScene scene{*target, radial, samples, guard, options};
  const int n = static_cast<int>(samples.cells.size());
  std::vector<CoverStrip> pool(3);
  for (int k = 0; k < n; ++k) pool[k < n / 2 ? 0 : 1].cells.push_back(k);
  for (int k = 0; k < n / 20; ++k) pool[2].cells.push_back(k);
  EXPECT_NEAR(set_value(scene, pool, {0, 1}), 0.8, 1e-6);
  EXPECT_NEAR(set_value(scene, pool, {0, 1, 2}), 0.7, 1e-6);
  EXPECT_EQ(pruned(scene, pool).size(), 2u);
}

}  // namespace
}  // namespace flank::internal
