// Samples of a target, how often each is covered, and strips that are measured where they end or touch nothing.
#include <gtest/gtest.h>

#include <cmath>

#include "cover/cover_targets.h"
#include "flank/strip/strip_measure.h"
#include "flank/strip/strip_order.h"

namespace flank::internal {
namespace {

TEST(CoverSamples, SumUpToTheAreaAndSurroundIt) {
  const auto target = testing::flat_target(0.0, 30.0, 0.0, 20.0);
  for (const double spacing : {0.5, 2.0}) {
    const CoverSamples samples = cover_samples(*target, spacing);
    double sum = 0.0;
    for (const SurfaceSample& cell : samples.cells) sum += cell.area;
    EXPECT_EQ(samples.area, sum);
    EXPECT_NEAR(samples.area, 600.0, 1e-6);
    EXPECT_NEAR(static_cast<double>(samples.cells.size()), 600.0 / (spacing * spacing),
                0.2 * 600.0 / (spacing * spacing));
    EXPECT_GE(samples.border.size(), static_cast<std::size_t>(100.0 / (0.25 * spacing)) - 4u);
    for (const Vec3& x : samples.border) {
      const double off = std::min({x.x(), 30.0 - x.x(), x.y(), 20.0 - x.y()});
      EXPECT_NEAR(off, 0.0, 1e-6);
    }
  }
}

class Cells : public ::testing::Test {
 protected:
  Cells() {
    for (int k = 0; k < 6; ++k) {
      samples_.cells.push_back({Vec3(k, 0, 0), Vec3::UnitZ(), 1.0 + k});
      samples_.area += 1.0 + k;
    }
  }
  static CoverStrip strip(std::vector<int> cells) {
    CoverStrip strip;
    strip.cells = std::move(cells);
    return strip;
  }
  CoverSamples samples_;  ///< areas 1 to 6, 21 in all
};

TEST_F(Cells, AStripGainsWhatNothingElseCovers) {
  CellCount covered(samples_);
  EXPECT_NEAR(covered.gain(strip({0, 2})), 4.0 / 21.0, 1e-15);
  covered.add(strip({2, 3}));
  EXPECT_NEAR(covered.covered(), 7.0 / 21.0, 1e-15);
  EXPECT_NEAR(covered.gain(strip({0, 2})), 1.0 / 21.0, 1e-15);
  EXPECT_EQ(covered.gain(strip({3})), 0.0);
  EXPECT_EQ(covered.open(), (std::vector<std::size_t>{0, 1, 4, 5}));
}

TEST_F(Cells, WhatTwoCoverIsOpenWhenBothAreGone) {
  CellCount covered(samples_);
  covered.add(strip({1, 2}));
  covered.add(strip({2, 3}));
  covered.add(strip({1, 2}), -1);
  EXPECT_NEAR(covered.covered(), 7.0 / 21.0, 1e-15);
  covered.add(strip({2, 3}), -1);
  EXPECT_EQ(covered.covered(), 0.0);
  EXPECT_EQ(covered.open().size(), 6u);
}

class Measure : public ::testing::Test {
 protected:
  CoverStrip strip(double x0, double x1, double height, double y = 10.0) {
    std::vector<Pose> poses;
    std::vector<double> t;
    for (int i = 0; i <= 40; ++i) {
      t.push_back(i / 40.0);
      poses.push_back({Vec3(x0 + (x1 - x0) * t.back(), y, 5.0 + height), Vec3::UnitY()});
    }
    return measure_strip(samples_, fit_motion(poses, t, 20.0, 8), radial_, fitter_);
  }
  std::unique_ptr<Target> target_ = testing::flat_target(0.0, 60.0, 0.0, 40.0);
  RadialFunction radial_ = testing::cylinder(5.0, 20.0).radial;
  CoverSamples samples_ = cover_samples(*target_, 0.8);
  LineFitter fitter_{*target_, radial_, {.tolerance_mm = 0.02}};
};

TEST_F(Measure, EachCellIsWhatTheSweptCylinderLeavesThere) {
  const CoverStrip half = strip(10.0, 35.0, 0.005);
  std::vector<int> expected;
  for (std::size_t k = 0; k < samples_.cells.size(); ++k) {
    // The axis sweeps the rectangle 10 < x < 35, 10 < y < 30 at height 5.005.
    const Vec3 x = samples_.cells[k].point;
    const double dx = std::max({10.0 - x.x(), x.x() - 35.0, 0.0}), dy = std::max({10.0 - x.y(), x.y() - 30.0, 0.0});
    if (std::abs(std::sqrt(dx * dx + dy * dy + 5.005 * 5.005) - 5.0) <= 0.02) expected.push_back(static_cast<int>(k));
  }
  EXPECT_GT(expected.size(), 500u);
  EXPECT_EQ(half.cells, expected);
  EXPECT_EQ(half.overcut_mm, 0.0);
}

TEST_F(Measure, AStripThatTouchesNothingCoversNothing) {
  const CoverStrip high = strip(0.0, 60.0, 0.1);
  EXPECT_TRUE(high.cells.empty());
  EXPECT_EQ(high.area, 0.0);
  EXPECT_EQ(high.overcut_mm, 0.0);
  EXPECT_TRUE(high.deep.empty());
  const CoverStrip beside = strip(0.0, 60.0, 0.0, 100.0);
  EXPECT_TRUE(beside.cells.empty());
}

TEST_F(Measure, DepthsAreThoseOfTheirPoses) {
  const CoverStrip deep = strip(5.0, 55.0, -0.03);
  ASSERT_EQ(static_cast<int>(deep.depths.size()), depth_poses(deep.motion) + 1);
  for (const double depth : deep.depths) EXPECT_NEAR(depth, 0.03, 1e-6);
  EXPECT_NEAR(deep.overcut_mm, 0.03, 1e-6);
  EXPECT_FALSE(deep.deep.empty());
  for (const SweptContact& at : deep.deep) EXPECT_LT(at.f, -0.8 * 0.02);
}

TEST_F(Measure, RunBackwardsItCoversTheSame) {
  const CoverStrip there = strip(10.0, 35.0, -0.004);
  const CoverStrip back = measure_strip(samples_, reversed(there.motion), radial_, fitter_);
  EXPECT_EQ(back.cells, there.cells);
  EXPECT_NEAR(back.overcut_mm, there.overcut_mm, 1e-9);
}

TEST(DepthPoses, GrowWithTheControlPointsUpToABound) {
  RuledMotion motion = testing::straight_motion(10.0);
  EXPECT_EQ(depth_poses(motion), 32);
  motion.tip.poles.resize(3, 40);
  EXPECT_EQ(depth_poses(motion), 320);
  motion.tip.poles.resize(3, 500);
  EXPECT_EQ(depth_poses(motion), 384);
}

}  // namespace
}  // namespace flank::internal
