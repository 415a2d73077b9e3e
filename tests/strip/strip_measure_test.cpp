// Strips as motions: interpolation, stretches, coverage and overcut where they are known.
#include "flank/strip/strip_measure.h"

#include <gtest/gtest.h>

#include "cover/cover_targets.h"
#include "flank/strip/certify.h"

namespace flank::internal {
namespace {

/// The ball-ended cylinder of radius 5 over the plane z = 0, at height 5 - depth(x), its axis along y from `y` on.
RuledMotion over_plane(double depth_in_the_middle, double y = 10.0) {
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int i = 0; i <= 60; ++i) {
    t.push_back(i / 60.0);
    const double x = 60.0 * t.back(), bump = std::exp(-std::pow((x - 40.0) / 4.0, 2));
    poses.push_back({Vec3(x, y, 5.0 - depth_in_the_middle * bump), Vec3::UnitY()});
  }
  return fit_motion(poses, t, 20.0, 40);
}

class StripCover : public ::testing::Test {
 protected:
  std::unique_ptr<Target> target_ = testing::flat_target(0.0, 60.0, 0.0, 40.0);
  RadialFunction radial_ = testing::cylinder(5.0, 20.0).radial;
  CoverSamples samples_ = cover_samples(*target_, 0.5);
  LineFitter fitter_{*target_, radial_, {.tolerance_mm = 0.01}};
};

TEST_F(StripCover, CoversWhatItSweeps) {
  const CoverStrip strip = measure_strip(samples_, over_plane(0.0), radial_, fitter_);
  // 20 mm, and what the balls at its ends leave within 0.01 mm: sqrt(2 * 5 * 0.01) each.
  EXPECT_NEAR(strip.area, 60.0 * (20.0 + 2.0 * 0.316), 60.0);
  EXPECT_NEAR(strip.overcut_mm, 0.0, 1e-6);
}

TEST_F(StripCover, MeasuresOvercut) {
  const CoverStrip strip = measure_strip(samples_, over_plane(0.05), radial_, fitter_);
  EXPECT_NEAR(strip.overcut_mm, 0.05, 2e-3);
}

TEST(MeasureStrip, SeesARidgeBetweenTheSamplesOfTheAxis) {
  // 0.05 mm high and 0.3 mm wide, along the path; the samples of the axis are 1.25 mm apart.
  std::vector<double> u, v;
  for (int i = 0; i <= 8; ++i) u.push_back(i / 8.0);
  for (int j = 0; j <= 400; ++j) v.push_back(j / 400.0);
  std::vector<Vec3> points;
  for (const double a : u)
    for (const double b : v)
      points.emplace_back(10.0 * a, 40.0 * b, 0.05 * std::exp(-std::pow((40.0 * b - 15.625) / 0.15, 2)));
  Face face;
  face.id = "F1";
  face.surface = interpolate_grid(points, u, v, 3);
  const auto target = make_target(std::vector<Face>{face});
  const RadialFunction radial = testing::cylinder(5.0, 20.0).radial;
  LineFitter fitter(*target, radial, {.tolerance_mm = 0.02});
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int i = 0; i <= 20; ++i) {
    t.push_back(i / 20.0);
    poses.push_back({Vec3(10.0 * t.back(), 10.0, 5.0), Vec3::UnitY()});
  }
  const CoverSamples samples = cover_samples(*target, 0.1);
  const CoverStrip strip = measure_strip(samples, fit_motion(poses, t, 20.0, 8), radial, fitter);
  EXPECT_NEAR(strip.overcut_mm, 0.05, 3e-3);
  const CoverStrip up = lifted(samples, PoseGuard(), strip, radial, fitter);
  EXPECT_LE(up.overcut_mm, 0.02);
}

TEST_F(StripCover, CutsOvercutOff) {
  const CoverStrip whole = measure_strip(samples_, over_plane(0.05), radial_, fitter_);
  EXPECT_FALSE(is_certified(PoseGuard(), whole, 0.01));
  const CoverStrip strip = cut_to_certified(samples_, PoseGuard(), whole, radial_, fitter_);
  EXPECT_TRUE(is_certified(PoseGuard(), strip, 0.01));
  EXPECT_LE(strip.overcut_mm, 0.0101);
  EXPECT_LT(strip.motion.pose(1.0).tip.x(), 36.0) << "the longer stretch is the one before the middle";
  EXPECT_GT(strip.motion.pose(1.0).tip.x(), 30.0);
  EXPECT_NEAR(strip.motion.pose(0.0).tip.x(), 0.0, 1e-6);
}

TEST_F(StripCover, LiftsWhatIsALittleTooDeep) {
  const CoverStrip whole = measure_strip(samples_, over_plane(0.014), radial_, fitter_);
  ASSERT_FALSE(is_certified(PoseGuard(), whole, 0.01));
  const CoverStrip strip = lifted(samples_, PoseGuard(), whole, radial_, fitter_);
  EXPECT_TRUE(is_certified(PoseGuard(), strip, 0.01)) << strip.overcut_mm;
  EXPECT_GT(strip.area, 0.99 * whole.area);
  EXPECT_NEAR(strip.motion.pose(0.1).tip.z(), 5.0, 1e-4) << "nothing is lifted elsewhere";
}

TEST_F(StripCover, SlidesAwayFromAnObstacleThatATipEnters) {
  // A block whose wall bulges towards the tips, by 0.05 mm about x = 40.
  Obstacles obstacles;
  ObstacleMesh wall;
  for (int i = 0; i <= 120; ++i) {
    const double x = 0.5 * i, y = 5.0 - 0.05 * (1.0 - std::exp(-std::pow((x - 40.0) / 4.0, 2)));
    wall.mesh.vertices.emplace_back(x, y, -1.0);
    wall.mesh.vertices.emplace_back(x, y, 12.0);
    if (i == 0) continue;
    const int k = 2 * i;
    wall.mesh.triangles.push_back({k - 2, k - 1, k});
    wall.mesh.triangles.push_back({k - 1, k + 1, k});
  }
  obstacles.meshes.push_back(wall);
  const PoseGuard guard(testing::cylinder(5.0, 20.0), obstacles, -0.005);
  const CoverStrip whole = measure_strip(samples_, over_plane(0.0, 9.98), radial_, fitter_);
  ASSERT_FALSE(is_certified(guard, whole, 0.01)) << "0.02 mm into the bulge";
  const CoverStrip strip = lifted(samples_, guard, whole, radial_, fitter_);
  EXPECT_TRUE(is_certified(guard, strip, 0.01));
  EXPECT_GT(strip.area, 0.995 * whole.area);
  EXPECT_NEAR(strip.motion.pose(0.1).tip.y(), 9.98, 1e-4) << "it slides nowhere else";
  EXPECT_GT(strip.motion.pose(2.0 / 3.0).tip.y(), 9.99);
}

TEST_F(StripCover, CutsOffWhatEntersAnObstacle) {
  Obstacles obstacles;
  ObstacleMesh wall;
  wall.mesh = {{Vec3(50.0, -50.0, -50.0), Vec3(50.0, 80.0, -50.0), Vec3(50.0, 0.0, 90.0)}, {{0, 1, 2}}};
  obstacles.meshes.push_back(wall);
  const PoseGuard guard(testing::cylinder(5.0, 20.0), obstacles, -0.005);
  const CoverStrip whole = measure_strip(samples_, over_plane(0.0), radial_, fitter_);
  const CoverStrip strip = cut_to_certified(samples_, guard, whole, radial_, fitter_);
  ASSERT_FALSE(strip.cells.empty());
  EXPECT_NEAR(strip.motion.pose(1.0).tip.x(), 44.5, 0.6);
}

TEST_F(StripCover, PosesAreJoinedSmoothly) {
  const RuledMotion exact = testing::bent_motion(20.0);
  std::vector<Pose> poses;
  // Steps that differ, as those of a strip do.
  for (int i = 0; i <= 24; ++i) poses.push_back(exact.pose((i + 0.3 * std::sin(i)) / 24.3));
  const RuledMotion joined = motion_through(poses, 20.0, 48);
  for (int i = 0; i <= 200; ++i) {
    const Pose at = joined.pose(i / 200.0);
    double least = 1e300;
    for (int k = 0; k <= 2000; ++k) least = std::min(least, (exact.pose(k / 2000.0).tip - at.tip).norm());
    EXPECT_LT(least, 0.02);
  }
}

TEST_F(StripCover, PartOfAMotion) {
  const RuledMotion motion = testing::bent_motion(20.0), part = part_of_motion(motion, 0.25, 0.75);
  EXPECT_LT((part.pose(0.5).tip - motion.pose(0.5).tip).norm(), 1e-6);
  EXPECT_LT((part.pose(0.0).tip - motion.pose(0.25).tip).norm(), 1e-6);
  EXPECT_LT((part.pose(1.0).axis - motion.pose(0.75).axis).norm(), 1e-5);
}

}  // namespace
}  // namespace flank::internal
