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
    const GrownStrip strip = grow(fitter, PoseGuard(), line, {});
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
    const CoverStrip raised = lifted(samples, PoseGuard(), joined, surface.tool, fitter);
    const CoverStrip covered = cut_to_certified(samples, PoseGuard(), raised, surface.tool, fitter);
    EXPECT_TRUE(is_certified(PoseGuard(), covered, 1e-3)) << covered.overcut_mm;
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
  const GrownStrip strip = grow(fitter, PoseGuard(), line, {});
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
  const GrownStrip strip = grow(fitter, PoseGuard(), line, guide);
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

/// A cylinder over the plane 0 <= x <= 60, 0 <= y <= 40, its axis along y.
class GrowOnAPlane : public ::testing::Test {
 protected:
  GrownStrip run(const PoseGuard& guard, const Pose& pose, const GrowOptions& options = {}) {
    LineFitter fitter(*target_, tool_.radial, {.tolerance_mm = 1e-3});
    const LineFit line = fitter.refine(pose);
    EXPECT_LE(line.largest_mm, 1e-3);
    return grow(fitter, guard, line, {}, options);
  }
  std::unique_ptr<Target> target_ = testing::flat_target(0.0, 60.0, 0.0, 40.0);
  Tool tool_ = testing::cylinder(5.0, 15.0);
  Pose line_{Vec3(25.0, 12.0, 5.0), Vec3::UnitY()};
};

TEST_F(GrowOnAPlane, StepsAreWithinTheirBoundsAndGoOneWay) {
  const GrownStrip strip = run({}, line_);
  EXPECT_EQ(strip.first, GrowEnd::kBorder);
  EXPECT_EQ(strip.last, GrowEnd::kBorder);
  const double size = target_->diagonal();
  const double way = (strip.poses.back().tip - strip.poses.front().tip).x() > 0.0 ? 1.0 : -1.0;
  for (std::size_t k = 0; k + 1 < strip.poses.size(); ++k) {
    const Vec3 step = strip.poses[k + 1].tip - strip.poses[k].tip;
    EXPECT_GT(way * step.x(), 0.0);
    EXPECT_LE(step.norm(), 0.5 * 0.06 * size * 1.01 + 1e-9) << "with the middle of each step";
    EXPECT_NEAR(strip.poses[k].tip.z(), 5.0, 1e-3);
  }
  const double low = std::min(strip.poses.front().tip.x(), strip.poses.back().tip.x());
  const double high = std::max(strip.poses.front().tip.x(), strip.poses.back().tip.x());
  EXPECT_LT(low, 0.0);
  EXPECT_GT(low, -0.031 * size) << "a first step and the overrun";
  EXPECT_GT(high, 60.0);
  EXPECT_LT(high, 60.0 + 0.031 * size);
}

TEST_F(GrowOnAPlane, StopsBeforeAWall) {
  const Obstacles wall = testing::triangle_obstacle(Vec3(45, -60, -1), Vec3(45, 100, -1), Vec3(45, 20, 90));
  const PoseGuard guard(tool_, wall, -1e-4);
  const GrownStrip strip = run(guard, line_);
  const bool forward = strip.poses.back().tip.x() > strip.poses.front().tip.x();
  EXPECT_EQ(forward ? strip.last : strip.first, GrowEnd::kCheck);
  EXPECT_EQ(forward ? strip.first : strip.last, GrowEnd::kBorder);
  for (const Pose& pose : strip.poses) EXPECT_TRUE(guard.clear(pose));
  const double last = std::max(strip.poses.front().tip.x(), strip.poses.back().tip.x());
  EXPECT_LE(last, 40.0 + 1e-3);
  EXPECT_GT(last, 40.0 - 0.01 * target_->diagonal()) << "the shortest step is 0.004 of the diagonal";
}

TEST_F(GrowOnAPlane, EndsWhereItHasTravelledEnough) {
  const GrownStrip strip = run({}, line_, {.longest_travel_share = 0.2});
  EXPECT_EQ(strip.first, GrowEnd::kTravel);
  EXPECT_EQ(strip.last, GrowEnd::kTravel);
  const double way = (strip.poses.back().tip - strip.poses.front().tip).norm(), size = target_->diagonal();
  EXPECT_GE(way, 2.0 * 0.2 * size - 1e-6);
  EXPECT_LE(way, 2.0 * 0.26 * size + 1e-6);
}

TEST_F(GrowOnAPlane, TheLineItselfIsPartOfTheStrip) {
  const GrownStrip strip = run({}, line_);
  const auto same = [&](const Pose& pose) {
    return (pose.tip - line_.tip).norm() + (pose.axis - line_.axis).norm() < 1e-6;
  };
  EXPECT_EQ(std::count_if(strip.poses.begin(), strip.poses.end(), same), 1);
}

}  // namespace
}  // namespace flank::internal
