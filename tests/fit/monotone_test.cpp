// What is easier to do is never done worse: with fewer faces in the way, a looser tolerance, one strip more.
#include <gtest/gtest.h>

#include "fit/flat_scene.h"
#include "flank/fit.h"
#include "flank/fit/coverage.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

using testing::cylinder;
using testing::hub;
using testing::quad;
using testing::standing_blade;

/// Coverage that may be lost where none should be: the samples that rank know it to half a percent.
constexpr double kSame = 0.005;

FlankFitOptions options_at(double tolerance_mm) {
  FlankFitOptions options;
  options.tolerance_mm = tolerance_mm;
  options.bounds = {2.0, 8.0, 0.5};
  options.sample_share = 1.0 / 15.0;
  options.polished_candidates = options.finalists = 1;
  options.reach_radius_mm = 5.0;
  return options;
}

ToolModel given_cylinder() {
  ToolModel tool;
  tool.make = [](double length, double) { return cylinder(5.0, length); };
  tool.radius = 5.0;
  return tool;
}

/// Share of the whole blade that the fit finishes, whatever is in reach.
double covered(const Target& blade, const FlankFitResult& fit, double tolerance_mm) {
  return estimate_coverage(blade.samples(1.0), fit.motions, fit.tool, tolerance_mm, 200).at_tolerance;
}

/// A fin that stands beside the blade's far end, out of the way of a tool on the blade.
ObstacleFace fin() {
  return {make_target({quad(Vec3(-6, 2, 10), Vec3(-6, 8, 10), Vec3(-6, 2, 20), Vec3(-6, 8, 20), "F4")}), true};
}

TEST(Monotone, FewerFacesInTheWayCoverNoLess) {
  if (kSanitized) GTEST_SKIP() << "the same path as beside a hub, three times";
  const auto blade = standing_blade(0.0);
  constexpr double kTolerance = 0.02;
  double last = 0.0;
  for (const int faces : {2, 1, 0}) {
    Obstacles obstacles;
    if (faces > 0) obstacles.faces.push_back(hub(true));
    if (faces > 1) obstacles.faces.push_back(fin());
    const ObstacleField field(obstacles, *blade, 2.0, 0.8 * kTolerance);
    FlankFitOptions options = options_at(kTolerance);
    options.obstacles = &field;
    const FlankFitResult fit = fit_automatic(*blade, given_cylinder(), options, {});
    ASSERT_FALSE(fit.motions.empty());
    EXPECT_LE(fit.after.gouge_mm, kTolerance) << faces;
    const double share = covered(*blade, fit, kTolerance);
    EXPECT_GE(share, last - kSame) << faces << " faces";
    last = share;
  }
}

TEST(Monotone, ALooserToleranceCoversNoLess) {
  if (kSanitized) GTEST_SKIP() << "the same path as beside a hub, three times";
  const auto blade = standing_blade(0.0);
  double last = 0.0;
  for (const double tolerance : {0.01, 0.02, 0.04}) {
    const ObstacleField field(testing::only(hub(true)), *blade, 2.0, 0.8 * tolerance);
    FlankFitOptions options = options_at(tolerance);
    options.obstacles = &field;
    const FlankFitResult fit = fit_automatic(*blade, given_cylinder(), options, {});
    ASSERT_FALSE(fit.motions.empty());
    const double share = covered(*blade, fit, tolerance);
    EXPECT_GE(share, last - kSame) << tolerance;
    last = share;
  }
}

}  // namespace
}  // namespace flank::internal
