// What is proved free is free between the poses, too; what cuts deeper than is allowed is not.
#include "flank/wheel/point/motion_guard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace flank::internal {
namespace {

constexpr double kBall = 3.0, kLength = 6.0, kMost = 0.05;

/// A ball about the origin as triangles whose corners lie on it.
TriangleMesh ball() {
  constexpr int kRound = 96, kUp = 48;
  TriangleMesh out;
  for (int i = 0; i <= kUp; ++i)
    for (int j = 0; j < kRound; ++j) {
      const double polar = M_PI * i / kUp, round = 2.0 * M_PI * j / kRound;
      out.vertices.push_back(
          kBall * Vec3(std::sin(polar) * std::cos(round), std::sin(polar) * std::sin(round), std::cos(polar)));
    }
  for (int i = 0; i < kUp; ++i)
    for (int j = 0; j < kRound; ++j) {
      const int a = i * kRound + j, b = i * kRound + (j + 1) % kRound;
      out.triangles.push_back({a, a + kRound, b});
      out.triangles.push_back({b, a + kRound, b + kRound});
    }
  return out;
}

RadialFunction cone() { return {ToolFamily::kCone, kLength, Eigen::Vector2d(0.5, 0.2)}; }

double sampled_depth(const TriangleBvh& triangles, const RadialFunction& radial, const Pose& a, const Pose& b) {
  double most = -1e300;
  for (int i = 0; i <= 60; ++i)
    for (int j = 0; j <= 60; ++j) {
      const double t = i / 60.0, s = kLength * j / 60.0;
      const Vec3 axis = ((1.0 - t) * a.axis + t * b.axis).normalized(), p = (1.0 - t) * a.tip + t * b.tip + s * axis;
      most = std::max(most, radial.at(s).r - std::sqrt(triangles.closest(p).squared_distance));
    }
  return most;
}

TEST(MotionGuard, SaysFreeOfMotionsThatCutNoDeeperThanIsAllowedAndOfNoOthers) {
  const TriangleBvh triangles(ball());
  const RadialFunction radial = cone();
  const MotionGuard guard(triangles, 0.0, radial, kMost);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int free = 0, cut = 0;
  for (int k = 0; k < 120; ++k) {
    // Beside the ball, the flank about along it, as far off as its radius there, a little more or less.
    const auto pose = [&](double along) {
      const Vec3 axis = (Vec3::UnitZ() + 0.1 * Vec3(any(random), any(random), 0.0)).normalized();
      return Pose{
          Vec3(kBall + radial.at(0.5 * kLength).r + 0.05 * any(random) + 0.02, along, 0.0) - 0.5 * kLength * axis,
          axis};
    };
    const Pose a = pose(-0.3), b = pose(0.3);
    const double depth = sampled_depth(triangles, radial, a, b);
    if (guard.is_free(a, b)) {
      EXPECT_LE(depth, kMost + 1e-9);
      ++free;
    } else {
      EXPECT_GT(depth, kMost - 2e-3);
      ++cut;
    }
  }
  EXPECT_GT(free, 12);
  EXPECT_GT(cut, 12);
}

TEST(MotionGuard, SeesWhatIsCutBetweenTwoPosesThatCutNothing) {
  const TriangleBvh triangles(ball());
  const RadialFunction radial = cone();
  const MotionGuard guard(triangles, 0.0, radial, kMost);
  const Pose a{Vec3(kBall + 0.2, -2.0, 0.0), Vec3::UnitX()}, b{Vec3(kBall + 0.2, 2.0, 0.0), Vec3::UnitX()};
  EXPECT_LT(guard.depth(a).mm, 0.0);
  EXPECT_LT(guard.depth(b).mm, 0.0);
  EXPECT_FALSE(guard.is_free(a, b));
}

TEST(MotionGuard, TellsHowDeepAndWhichWayIsOut) {
  const TriangleBvh triangles(ball());
  const RadialFunction radial = cone();
  const MotionGuard guard(triangles, 0.0, radial, kMost);
  const MotionGuard::Depth depth = guard.depth({Vec3(kBall + 0.4, 0.0, 0.0), Vec3::UnitX()});
  EXPECT_NEAR(depth.mm, 0.1, 0.01);
  EXPECT_GT(depth.away.x(), 0.999);
}

}  // namespace
}  // namespace flank::internal
