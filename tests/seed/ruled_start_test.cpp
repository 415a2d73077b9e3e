// Candidate motions across a target: axis lines where they have closed forms, and the motion through them.
#include "flank/seed/ruled_start.h"

#include <gtest/gtest.h>

#include <cmath>

#include "seed/sheet.h"

namespace flank::internal {
namespace {

using testing::rectangle;
using testing::sheet;

/// Lines of time t reach 2 % past both borders.
double share_at(double t) { return 0.5 + 1.04 * (t - 0.5); }

class SquareStart : public ::testing::Test {
 protected:
  Chart chart_ = Chart(*make_target({rectangle(0.0, 0.0, 40.0, 40.0)}));
  RuledStart start_{.radius_mm = 6.0};
};

TEST_F(SquareStart, AnAxisLineLiesARadiusAboveItsContactLine) {
  for (const double t : {0.0, 0.3, 1.0}) {
    const auto line = axis_line(chart_, start_, t);
    EXPECT_NEAR((line.middle - Vec3(40.0 * share_at(t), 20.0, 6.0)).norm(), 0.0, 1e-3) << t;
    EXPECT_NEAR((line.direction - Vec3::UnitY()).norm(), 0.0, 1e-6) << "along increasing b";
    EXPECT_NEAR(line.length, 40.0, 1e-3);
  }
}

TEST_F(SquareStart, SwappedExchangesAxisAndTravel) {
  start_.swapped = true;
  for (const double t : {0.1, 0.8}) {
    const auto line = axis_line(chart_, start_, t);
    EXPECT_NEAR((line.middle - Vec3(20.0, 40.0 * share_at(t), 6.0)).norm(), 0.0, 1e-3);
    EXPECT_NEAR((line.direction - Vec3::UnitX()).norm(), 0.0, 1e-6);
  }
}

TEST_F(SquareStart, ABandIsItsShareOfTheWidth) {
  start_.band_low = 0.25;
  start_.band_high = 0.5;
  const auto line = axis_line(chart_, start_, 0.5);
  EXPECT_NEAR((line.middle - Vec3(20.0, 15.0, 6.0)).norm(), 0.0, 1e-3);
  EXPECT_NEAR(line.length, 10.0, 1e-3);
}

TEST_F(SquareStart, TheSkewIsAnAngleInTheSurface) {
  for (const bool swapped : {false, true}) {
    for (const double skew : {-0.4, 0.2, 0.5}) {
      start_.swapped = swapped;
      start_.skew_rad = skew;
      const auto line = axis_line(chart_, start_, 0.5);
      const Vec3 wanted =
          swapped ? Vec3(std::cos(skew), std::sin(skew), 0.0) : Vec3(std::sin(skew), std::cos(skew), 0.0);
      EXPECT_NEAR((line.direction - wanted).norm(), 0.0, 1e-4) << skew;
      EXPECT_NEAR((line.middle - Vec3(20.0, 20.0, 6.0)).norm(), 0.0, 1e-3) << "turned about its middle";
      EXPECT_NEAR(line.length, 40.0 / std::cos(skew), 1e-2);
    }
  }
}

TEST_F(SquareStart, ASkewThatWouldRunOffTheTargetIsLimited) {
  start_.skew_rad = 1.3;
  const auto line = axis_line(chart_, start_, 0.5);
  EXPECT_NEAR(std::atan2(line.direction.x(), line.direction.y()), std::atan(0.6), 1e-4);
}

TEST_F(SquareStart, SkewedLinesSweepTheCornersToo) {
  for (const double skew : {-0.4, 0.4}) {
    start_.skew_rad = skew;
    // The first line ends 2 % left of the left border, and the last one starts as far past the right one.
    for (const double t : {0.0, 1.0}) {
      const auto line = axis_line(chart_, start_, t);
      const double lean = 20.0 * std::abs(std::tan(skew));
      EXPECT_NEAR(line.middle.x() + (t == 0.0 ? lean : -lean), t == 0.0 ? -0.8 : 40.8, 5e-2) << t << " " << skew;
    }
  }
}

TEST_F(SquareStart, TheLongestChordIsThatOfTheLongestLine) {
  EXPECT_NEAR(longest_chord(chart_, start_), 40.0, 1e-2);
  start_.skew_rad = 0.3;
  EXPECT_NEAR(longest_chord(chart_, start_), 40.0 / std::cos(0.3), 1e-2);
  // A sheet that widens from 20 to 50 mm.
  const Chart wedge(
      *make_target({sheet([](double u, double v) { return Vec3(40.0 * u, (20.0 + 30.0 * u) * v, 0.0); })}));
  EXPECT_NEAR(longest_chord(wedge, {.radius_mm = 6.0}), 50.0 + 0.02 * 30.0, 1.5);
}

TEST_F(SquareStart, TheMotionPassesThroughItsLines) {
  const RuledMotion motion = make_motion(chart_, start_, 50.0, 12);
  EXPECT_EQ(motion.axis_length, 50.0);
  EXPECT_EQ(motion.tip.count(), 12);
  for (const double t : {0.0, 0.21, 0.5, 1.0}) {
    const Pose pose = motion.pose(t);
    EXPECT_NEAR((pose.tip - Vec3(40.0 * share_at(t), 20.0 - 25.0, 6.0)).norm(), 0.0, 1e-3) << "centred";
    EXPECT_NEAR((pose.axis - Vec3::UnitY()).norm(), 0.0, 1e-6);
  }
}

TEST(RuledStart, ASkewIsAnAngleOnARectangleToo) {
  const Chart chart(*make_target({rectangle(0.0, 0.0, 80.0, 40.0)}));
  const auto line = axis_line(chart, {.skew_rad = 0.3, .radius_mm = 5.0}, 0.5);
  EXPECT_NEAR(std::atan2(line.direction.x(), line.direction.y()), 0.3, 0.02);
}

TEST(RuledStart, RollsRoundACylinder) {
  // Lines of constant u are the cylinder's own lines: the axis stays parallel to it, radius + r from its middle.
  constexpr double kRadius = 30.0, kTool = 4.0;
  const Face face =
      sheet([](double u, double v) { return Vec3(kRadius * std::cos(u), kRadius * std::sin(u), 30.0 * v); });
  const Chart chart(*make_target({face}));
  const RuledMotion motion = make_motion(chart, {.radius_mm = kTool}, 20.0, 16);
  for (const double t : {0.05, 0.4, 0.95}) {
    const Pose pose = motion.pose(t);
    EXPECT_NEAR((pose.axis - Vec3::UnitZ()).norm(), 0.0, 1e-3);
    EXPECT_NEAR(pose.tip.head<2>().norm(), kRadius + kTool, 1e-2);
    EXPECT_NEAR(pose.tip.z(), 5.0, 0.05);
    EXPECT_NEAR(std::atan2(pose.tip.y(), pose.tip.x()), share_at(t), 5e-3);
  }
}

TEST(RuledStart, TheFittedLineSharesItsErrorEvenly) {
  // Across a cylinder of radius 30 the offset contact line is an arc of radius 34, half a radian to each side: the line
  // fitted to it is parallel to its chord and lies between chord and crown.
  constexpr double kRadius = 30.0, kTool = 4.0;
  const Face face =
      sheet([](double u, double v) { return Vec3(kRadius * std::cos(u), kRadius * std::sin(u), 30.0 * v); });
  const auto line = axis_line(Chart(*make_target({face})), {.swapped = true, .radius_mm = kTool}, 0.5);
  const Vec3 crown(std::cos(0.5), std::sin(0.5), 0.0), chord(-std::sin(0.5), std::cos(0.5), 0.0);
  EXPECT_NEAR((line.direction - chord).norm(), 0.0, 1e-3);
  EXPECT_LT(line.middle.dot(crown), kRadius + kTool);
  EXPECT_GT(line.middle.dot(crown), (kRadius + kTool) * std::cos(0.5));
  EXPECT_NEAR(line.middle.dot(crown), (kRadius + kTool) * std::sin(0.5) / 0.5, 0.3) << "the mean of the arc";
  EXPECT_NEAR(line.length, 2.0 * (kRadius + kTool) * std::sin(0.5), 0.1);
}

}  // namespace
}  // namespace flank::internal
