// What the flank must not enter: which faces are walls, distances against every face asked alone, gradients, reach.
#include "flank/obstacle_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/base/parallel.h"
#include "flank/base/random.h"
#include "flank/threads.h"
#include "obstacle/obstacle_scene.h"

namespace flank::internal {
namespace {

using testing::hub;
using testing::only;
using testing::quad;
using testing::standing_blade;

constexpr double kFar = 1e3;

TEST(ObstacleField, HubIsAWallBehindWhichDistancesAreNegative) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(only(hub(true)), *blade, 2.0, 0.0);
  EXPECT_EQ(obstacles.sign(0), +1);
  EXPECT_NEAR(obstacles.at(Vec3(30, 5, 4), kFar).distance_mm, 4.0, 1e-9);
  EXPECT_NEAR(obstacles.at(Vec3(30, 5, -7), kFar).distance_mm, -7.0, 1e-9);
  // However deep, and however short the sight.
  EXPECT_NEAR(obstacles.at(Vec3(30, 5, -7), 1.0).distance_mm, -7.0, 1e-9);
  EXPECT_EQ(obstacles.at(Vec3(30, 5, 9), 3.0).face, -1);
}

TEST(ObstacleField, BladeBuriedForAThirdStillSeesTheHubFromOutside) {
  const auto blade = standing_blade(-18.0);
  const ObstacleField obstacles(only(hub(true)), *blade, 2.0, 0.0);
  EXPECT_EQ(obstacles.sign(0), +1);
}

TEST(ObstacleField, FaceWithoutOrientationIsTurnedToTheTarget) {
  const auto blade = standing_blade(0.0);
  for (const bool turned : {false, true}) {
    const ObstacleField obstacles(only(hub(false, turned)), *blade, 2.0, 0.0);
    EXPECT_EQ(obstacles.sign(0), turned ? -1 : +1);
    EXPECT_NEAR(obstacles.at(Vec3(30, 5, 4), kFar).distance_mm, 4.0, 1e-9);
    EXPECT_NEAR(obstacles.at(Vec3(30, 5, -7), kFar).distance_mm, -7.0, 1e-9);
  }
}

TEST(ObstacleField, TheBladesOwnBackIsLeftOut) {
  const auto blade = standing_blade(0.0);
  // One millimetre behind the target, its normal away from it.
  const Face back = quad(Vec3(0, -1, 0), Vec3(60, -1, 0), Vec3(0, -1, 40), Vec3(60, -1, 40), "F3");
  const ObstacleField obstacles(only({make_target({back}), true}), *blade, 2.0, 0.0);
  EXPECT_EQ(obstacles.sign(0), 0);
  EXPECT_EQ(obstacles.at(Vec3(30, 0.5, 20), kFar).face, -1);
}

TEST(ObstacleField, WhatLiesBehindAWallThatIsNotAskedForIsNotLeftOut) {
  const auto blade = standing_blade(0.0);
  // The underside of the hub that the blade stands on, whose upper side nobody asks for.
  const Face under = quad(Vec3(-50, -50, -1), Vec3(-50, 50, -1), Vec3(110, -50, -1), Vec3(110, 50, -1), "F5");
  ObstacleFace face{make_target({under}), true};
  EXPECT_EQ(ObstacleField(only(face), *blade, 2.0, 0.0).at(Vec3(30, 3, 1), kFar).face, -1);
  face.bared = true;
  const ObstacleField obstacles(only(face), *blade, 2.0, 0.0);
  EXPECT_EQ(obstacles.sign(0), 0);
  EXPECT_NEAR(obstacles.at(Vec3(30, 3, 1), kFar).distance_mm, 2.0, 1e-9);
}

TEST(ObstacleField, TheBackOfASheetIsNoWall) {
  const auto blade = standing_blade(0.0);
  // It ends farther out than the target: past the target's end there is air on both sides of it.
  for (const double y : {-1.0, 1.0}) {
    const Face back = quad(Vec3(0, -1, 0), Vec3(80, -1, 0), Vec3(0, -1, 40 * y), Vec3(80, -1, 40 * y), "F3");
    const ObstacleField obstacles(only({make_target({back}), false}), *blade, 2.0, 0.0);
    EXPECT_EQ(obstacles.sign(0), 0);
    EXPECT_NEAR(obstacles.at(Vec3(70, -4, 20 * y), kFar).distance_mm, 3.0, 1e-9);
  }
}

TEST(ObstacleField, WhatAFewOfTheTargetSeeIsNoWall) {
  const auto blade = standing_blade(0.0);
  // A shelf one millimetre above the foot of the blade, seen from above by as much of the blade as it is wide.
  for (const double width : {4.0, 12.0}) {
    const Face shelf = quad(Vec3(20, 0, 1), Vec3(20 + width, 0, 1), Vec3(20, 8, 1), Vec3(20 + width, 8, 1), "F4");
    const ObstacleField obstacles(only({make_target({shelf}), true}), *blade, 2.0, 0.0);
    EXPECT_EQ(obstacles.sign(0), width > 6.0 ? +1 : 0) << width;
    EXPECT_NEAR(obstacles.at(Vec3(22, 4, -5), kFar).distance_mm, width > 6.0 ? -6.0 : 6.0, 1e-9);
  }
}

TEST(ObstacleField, AWallSaysNothingOfWhatIsFartherBehindItThanItIsLarge) {
  const auto blade = standing_blade(0.0);
  const Face shelf = quad(Vec3(20, 0, 1), Vec3(32, 0, 1), Vec3(20, 8, 1), Vec3(32, 8, 1), "F4");
  const ObstacleField obstacles(only({make_target({shelf}), true}), *blade, 2.0, 0.0);
  ASSERT_EQ(obstacles.sign(0), +1);
  EXPECT_NEAR(obstacles.at(Vec3(22, 4, -12), kFar).distance_mm, -13.0, 1e-9);
  EXPECT_NEAR(obstacles.at(Vec3(22, 4, -16), kFar).distance_mm, 17.0, 1e-9);
}

TEST(ObstacleField, AStripThatPutsTheTargetBehindItselfIsNoWall) {
  const auto blade = standing_blade(0.0);
  // Below the target, hinged at x = 24: at z = 0 it faces the target, which 60 % of the votes see, at z = 40 it faces away.
  const Face strip = quad(Vec3(60, -5, 0), Vec3(24, -1, 0), Vec3(0, -5, 40), Vec3(24, -1, 40), "F5");
  const ObstacleField obstacles(only({make_target({strip}), true}), *blade, 2.0, 0.0);
  EXPECT_EQ(obstacles.sign(0), 0);
  EXPECT_GT(obstacles.at(Vec3(12, 2, 36), kFar).distance_mm, 0.0) << "where a tool touches the target it is free";
}

/// Hub, a neighbour that leans over, and a small face beside both.
Obstacles channel() {
  Obstacles obstacles = only(hub(true));
  const Face neighbour = quad(Vec3(0, 12, 0), Vec3(60, 14, 0), Vec3(0, 9, 40), Vec3(60, 16, 40), "F3");
  obstacles.faces.push_back({make_target({neighbour}), true});
  const Face fin = quad(Vec3(-5, 0, 5), Vec3(-5, 8, 5), Vec3(-5, 0, 20), Vec3(-4, 8, 20), "F4");
  obstacles.faces.push_back({make_target({fin}), false});
  return obstacles;
}

TEST(ObstacleField, LatticeAnswersAsEveryFaceAskedAlone) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(channel(), *blade, 2.0, 0.0);
  std::vector<ObstacleField> alone;
  for (const ObstacleFace& face : channel().faces) alone.emplace_back(only(face), *blade, 2.0, 0.0);
  Random random(7);
  for (int k = 0; k < 4000; ++k) {
    const Vec3 p(random.uniform(-3.0, 63.0), random.uniform(0.5, 20.0), random.uniform(-4.0, 44.0));
    double least = kFar;
    for (const ObstacleField& one : alone) least = std::min(least, one.at(p, kFar).distance_mm);
    EXPECT_NEAR(obstacles.at(p, kFar).distance_mm, least, 1e-9);
    const double horizon = random.uniform(0.5, 6.0);
    EXPECT_NEAR(obstacles.at(p, horizon).distance_mm, std::min(least, horizon), 1e-9);
  }
}

TEST(ObstacleField, EveryFaceKeepsItsOwnClearance) {
  const auto blade = standing_blade(0.0);
  const std::vector<double> clearances{1.5, 0.0, 6.0};
  Obstacles obstacles = channel();
  std::vector<ObstacleField> alone;
  for (std::size_t k = 0; k < obstacles.faces.size(); ++k) {
    alone.emplace_back(only(obstacles.faces[k]), *blade, 2.0, 0.0);
    obstacles.faces[k].clearance_mm = clearances[k];
  }
  const ObstacleField field(obstacles, *blade, 2.0, 0.0);
  Random random(11);
  for (int k = 0; k < 4000; ++k) {
    const Vec3 p(random.uniform(-8.0, 68.0), random.uniform(0.5, 20.0), random.uniform(-4.0, 44.0));
    double least = kFar;
    for (std::size_t i = 0; i < alone.size(); ++i)
      least = std::min(least, alone[i].at(p, kFar).distance_mm - clearances[i]);
    EXPECT_NEAR(field.at(p, kFar).distance_mm, least, 1e-9);
    const double horizon = random.uniform(-2.0, 6.0);
    EXPECT_NEAR(field.at(p, horizon).distance_mm, std::min(least, horizon), 1e-9);
  }
}

TEST(ObstacleField, GradientIsTheDerivative) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(channel(), *blade, 2.0, 0.0);
  Random random(9);
  constexpr double kStep = 1e-5;
  int tried = 0;
  for (int k = 0; k < 500; ++k) {
    const Vec3 p(random.uniform(2.0, 58.0), random.uniform(1.0, 8.0), random.uniform(-4.0, 38.0));
    const ObstacleDistance here = obstacles.at(p, kFar);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 d = kStep * Vec3::Unit(axis);
      const ObstacleDistance plus = obstacles.at(p + d, kFar), minus = obstacles.at(p - d, kFar);
      if (plus.face != minus.face) continue;  // as near to two faces
      EXPECT_NEAR(here.gradient[axis], (plus.distance_mm - minus.distance_mm) / (2.0 * kStep), 1e-5);
      ++tried;
    }
  }
  EXPECT_GT(tried, 1000);
}

TEST(ObstacleField, EstimateIsNearTheDistance) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(only(hub(true)), *blade, 2.0, 0.0);
  Random random(4);
  for (int k = 0; k < 300; ++k) {
    const Vec3 p(random.uniform(0.0, 60.0), random.uniform(0.5, 3.0), random.uniform(-3.0, 39.0));
    const ObstacleDistance near = obstacles.estimate(p);
    EXPECT_NEAR(near.distance_mm, p.z(), 1e-9);  // a plane: interpolation is exact
    EXPECT_LT((near.gradient - Vec3::UnitZ()).norm(), 1e-9);
  }
}

// Thick tools and long axes stand far outside of the target's box.
TEST(ObstacleField, FarOutDistancesAreExactAndEstimatesNear) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(channel(), *blade, 2.0, 0.0), flat(only(hub(true)), *blade, 2.0, 0.0);
  std::vector<ObstacleField> alone;
  for (const ObstacleFace& face : channel().faces) alone.emplace_back(only(face), *blade, 2.0, 0.0);
  Random random(21);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 p(random.uniform(-45.0, 105.0), random.uniform(-45.0, 45.0), random.uniform(-60.0, 90.0));
    double least = kFar;
    for (const ObstacleField& one : alone) least = std::min(least, one.at(p, kFar).distance_mm);
    EXPECT_NEAR(obstacles.at(p, kFar).distance_mm, least, 1e-9);
    EXPECT_NEAR(flat.estimate(p).distance_mm, p.z(), 1e-9) << "a plane: interpolation is exact";
  }
}

TEST(ObstacleField, WhichSideOfALevelIsExactAndHowFarIsEstimated) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(channel(), *blade, 2.0, 0.2);
  Random random(23);
  int near = 0;
  for (int k = 0; k < 4000; ++k) {
    const Vec3 p(random.uniform(-3.0, 63.0), random.uniform(0.5, 8.0), random.uniform(0.5, 38.0));
    const double level = random.uniform(0.5, 8.0), exact = obstacles.at(p, kFar).distance_mm;
    const double about = obstacles.beside(p, level);
    const ObstacleField::Rough rough = obstacles.rough(p);
    EXPECT_LE(std::abs(rough.distance_mm - exact), rough.off_mm) << p.transpose();
    if (std::abs(exact - level) > 0.02) {
      EXPECT_EQ(about > level, exact > level) << p.transpose();
    }
    if (std::abs(exact - level) > 0.1) continue;
    EXPECT_NEAR(about, exact, 0.02);
    ++near;
  }
  EXPECT_GT(near, 20);
}

TEST(ObstacleField, ReachEndsWhereTheBallTouchesTheHub) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(only(hub(true)), *blade, 2.0, 0.0);
  SurfaceSample sample{Vec3(30, 0, 2.0), Vec3(0, 1, 0)};
  EXPECT_TRUE(obstacles.reachable(sample, 1.999, 0.0));
  EXPECT_FALSE(obstacles.reachable(sample, 2.001, 0.0));
  EXPECT_TRUE(obstacles.reachable(sample, 2.005, 0.01));
  sample.point.z() = -5.0;  // inside the hub
  EXPECT_FALSE(obstacles.reachable(sample, 0.5, 0.01));
}

TEST(ObstacleField, SameAnswersForAnyNumberOfThreads) {
  const auto blade = standing_blade(0.0);
  std::vector<std::vector<double>> answers;
  for (const int threads : {1, 4}) {
    set_thread_count(threads);
    const ObstacleField obstacles(channel(), *blade, 2.0, 0.0);
    std::vector<double>& distances = answers.emplace_back(2000);
    parallel_for(distances.size(), [&](std::size_t k) {
      const double a = static_cast<double>(k);
      distances[k] = obstacles.at(Vec3(30 + 28 * std::sin(a), 5 + 4 * std::cos(3 * a), 15 + 14 * std::sin(7 * a)), 6.0)
                         .distance_mm;
    });
  }
  set_thread_count(0);
  EXPECT_EQ(answers[0], answers[1]);
}

TEST(ObstacleField, ABladeThatGoesOnFarBelowItsHubSeesTheHubFromOutside) {
  // Three fifths of it are buried, down to the bore.
  const auto blade = testing::standing_blade(-60.0);
  Obstacles obstacles = testing::only(testing::hub(true));
  EXPECT_EQ(ObstacleField(obstacles, *blade, 3.0, 0.0).sign(0), 0) << "nothing says what is material";
  obstacles.solids.push_back(testing::hub(true).surface);
  const ObstacleField field(obstacles, *blade, 3.0, 0.0);
  EXPECT_EQ(field.sign(0), 1);
  EXPECT_NEAR(field.at(Vec3(30, 3, -30), 5.0).distance_mm, -30.0, 1e-9);
}

}  // namespace
}  // namespace flank::internal
