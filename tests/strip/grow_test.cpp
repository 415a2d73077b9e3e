// GROW: strips on exact envelopes reach both borders, and every pose touches within tolerance.
#include "flank/strip/grow.h"

#include <gtest/gtest.h>

#include "cover/cover_targets.h"
#include "flank/strip/certify.h"

namespace flank::internal {
namespace {

using testing::LongSurface;

TEST(Grow, RunsFromBorderToBorder) {
  const LongSurface surface;
  LineFitter fitter(*surface.exact.target, surface.tool, {.tolerance_mm = 1e-3});
  for (const double t : {0.3, 0.7}) {
    fitter.forget();
    const LineFit line = fitter.refine(surface.pose(t));
    const GrownStrip strip = grow(fitter, LineGuard(), line, {});
    EXPECT_EQ(strip.first, GrowEnd::kBorder);
    EXPECT_EQ(strip.last, GrowEnd::kBorder);
    fitter.forget();
    for (const Pose& pose : strip.poses) {
      const LineFit fit = fitter.measure(pose);
      EXPECT_TRUE(!fit.touches() || fit.largest_mm <= 1e-3) << fit.largest_mm;
    }
    // Where it enters and leaves, poses past the border follow an extrapolation: the joined motion is lifted there,
    // or cut off.
    const CoverSamples samples = cover_samples(*surface.exact.target, 1.5);
    const CoverStrip joined = measure_strip(samples, motion_through(strip.poses, 24.0, 48), surface.tool, fitter);
    const CoverStrip raised = lifted(samples, LineGuard(), joined, surface.tool, fitter);
    const CoverStrip covered = cut_to_certified(samples, LineGuard(), raised, surface.tool, fitter);
    EXPECT_TRUE(is_certified(LineGuard(), covered, 1e-3)) << covered.overcut_mm;
    EXPECT_GT(covered.area / samples.area, 0.92 * 24.0 / 40.0);
  }
}

TEST(Grow, StopsWhereTheToleranceEnds) {
  // A cylinder comes near a barrel's envelope, but not within this.
  const LongSurface surface;
  const RadialFunction radial = testing::cylinder(6.0, 24.0).radial;
  LineFitter fitter(*surface.exact.target, radial, {.tolerance_mm = 1e-5});
  const LineFit line = fitter.refine(surface.pose(0.5));
  ASSERT_GT(line.largest_mm, 1e-4);
  const GrownStrip strip = grow(fitter, LineGuard(), line, {});
  EXPECT_EQ(strip.poses.size(), 1u);
  EXPECT_EQ(strip.first, GrowEnd::kTolerance);
  EXPECT_EQ(strip.last, GrowEnd::kTolerance);
}

TEST(Grow, FollowsTheEdgeOfItsNeighbour) {
  const auto target = testing::flat_target(0.0, 60.0, 0.0, 40.0);
  const RadialFunction radial = testing::cylinder(5.0, 15.0).radial;
  // A neighbour that leans: its upper end runs from y = 16 to y = 22.
  std::vector<Pose> neighbour;
  for (int i = 0; i <= 20; ++i) neighbour.push_back({Vec3(3.0 * i, 1.0 + 0.3 * i, 5.0), Vec3::UnitY()});
  const GrowGuide guide{&neighbour, false, 0.5};
  LineFitter fitter(*target, radial, {.tolerance_mm = 1e-3});
  const LineFit line = fitter.refine({Vec3(30.0, 18.5, 5.0), Vec3::UnitY()});
  const GrownStrip strip = grow(fitter, LineGuard(), line, guide);
  ASSERT_GT(strip.poses.size(), 10u);
  for (const Pose& pose : strip.poses) {
    if (pose.tip.x() < 5.0 || pose.tip.x() > 55.0) continue;
    EXPECT_NEAR(pose.tip.y(), 16.0 + 0.1 * pose.tip.x() - 0.5, 0.4) << "x " << pose.tip.x();
  }
}

TEST(Grow, GuideSaysHowFarToSlide) {
  const std::vector<Pose> neighbour = {{Vec3(0.0, 0.0, 0.0), Vec3::UnitY()}, {Vec3(10.0, 2.0, 0.0), Vec3::UnitY()}};
  // Past the tip: the upper end, y = 1 + L, is to lie 0.5 above the edge, which is at y = 1 where x = 5.
  const Pose below{Vec3(5.0, 1.2 - 8.0, 0.0), Vec3::UnitY()};
  EXPECT_NEAR(guide_slide({&neighbour, true, 0.5}, below, 8.0), 0.3, 1e-9);
  const Pose above{Vec3(5.0, 9.4, 0.0), Vec3::UnitY()};
  EXPECT_NEAR(guide_slide({&neighbour, false, 0.5}, above, 8.0), -0.9, 1e-9);
  const Pose beside{Vec3(30.0, 0.0, 0.0), Vec3::UnitY()};
  EXPECT_EQ(guide_slide({&neighbour, true, 0.5}, beside, 8.0), 0.0);
}

}  // namespace
}  // namespace flank::internal
