// How sharply a motion turns: closed forms of a corner, a pivot, a circle, and poses that hide a corner.
#include "flank/path/turning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace flank::internal {
namespace {

constexpr double kLength = 30.0, kDegree = std::numbers::pi / 180.0;

/// An upright axis along x, and from `at` on turned by an angle in the plane.
std::vector<Pose> corner(double at, double angle, double step) {
  std::vector<Pose> poses;
  for (double x = 0.0; x < at; x += step) poses.push_back({{x, 0.0, 0.0}, Vec3::UnitZ()});
  for (double x = 0.0; x <= at; x += step)
    poses.push_back({{at + x * std::cos(angle), x * std::sin(angle), 0.0}, Vec3::UnitZ()});
  return poses;
}

TEST(Turning, ACornerIsTheAngleBetweenItsLegsHoweverDenseItsPosesAre) {
  for (const double step : {5.0, 1.0, 0.1})
    EXPECT_NEAR(sharpest_turn(corner(20.0, 25.0 * kDegree, step), kLength, 8.0).angle_rad, 25.0 * kDegree, 1e-9)
        << step;
}

TEST(Turning, ACornerBetweenStepsThatAreLongerThanTheWindowIsOne) {
  for (const double window : {8.0, 1.0, 0.1})
    EXPECT_NEAR(sharpest_turn(corner(20.0, 25.0 * kDegree, 10.0), kLength, window).angle_rad, 25.0 * kDegree, 1e-9)
        << window;
}

TEST(Turning, ALongStepThatTurnsEvenlyHasNoCornerAtItsEnds) {
  // Ten degrees a step about the tip: the upper end goes round a circle, and a twentieth of it is in the window.
  std::vector<Pose> poses;
  for (int k = 0; k <= 9; ++k)
    poses.push_back({Vec3::Zero(), {std::sin(10.0 * k * kDegree), 0.0, std::cos(10.0 * k * kDegree)}});
  EXPECT_LT(sharpest_turn(poses, kLength, 0.05 * kLength).angle_rad, 6.0 * kDegree);
}

TEST(Turning, WhatAProgramRoundsIsNoTurn) {
  std::vector<Pose> poses;
  for (int k = 0; k <= 2000; ++k) poses.push_back({{0.01 * k, k % 2 == 0 ? 0.0 : 0.001, 0.0}, Vec3::UnitZ()});
  // Two roundings over a chord; between the poses themselves it is 11 degrees.
  EXPECT_LT(sharpest_turn(poses, kLength, 1.0).angle_rad, 2.0 * 0.001 / 0.1);
}

TEST(Turning, ACircleTurnsByTheWindowOverItsRadius) {
  const double radius = 50.0;
  std::vector<Pose> poses;
  for (int k = 0; k <= 4000; ++k) {
    const double a = k / 2000.0;
    poses.push_back({{radius * std::cos(a), radius * std::sin(a), 0.0}, Vec3::UnitZ()});
  }
  // Both ends move: a window of sqrt(2) L is L of the circle.
  EXPECT_NEAR(sharpest_turn(poses, kLength, turn_window(100.0)).angle_rad, 1.0 / radius, 1e-3 / radius + 1e-4);
}

TEST(Turning, APivotAboutTheTipIsNone) {
  std::vector<Pose> poses;
  for (int k = 0; k <= 100; ++k) {
    const double a = 0.2 * k / 100.0;
    poses.push_back({Vec3::Zero(), {std::sin(a), 0.0, std::cos(a)}});
  }
  EXPECT_LT(sharpest_turn(poses, kLength, 1.0).angle_rad, 2.0 * kDegree);
}

TEST(Turning, AWayBackIsHalfATurnAndNamesItsPlace) {
  std::vector<Pose> poses = corner(10.0, 0.0, 1.0);
  for (double x = 19.0; x > 5.0; x -= 1.0) poses.push_back({{x, 0.0, 0.0}, Vec3::UnitZ()});
  Path path;
  path.strips.emplace_back().poses = corner(10.0, 0.1, 1.0);
  path.strips.emplace_back().poses = poses;
  const Turning turn = sharpest_turn(path, kLength, [](const Strip&) { return 2.0; });
  EXPECT_NEAR(turn.angle_rad, std::numbers::pi, 1e-9);
  EXPECT_EQ(turn.strip, 1u);
  EXPECT_NEAR(path.strips[1].poses[turn.pose].tip.x(), 20.0, 2.0);
  path.strips[1].kind = "link";  // in the air
  EXPECT_NEAR(sharpest_turn(path, kLength, [](const Strip&) { return 2.0; }).angle_rad, 0.1, 1e-9);
}

TEST(Turning, WhatIsFartherApartThanTheWindowIsNoTurn) {
  // Two corners of 40 degrees, 10 mm of way apart (14 of both ends): together 80 only where the window holds both.
  std::vector<Pose> poses;
  Vec3 at = Vec3::Zero();
  for (const double angle : {0.0, 40.0 * kDegree, 80.0 * kDegree})
    for (int k = 0; k < 10; ++k) {
      poses.push_back({at, Vec3::UnitZ()});
      at += Vec3(std::cos(angle), std::sin(angle), 0.0);
    }
  EXPECT_NEAR(sharpest_turn(poses, kLength, 5.0).angle_rad, 40.0 * kDegree, 1e-9);
  EXPECT_NEAR(sharpest_turn(poses, kLength, 30.0).angle_rad, 80.0 * kDegree, 1e-9);
}

/// An axis in the plane y = -1.8 - 0.18 z, moved along x and then turned about the z axis: a plane wall, then the cone that touches it.
std::vector<Pose> plane_then_cone(double tip_radius, double end_radius, double length) {
  const Vec3 tip(0.0, -tip_radius, 0.0);
  const Vec3 axis =
      (Vec3(0.0, -end_radius, std::sqrt(length * length - std::pow(end_radius - tip_radius, 2))) - tip) / length;
  std::vector<Pose> poses;
  for (int k = -400; k < 0; ++k) poses.push_back({tip + Vec3(0.02 * k, 0.0, 0.0), axis});
  for (int k = 0; k <= 400; ++k) {
    const Eigen::AngleAxisd turn(0.004 * k, Vec3::UnitZ());
    poses.push_back({turn * tip, turn * axis});
  }
  return poses;
}

TEST(Turning, AnAxisThatBeginsToTurnWhileAllItsPointsGoStraightOnHasNoKink) {
  const double tip = 1.8, end = 4.6, length = 16.0, window = 0.7;
  // As six numbers it changes from (1, 1) to (1.8, 4.6), by 24 degrees; each of its points goes from a line to a circle that touches it.
  EXPECT_NEAR(sharpest_turn(plane_then_cone(tip, end, length), length, window).angle_rad, window / std::hypot(tip, end),
              0.02);
}

TEST(Turning, TwoEndsThatChangeTheirPaceTurnWhatIsBetweenThem) {
  std::vector<Pose> poses;
  const auto add = [&](double x, double y) {
    const Vec3 tip(x, 0.0, 0.0), end(0.0, y, kLength);
    poses.push_back({tip, (end - tip).normalized()});
  };
  for (int k = -100; k < 0; ++k) add(0.01 * k, 0.01 * k);
  for (int k = 0; k <= 100; ++k) add(0.01 * k, 0.03 * k);
  EXPECT_NEAR(sharpest_turn(poses, kLength, 0.5).angle_rad, std::acos(4.0 / std::sqrt(20.0)), 0.01);
}

TEST(Turning, AnEndThatStopsDeadIsATurn) {
  std::vector<Pose> poses;
  const auto add = [&](double x, double y) {
    const Vec3 tip(x, 0.0, 0.0), end(y, 0.0, kLength);
    poses.push_back({tip, (end - tip).normalized()});
  };
  for (int k = -100; k < 0; ++k) add(0.01 * k, 0.0);
  for (int k = 0; k <= 100; ++k) add(0.0, 0.01 * k);
  EXPECT_NEAR(sharpest_turn(poses, kLength, 0.5).angle_rad, 0.5 * std::numbers::pi, 0.01);
}

TEST(Turning, APathWithoutAStepHasNone) {
  EXPECT_EQ(sharpest_turn(Path(), kLength, [](const Strip&) { return 1.0; }).angle_rad, 0.0);
  const std::vector<Pose> still(3, Pose{Vec3::Zero(), Vec3::UnitZ()});
  EXPECT_EQ(sharpest_turn(still, kLength, 1.0).angle_rad, 0.0);
}

}  // namespace
}  // namespace flank::internal
