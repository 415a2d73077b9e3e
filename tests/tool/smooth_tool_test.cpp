#include "flank/tool/smooth_tool.h"

#include <gtest/gtest.h>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

TEST(SmoothTool, ATooSharpValleyIsFilledAndLittleElse) {
  Eigen::VectorXd c = Eigen::VectorXd::Constant(24, 2.3);
  c[12] -= 0.03;
  const RadialFunction valley = RadialFunction::spline(2.44, c);
  ASSERT_FALSE(check_legitimacy(valley).legitimate);
  const auto smooth = smoothed_to_tool(valley, 0.05);
  ASSERT_TRUE(smooth);
  EXPECT_TRUE(check_legitimacy(*smooth).legitimate);
  const Eigen::VectorXd change = (smooth->parameters() - c).cwiseAbs();
  EXPECT_GT(change[12], 0.0);
  EXPECT_LT(change.maxCoeff(), 0.03);
  EXPECT_EQ(change[5], 0.0);
  EXPECT_EQ(change[18], 0.0);
}

TEST(SmoothTool, WavesOfManyKindsBecomeTools) {
  Random random(3);
  int mended = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const double length = random.uniform(1.0, 60.0), radius = random.uniform(0.05, 1.5) * length;
    Eigen::VectorXd c(24);
    // Up to where 1 - r'^2 - r r'' falls below zero at some of the coefficients.
    const double step = length / 21.0, wave = random.uniform(0.2, 2.0) * step * step / radius;
    for (double& value : c) value = radius + random.uniform(-0.5, 0.5) * wave;
    const RadialFunction radial = RadialFunction::spline(length, c);
    if (check_legitimacy(radial).legitimate) {
      EXPECT_EQ(smoothed_to_tool(radial, 0.0)->parameters(), c) << "a tool stays as it is";
      continue;
    }
    const auto smooth = smoothed_to_tool(radial, wave);
    ASSERT_TRUE(smooth) << trial;
    EXPECT_TRUE(check_legitimacy(*smooth).legitimate);
    ++mended;
  }
  EXPECT_GT(mended, 50);
}

TEST(SmoothTool, WhatTakesTooMuchIsLeft) {
  Eigen::VectorXd c = Eigen::VectorXd::Constant(24, 2.3);
  c[12] -= 0.03;
  EXPECT_FALSE(smoothed_to_tool(RadialFunction::spline(2.44, c), 1e-6));
  EXPECT_FALSE(smoothed_to_tool(RadialFunction(ToolFamily::kBarrel, 20.0, Eigen::Vector3d(2.0, 5.0, 0.0)), 10.0));
}

}  // namespace
}  // namespace flank::internal
