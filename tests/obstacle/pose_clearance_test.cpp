#include "flank/obstacle/pose_clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/random.h"
#include "flank/obstacle/triangle_distance.h"
#include "flank/threads.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

Tool cylinder_tool() {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 4.0));
  tool.shank = {{20.0, 4.0}, {50.0, 4.0}};
  tool.holder = {{50.0, 10.0}, {60.0, 10.0}, {90.0, 14.0}, {95.0, 9.0}};
  return tool;
}

ObstacleMesh triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  ObstacleMesh out;
  out.mesh = {{a, b, c}, {{0, 1, 2}}};
  return out;
}

Vec3 random_point(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// Signed distance of a point to the union of the tool's plain shapes, from the definition.
double brute_point(const std::vector<std::vector<Vec2>>& convex, const Pose& pose, const Vec3& x) {
  const double z = pose.axis.dot(x - pose.tip), rho = (x - pose.tip - z * pose.axis).norm();
  double least = 1e300;
  for (const auto& profile : convex) {
    double out = std::max(profile.front().x() - z, z - profile.back().x()), border = 1e300;
    std::vector<Vec2> outline{Vec2(profile.front().x(), 0.0)};
    outline.insert(outline.end(), profile.begin(), profile.end());
    outline.emplace_back(profile.back().x(), 0.0);
    for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
      const Vec2 d = outline[i + 1] - outline[i], e = Vec2(z, rho) - outline[i];
      if (!(d.squaredNorm() > 0.0)) continue;
      out = std::max(out, (d.x() * e.y() - d.y() * e.x()) / d.norm());
      border = std::min(border, (e - std::clamp(d.dot(e) / d.squaredNorm(), 0.0, 1.0) * d).norm());
    }
    least = std::min(least, out <= 0.0 ? out : border);
  }
  return least;
}

/// Over a triangle by a grid that closes in on its best point.
double brute_triangle(const std::vector<std::vector<Vec2>>& convex, const Pose& pose, const std::array<Vec3, 3>& v) {
  double best = 1e300, p = 1.0 / 3.0, q = 1.0 / 3.0;
  for (double size = 1.0; size > 1e-9; size *= 0.7) {
    const double p0 = p, q0 = q;
    for (int i = -6; i <= 6; ++i) {
      for (int j = -6; j <= 6; ++j) {
        double a = std::clamp(p0 + size * i / 6.0, 0.0, 1.0), b = std::clamp(q0 + size * j / 6.0, 0.0, 1.0);
        if (a + b > 1.0) a /= a + b, b = 1.0 - a;
        const double value = brute_point(convex, pose, v[0] + a * (v[1] - v[0]) + b * (v[2] - v[0]));
        if (value < best) best = value, p = a, q = b;
      }
    }
  }
  return best;
}

TEST(TriangleDistance, AgreesWithBruteForce) {
  Random random(17);
  const int trials = kSanitized ? 10 : 150;
  for (const std::vector<Vec2>& profile : {std::vector<Vec2>{{0, 4}, {30, 4}},
                                           {{0, 0}, {30, 9}},
                                           {{0, 7}, {20, 2}},
                                           {{0, 3}, {5, 6}, {20, 8}, {30, 8}, {34, 2}},
                                           {{5, 7}}}) {
    const ConvexProfile body(profile);
    for (int k = 0; k < trials; ++k) {
      const Pose pose{random_point(random, 10.0), random_point(random, 1.0).normalized()};
      const Vec3 middle = pose.at(15.0) + random_point(random, 25.0);
      const double size = k % 2 == 0 ? 4.0 : 40.0;
      const std::array<Vec3, 3> v{middle + random_point(random, size), middle + random_point(random, size),
                                  middle + random_point(random, size)};
      const double brute = brute_triangle({profile}, pose, v);
      const TriangleDistance found = triangle_distance(body, pose, v, 1e300);
      ASSERT_TRUE(found.below);
      // Inside, where the distance has kinks, the brute force may stop short of the deepest point.
      ASSERT_LE(found.value, brute + 1e-6 + std::max(0.0, -kDepthShareError * brute)) << k;
      if (brute > 0.0) {
        ASSERT_GE(found.value, brute - 1e-6) << k;
      }
      const Vec3 n = (v[1] - v[0]).cross(v[2] - v[0]);
      ASSERT_NEAR(n.normalized().dot(found.point - v[0]), 0.0, 1e-9);
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_GE(n.normalized().dot((v[(c + 1) % 3] - v[c]).cross(found.point - v[c])), -1e-6);
      ASSERT_NEAR(brute_point({profile}, pose, found.point), found.value, 1e-9);
      ASSERT_FALSE(triangle_distance(body, pose, v, found.value - 1.0).below);
    }
  }
}

TEST(PoseChecker, ClosedForms) {
  const Pose upright{Vec3::Zero(), Vec3::UnitZ()};
  // A plane beside the shank, and one below the round end.
  const ObstacleMesh beside = triangle({9, -90, 30}, {9, 90, 30}, {9, 0, 45});
  const ObstacleMesh below = triangle({-90, -90, -7}, {90, -90, -7}, {0, 90, -7});
  const std::array<ObstacleMesh, 2> both{beside, below};
  const PoseChecker checker(cylinder_tool(), both);
  const PoseClearance found = checker.measure(upright);
  EXPECT_NEAR(found.clearance_mm, 3.0, 1e-6);
  EXPECT_EQ(found.surface, 1);
  EXPECT_NEAR((found.tip_gradient - Vec3::UnitZ()).norm(), 0.0, 1e-3);
  EXPECT_TRUE(checker.is_free(upright, 2.999));
  EXPECT_FALSE(checker.is_free(upright, 3.001));
  const PoseChecker one(cylinder_tool(), std::span(both).first(1));
  EXPECT_NEAR(one.measure(upright).clearance_mm, 5.0, 1e-6);
  EXPECT_NEAR((one.measure(upright).tip_gradient + Vec3::UnitX()).norm(), 0.0, 1e-6);
  // Past the horizon nothing is said.
  EXPECT_EQ(one.measure(upright, 2.0).surface, -1);
  EXPECT_EQ(one.measure(upright, 2.0).clearance_mm, 2.0);
  // The flank may touch a target, shank and holder may not.
  ObstacleMesh target = below;
  target.flank_may_touch = true;
  EXPECT_NEAR(PoseChecker(cylinder_tool(), std::span(&target, 1)).measure(upright).clearance_mm, 27.0, 1e-6);
  // Slack counts as nearness.
  ObstacleMesh rough = below;
  rough.slack_mm = 0.5;
  EXPECT_NEAR(PoseChecker(cylinder_tool(), std::span(&rough, 1)).measure(upright).clearance_mm, 2.5, 1e-6);
}

/// Clearances and gradients of random scenes against brute force and finite differences.
TEST(PoseChecker, GradientAgainstFiniteDifferences) {
  Random random(23);
  Tool tool = cylinder_tool();
  const std::vector<std::vector<Vec2>> shapes{{{20, 4}, {50, 4}}, {{50, 10}, {60, 10}}, {{60, 10}, {90, 14}, {95, 9}}};
  const int trials = kSanitized ? 40 : 200;
  int checked = 0, kinks = 0;
  for (int k = 0; k < trials; ++k) {
    const Pose pose{random_point(random, 5.0), (Vec3::UnitZ() + random_point(random, 0.3)).normalized()};
    std::vector<ObstacleMesh> surfaces;
    const bool compared = !kSanitized || k % 10 == 0;
    double brute = 1e300;
    for (int i = 0; i < 3; ++i) {
      const Vec3 middle = pose.at(random.uniform(10.0, 100.0)) + random_point(random, 25.0);
      const std::array<Vec3, 3> v{middle + random_point(random, 6.0), middle + random_point(random, 6.0),
                                  middle + random_point(random, 6.0)};
      surfaces.push_back(triangle(v[0], v[1], v[2]));
      surfaces.back().flank_may_touch = true;
      if (compared) brute = std::min(brute, brute_triangle(shapes, pose, v));
    }
    const PoseChecker checker(tool, surfaces);
    const PoseClearance found = checker.measure(pose);
    // No place that brute force finds is nearer, and the place that is found is as near as it says.
    const double slack = 1e-6 + (brute < 0.0 ? -3e-3 * brute : 0.0);
    if (compared) {
      ASSERT_LE(found.clearance_mm, brute + slack) << k;
      ASSERT_NEAR(brute_point(shapes, pose, found.point), found.clearance_mm, slack) << k;
    }
    if (found.clearance_mm < 0.1) continue;
    const double h = 1e-4;
    double worst = 0.0;
    for (int c = 0; c < 3; ++c) {
      Pose up = pose, down = pose;
      up.tip[c] += h, down.tip[c] -= h;
      const double slope = (checker.measure(up).clearance_mm - checker.measure(down).clearance_mm) / (2.0 * h);
      worst = std::max(worst, std::abs(slope - found.tip_gradient[c]));
    }
    const Vec3 e1 = pose.axis.unitOrthogonal(), e2 = pose.axis.cross(e1);
    for (const Vec3& e : {e1, e2}) {
      const Pose up{pose.tip, (pose.axis + h * e).normalized()}, down{pose.tip, (pose.axis - h * e).normalized()};
      const double slope = (checker.measure(up).clearance_mm - checker.measure(down).clearance_mm) / (2.0 * h);
      worst = std::max(worst, std::abs(slope - found.axis_gradient.dot(e)) / 50.0);
    }
    EXPECT_NEAR(found.axis_gradient.dot(pose.axis), 0.0, 1e-9);
    EXPECT_NEAR(found.tip_gradient.norm(), 1.0, 1e-9);
    ++checked;
    kinks += worst > 1e-3;  // another place is as near
  }
  EXPECT_GT(checked, 2 * trials / 5);
  EXPECT_LE(kinks, 2);
}

TEST(PoseChecker, FollowingTheGradientFreesAPose) {
  const ObstacleMesh wall = triangle({8, -200, 0}, {8, 200, 0}, {8, 0, 300});
  const PoseChecker checker(cylinder_tool(), std::span(&wall, 1));
  Pose pose{Vec3::Zero(), Vec3::UnitZ()};
  const double before = checker.measure(pose).clearance_mm;
  EXPECT_LT(before, -5.0);
  for (int k = 0; k < 60; ++k) {
    const PoseClearance at = checker.measure(pose);
    if (at.clearance_mm > 0.5) break;
    pose.tip += 0.5 * at.tip_gradient;
  }
  EXPECT_TRUE(checker.is_free(pose, 0.5));
}

TEST(PoseChecker, BatchesAgreeForAnyNumberOfThreads) {
  Random random(31);
  ObstacleMesh cloud;
  for (int i = 0; i < 600; ++i) {
    const Vec3 middle = Vec3(25, 0, 45) + random_point(random, 25.0);
    for (int c = 0; c < 3; ++c) cloud.mesh.vertices.emplace_back(middle + random_point(random, 1.0));
    cloud.mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const PoseChecker checker(cylinder_tool(), std::span(&cloud, 1));
  std::vector<Pose> poses;
  for (int i = 0; i < 200; ++i)
    poses.push_back({Vec3(-20 + 0.1 * i, 0.05 * i, 0), Vec3(0.001 * i, 0.1, 1).normalized()});
  std::vector<PoseClearance> first(poses.size()), second(poses.size());
  std::vector<char> free(poses.size());
  set_thread_count(1);
  checker.measure_batch(poses, 1e300, first);
  set_thread_count(2);
  checker.measure_batch(poses, 1e300, second);
  checker.free_batch(poses, 1.0, free);
  set_thread_count(0);
  int colliding = 0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    EXPECT_EQ(first[k].clearance_mm, second[k].clearance_mm);
    EXPECT_NEAR(first[k].clearance_mm, checker.measure(poses[k]).clearance_mm,
                1e-6 + std::max(0.0, -2e-3 * first[k].clearance_mm));
    EXPECT_EQ(free[k] != 0, checker.is_free(poses[k], 1.0));
    EXPECT_EQ(free[k] != 0, first[k].clearance_mm >= 1.0);
    colliding += free[k] == 0;
  }
  EXPECT_GT(colliding, 0);
  EXPECT_LT(colliding, 200);
}

TEST(PoseChecker, SamplesOfATargetAreNearerThanItIs) {
  Face face;
  face.id = "F1";
  BSplineSurface& s = face.surface;
  s.degree_u = s.degree_v = 1;
  s.count_u = s.count_v = 2;
  s.knots_u = s.knots_v = {0, 0, 1, 1};
  s.poles = {{12, -40, 0}, {12, -40, 80}, {12, 40, 0}, {12, 40, 80}};
  const auto target = make_target(std::vector<Face>{face});
  const ObstacleMesh samples = obstacle_points(*target, 0.5, false);
  const PoseClearance found =
      PoseChecker(cylinder_tool(), std::span(&samples, 1)).measure({Vec3::Zero(), Vec3::UnitZ()});
  EXPECT_LE(found.clearance_mm, -1.0);  // the holder, 10 to 14 wide, reaches past x = 12 at z = 75
  ObstacleMesh far = samples;
  for (Vec3& p : far.mesh.vertices) p.x() += 30.0;
  const PoseClearance apart = PoseChecker(cylinder_tool(), std::span(&far, 1)).measure({Vec3::Zero(), Vec3::UnitZ()});
  const double truth = 42.0 - (10.0 + 4.0 * 20.0 / 30.0);
  EXPECT_LE(apart.clearance_mm, truth);
  EXPECT_GE(apart.clearance_mm, truth - samples.slack_mm - 0.5);
}

}  // namespace
}  // namespace flank::internal
