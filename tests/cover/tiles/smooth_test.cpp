// SMOOTH on a plane: strips that are right stay right, what was left is taken away, and nothing leaves uncertified.
#include "flank/cover/tiles/smooth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "cover/cover_targets.h"
#include "flank/strip/certify.h"
#include "flank/threads.h"

namespace flank::internal {
namespace {

constexpr double kTolerance = 0.01, kRadius = 4.0, kLength = 16.0;

/// A cylinder 16 mm long over the plane z = 0, 40 x 20 mm, its axis along y from y = 2 on.
class Smooth : public ::testing::Test {
 protected:
  Smooth() {
    options_.tolerance_mm = kTolerance;
    options_.control_points = 12;
  }
  TileScene scene() const { return {*target_, tool_.radial, samples_, guard_, options_}; }
  /// A strip whose axis is at height radius + height(x).
  CoverStrip strip(const std::function<double(double)>& height, double y = 2.0) const {
    std::vector<Pose> poses;
    std::vector<double> t;
    for (int i = 0; i <= 80; ++i) {
      t.push_back(i / 80.0);
      const double x = 40.0 * t.back();
      poses.push_back({Vec3(x, y, kRadius + height(x)), Vec3::UnitY()});
    }
    LineFitter fitter(*target_, tool_.radial, line_options(scene()));
    return measure_strip(samples_, fit_motion(poses, t, kLength, 20), tool_.radial, fitter);
  }
  /// Certified, by poses that the planner has not looked at.
  void expect_fine(const std::vector<CoverStrip>& strips) const {
    for (const CoverStrip& strip : strips) {
      EXPECT_TRUE(is_certified(guard_, strip, kTolerance)) << strip.overcut_mm;
      for (int i = 0; i <= 1000; ++i) {
        const Pose pose = strip.motion.pose(i / 1000.0);
        for (const Vec3& end : {pose.tip, pose.at(kLength)}) {
          const double dx = std::max({-end.x(), end.x() - 40.0, 0.0}), dy = std::max({-end.y(), end.y() - 20.0, 0.0});
          EXPECT_GE(Vec3(dx, dy, end.z()).norm(), kRadius - kTolerance) << i << ": " << end.transpose();
        }
      }
    }
  }

  std::unique_ptr<Target> target_ = testing::flat_target(0.0, 40.0, 0.0, 20.0);
  Tool tool_ = testing::cylinder(kRadius, kLength);
  CoverSamples samples_ = cover_samples(*target_, 0.8);
  PoseGuard guard_;
  CoverOptions options_;
};

TEST_F(Smooth, CoveredShareCountsEveryCellOnce) {
  CoverSamples samples;
  for (int k = 0; k < 10; ++k) samples.cells.push_back({Vec3::Zero(), Vec3::UnitZ(), k < 5 ? 1.0 : 3.0});
  samples.area = 20.0;
  std::vector<CoverStrip> strips(2);
  EXPECT_EQ(covered_share(samples, {}), 0.0);
  strips[0].cells = {0, 1, 2};
  strips[1].cells = {1, 2, 9};
  EXPECT_NEAR(covered_share(samples, strips), 6.0 / 20.0, 1e-15);
  EXPECT_EQ(covered_share(CoverSamples{}, {}), 0.0) << "no area, no share";
}

TEST_F(Smooth, RemeasuredIsMeasuredAfresh) {
  const CoverStrip right = strip([](double) { return 0.0; });
  CoverStrip wrong = right;
  wrong.cells = {0};
  wrong.area = 1e9;
  wrong.overcut_mm = 7.0;
  const std::vector<CoverStrip> again = remeasured(scene(), {wrong, right});
  ASSERT_EQ(again.size(), 2u);
  for (const CoverStrip& strip : again) {
    EXPECT_EQ(strip.cells, right.cells);
    EXPECT_EQ(strip.area, right.area);
    EXPECT_EQ(strip.overcut_mm, right.overcut_mm);
    EXPECT_EQ(strip.motion.tip.poles, right.motion.tip.poles);
  }
}

TEST_F(Smooth, AStripThatIsRightStaysRightFromEndToEnd) {
  const CoverStrip right = strip([](double) { return 0.0; });
  const SmoothResult result = smooth_strips(scene(), {right});
  ASSERT_EQ(result.strips.size(), 1u);
  expect_fine(result.strips);
  EXPECT_NEAR(result.coverage, covered_share(samples_, result.strips), 1e-12);
  EXPECT_GE(result.coverage, covered_share(samples_, {right}) - 2e-3);
  const RuledMotion& motion = result.strips[0].motion;
  EXPECT_NEAR(motion.pose(0.0).at(8.0).x(), 0.0, 1.0) << "it begins where it began";
  EXPECT_NEAR(motion.pose(1.0).at(8.0).x(), 40.0, 1.0) << "and ends where it ended";
}

TEST_F(Smooth, TakesAwayWhatAStripHasLeft) {
  // In the middle it is 0.04 mm too high.
  const CoverStrip high = strip([](double x) { return 0.04 * std::exp(-std::pow((x - 20.0) / 4.0, 2)); });
  const double ideal = covered_share(samples_, {strip([](double) { return 0.0; })});
  ASSERT_LT(covered_share(samples_, {high}), 0.9 * ideal);
  const SmoothResult result = smooth_strips(scene(), {high});
  expect_fine(result.strips);
  EXPECT_GE(result.coverage, 0.995 * ideal);
}

TEST_F(Smooth, StripsShareTheWork) {
  // Two strips, each of which has left another half.
  const auto left = [](double x) { return x < 20.0 ? 0.0 : 0.03 * (x - 20.0) / 20.0; };
  const auto right = [](double x) { return x > 20.0 ? 0.0 : 0.03 * (20.0 - x) / 20.0; };
  const std::vector<CoverStrip> strips = {strip(left, 0.5), strip(right, 3.5)};
  const double before = covered_share(samples_, strips);
  const SmoothResult result = smooth_strips(scene(), strips);
  ASSERT_EQ(result.strips.size(), 2u);
  expect_fine(result.strips);
  EXPECT_GT(result.coverage, before + 0.01);
}

TEST_F(Smooth, KeepsClearOfAWallBesideTheTips) {
  // The tips' balls, from y = -2 on, run along a wall at y = -2.02.
  Obstacles wall;
  ObstacleMesh surface;
  surface.mesh = {{Vec3(-90.0, -2.02, -1.0), Vec3(140.0, -2.02, -1.0), Vec3(25.0, -2.02, 120.0)}, {{0, 1, 2}}};
  wall.meshes.push_back(surface);
  guard_ = PoseGuard(tool_, wall, -0.0065);
  const CoverStrip high = strip([](double x) { return 0.02 * std::exp(-std::pow((x - 20.0) / 4.0, 2)); });
  ASSERT_TRUE(is_certified(guard_, high, kTolerance));
  const SmoothResult result = smooth_strips(scene(), {high});
  expect_fine(result.strips);
  EXPECT_GE(result.coverage, covered_share(samples_, {high}) - 2e-3);
}

TEST_F(Smooth, RailsHaveNoMoreControlPointsThanTheOptionsAllow) {
  const CoverStrip high = strip([](double x) { return 0.04 * std::exp(-std::pow((x - 20.0) / 4.0, 2)); });
  for (const int count : {8, 12}) {
    options_.control_points = count;
    for (const CoverStrip& smooth : smooth_strips(scene(), {high}).strips)
      EXPECT_LE(smooth.motion.tip.count(), 2 * count) << "twice as many where a certificate fails";
  }
}

TEST_F(Smooth, SameForAnyNumberOfThreads) {
  const std::vector<CoverStrip> strips = {strip([](double x) { return 0.001 * x; }, 0.5),
                                          strip([](double x) { return 0.03 - 0.001 * x; }, 3.5)};
  set_thread_count(1);
  const SmoothResult one = smooth_strips(scene(), strips);
  set_thread_count(3);
  const SmoothResult three = smooth_strips(scene(), strips);
  set_thread_count(0);
  EXPECT_EQ(one.coverage, three.coverage);
  ASSERT_EQ(one.strips.size(), three.strips.size());
  for (std::size_t k = 0; k < one.strips.size(); ++k) {
    EXPECT_EQ(one.strips[k].motion.tip.poles, three.strips[k].motion.tip.poles);
    EXPECT_EQ(one.strips[k].motion.direction.poles, three.strips[k].motion.direction.poles);
  }
}

}  // namespace
}  // namespace flank::internal
