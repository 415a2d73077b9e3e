#include "flank/surface/ball_touch.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "flank/surface/mesh/mesh_target.h"
#include "surface/mesh_shapes.h"

namespace flank::internal {
namespace {

/// The square [0, 10] x [0, 10] at z = 0.
std::unique_ptr<Target> square() {
  return make_target(shapes::grid(8, 8, [](double u, double v) { return Vec3(10 * u, 10 * v, 0.0); }));
}

TEST(BallTouch, ABallTouchesFromEitherSideWithinTheReach) {
  const std::unique_ptr<Target> target = square();
  const std::array<const Target*, 1> targets = {target.get()};
  for (const double side : {+1.0, -1.0}) {
    EXPECT_TRUE(ball_touches(targets, {5, 5, side * 2.05}, 2.0, 0.1));
    EXPECT_TRUE(ball_touches(targets, {5, 5, side * 1.5}, 2.0, 0.1)) << "what is entered is touched";
    EXPECT_FALSE(ball_touches(targets, {5, 5, side * 2.15}, 2.0, 0.1));
  }
}

TEST(BallTouch, WhatRunsPastTheBorderTouchesNothing) {
  const std::unique_ptr<Target> target = square();
  const std::array<const Target*, 1> targets = {target.get()};
  EXPECT_TRUE(ball_touches(targets, {9.9, 5, 2}, 2.0, 0.1));
  EXPECT_FALSE(ball_touches(targets, {10.1, 5, 2}, 2.0, 0.1));
}

TEST(BallTouch, OneOfSeveralTargetsIsEnough) {
  const std::unique_ptr<Target> target = square();
  const std::unique_ptr<Target> far =
      make_target(shapes::grid(4, 4, [](double u, double v) { return Vec3(10 * u + 100, 10 * v, 0.0); }));
  const std::array<const Target*, 2> targets = {far.get(), target.get()};
  EXPECT_TRUE(ball_touches(targets, {5, 5, 2}, 2.0, 0.1));
  EXPECT_FALSE(ball_touches({}, {5, 5, 2}, 2.0, 0.1));
}

TEST(BallFits, NotInABendTighterThanTheBallNorNearACorner) {
  // A valley along y whose ground has radius 5, and a ridge seen from above.
  const auto arch = [](double sign) {
    return make_target(shapes::grid(24, 8, [=](double u, double v) {
      const double angle = 1.2 * (2.0 * u - 1.0);
      return Vec3(5.0 * std::sin(angle), 10.0 * v, sign * 5.0 * (1.0 - std::cos(angle)));
    }));
  };
  const std::unique_ptr<Target> valley = arch(+1.0), ridge = arch(-1.0);
  for (const SurfaceSample& sample : valley->samples(1.0)) {
    EXPECT_TRUE(ball_fits(*valley, sample, 4.5, 0.02));
    EXPECT_FALSE(ball_fits(*valley, sample, 6.5, 0.02));
  }
  for (const SurfaceSample& sample : ridge->samples(1.0)) EXPECT_TRUE(ball_fits(*ridge, sample, 6.5, 0.02));
}

/// Eight flat strips in a valley whose round ground, through their edges, has radius 5: between them there is less room.
TEST(BallFits, TheTrianglesOfAMeshAndNotTheSmoothSurfaceThroughThem) {
  const MeshTarget valley(shapes::grid(8, 8,
                                       [](double u, double v) {
                                         const double angle = 1.2 * (2.0 * u - 1.0);
                                         return Vec3(5.0 * std::sin(angle), 10.0 * v, 5.0 * (1.0 - std::cos(angle)));
                                       }),
                          {});
  const double inner = 5.0 * std::cos(0.15);
  for (const SurfaceSample& sample : valley.samples(0.5)) {
    const SurfaceSample given = valley.as_given(sample);
    EXPECT_NEAR(given.normal.y(), 0.0, 1e-9);
    EXPECT_NEAR((given.point - Vec3(0.0, given.point.y(), 5.0)).dot(given.normal), -inner, 1e-9)
        << "on its strip, across it";
  }
  const Vec3 middle(0.0, 5.0, 5.0);
  EXPECT_FALSE(valley.is_nearer(middle, inner - 1e-6));
  EXPECT_TRUE(valley.is_nearer(middle, inner + 1e-6));
  EXPECT_LT(valley.closest_within(middle, inner + 1e-6).patch, 0) << "the smooth ground is farther away";
}

}  // namespace
}  // namespace flank::internal
