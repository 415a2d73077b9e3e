// Strategy `curves` from end to end.
#include "flank/cover/curves/curves.h"

#include <gtest/gtest.h>

#include "cover/cover_targets.h"
#include "flank/cover.h"
#include "flank/threads.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

CoverOptions options_for(double tolerance_mm) {
  CoverOptions options;
  options.strategy = CoverStrategy::kCurves;
  options.tolerance_mm = tolerance_mm;
  return options;
}

void expect_certified(const Target& target, const RadialFunction& radial, const CoverResult& result,
                      double tolerance_mm) {
  LineFitOptions options;
  options.tolerance_mm = tolerance_mm;
  options.samples = 60;
  LineFitter fitter(target, radial, options);
  for (const RuledMotion& motion : result.motions) {
    fitter.forget();
    for (int i = 0; i <= 1500; ++i) {
      const Pose pose = motion.pose(i / 1500.0);
      (void)fitter.measure(pose);
      EXPECT_LE(fitter.overcut(pose), tolerance_mm);
    }
  }
}

TEST(Curves, SmallPlane) {
  const auto target = testing::flat_target(0.0, 30.0, 0.0, 20.0);
  CoverOptions options = options_for(0.01);
  options.curves.places = 60;
  options.curves.clusters = 60;
  options.smooth = false;
  const Tool tool = testing::cylinder(4.0, 16.0);
  const CoverResult result = cover(*target, tool, {}, options, {});
  ASSERT_EQ(result.status, CoverStatus::kCovered) << result.message;
  EXPECT_GE(result.coverage, 0.9);
  EXPECT_GT(result.seeds, 0);
  EXPECT_GT(result.lines, 0);
  EXPECT_GT(result.grown, 0);
  expect_certified(*target, tool.radial, result, 0.01);
}

TEST(Curves, ExactEnvelope) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer; its parts are tested there by themselves";
  const testing::LongSurface surface;
  Tool tool;
  tool.radial = surface.exact.tool;
  const double tolerance = 1e-4 * surface.exact.target->diagonal();
  CoverOptions options = options_for(tolerance);
  const CoverResult result = cover(*surface.exact.target, tool, {}, options, {});
  ASSERT_EQ(result.status, CoverStatus::kCovered) << result.message;
  EXPECT_GE(result.coverage, 0.95);
  EXPECT_GE(result.coverage, result.coverage_before);
  EXPECT_LE(result.overcut_mm, tolerance);
  expect_certified(*surface.exact.target, tool.radial, result, tolerance);
  options.smooth = false;
  const CoverResult rough = cover(*surface.exact.target, tool, {}, options, {});
  EXPECT_NEAR(rough.coverage_before, result.coverage_before, 1e-12);
  EXPECT_LE(rough.coverage, rough.coverage_before + 1e-12);
}

TEST(Curves, TwistedBlade) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer; its parts are tested there by themselves";
  const Example blade = make_example("twisted-blade");
  const auto target = make_target(blade.faces);
  const double tolerance = 1e-3 * blade.diagonal_mm;
  const Tool tool = testing::cylinder(5.0, 20.0);
  const CoverResult result = cover(*target, tool, {}, options_for(tolerance), {});
  ASSERT_EQ(result.status, CoverStatus::kCovered) << result.message;
  EXPECT_GE(result.coverage, 0.97);
  EXPECT_LE(result.motions.size(), 8u);
  expect_certified(*target, tool.radial, result, tolerance);
}

TEST(Curves, SameForAnyNumberOfThreads) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer; its parts are tested there by themselves";
  const Example blade = make_example("twisted-blade");
  const auto target = make_target(blade.faces);
  CoverOptions options = options_for(0.1);
  options.curves.places = 100;
  options.curves.clusters = 60;
  std::vector<CoverResult> results;
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    results.push_back(cover(*target, testing::cylinder(5.0, 20.0), {}, options, {}));
  }
  set_thread_count(0);
  ASSERT_EQ(results[0].motions.size(), results[1].motions.size());
  ASSERT_FALSE(results[0].motions.empty());
  EXPECT_EQ(results[0].coverage, results[1].coverage);
  for (std::size_t k = 0; k < results[0].motions.size(); ++k) {
    EXPECT_EQ(results[0].motions[k].tip.poles, results[1].motions[k].tip.poles);
    EXPECT_EQ(results[0].motions[k].direction.poles, results[1].motions[k].direction.poles);
  }
}

TEST(Curves, KeepsClearOfAWall) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer; its parts are tested there by themselves";
  const auto target = testing::flat_target(0.0, 40.0, 0.0, 20.0);
  const Obstacles obstacles = testing::wall_at(20.0);
  const Tool tool = testing::cylinder(4.0, 12.0);
  const CoverResult result = cover(*target, tool, obstacles, options_for(0.01), {});
  ASSERT_EQ(result.status, CoverStatus::kCovered) << result.message;
  EXPECT_GE(result.coverage, 0.8);
  const PoseChecker checker(tool, obstacles.meshes);
  for (const RuledMotion& motion : result.motions)
    for (int i = 0; i <= 400; ++i) EXPECT_TRUE(checker.is_free(motion.pose(i / 400.0), -0.01));
}

TEST(Curves, SaysThatThereIsNoLine) {
  const auto hollow = make_target(make_example("elliptic-side").faces, -1);
  const CoverResult result = cover(*hollow, testing::cylinder(80.0, 60.0), {}, options_for(1e-3), {});
  EXPECT_EQ(result.status, CoverStatus::kNoLine);
  EXPECT_TRUE(result.motions.empty());
  EXPECT_FALSE(result.message.empty());
}

}  // namespace
}  // namespace flank::internal
