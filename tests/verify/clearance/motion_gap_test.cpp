#include "flank/verify/clearance/motion_gap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "flank/threads.h"
#include "flank/verify/clearance/triangle_gap.h"
#include "flank/verify/swept/pose_tree.h"
#include "sanitized.h"
#include "verify/clearance/clearance_fixture.h"

namespace flank::internal::verify {
namespace {

constexpr double kAccuracyMm = 1e-4;
constexpr double kNoLimit = 1e300;

Segment straight(const Vec3& from, const Vec3& to, const Vec3& axis = Vec3::UnitZ()) {
  Segment g;
  g.a0 = from, g.da = to - from, g.w0 = axis;
  return g;
}

TriangleMesh points(const std::vector<Vec3>& at) {
  TriangleMesh mesh;
  for (const Vec3& x : at) {
    const int n = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(x);
    mesh.triangles.push_back({n, n, n});
  }
  return mesh;
}

/// Triangles around the way of a tool of 30 mm that comes along x.
TriangleMesh rubble(Random& random, int count) {
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vec3 middle(random.uniform(-10.0, 40.0), random.uniform(9.0, 25.0) * (i % 2 == 0 ? 1.0 : -1.0),
                      random.uniform(-10.0, 40.0));
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back(middle + random_point(random, 4.0));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

std::vector<Segment> turning_segments(Random& random, int count) {
  std::vector<Pose> poses;
  for (int i = 0; i <= count; ++i)
    poses.push_back({Vec3(30.0 * i / count, 0, 0) + random_point(random, 1.0),
                     (Vec3::UnitZ() + random_point(random, 0.35)).normalized()});
  return PoseTree(path_of(poses), 30.0, 1.0).segments;
}

/// The body at one pose against every triangle.
double at_pose(const std::vector<Revolved>& body, const TriangleMesh& mesh, const Pose& pose) {
  const Vec3 e1 = pose.axis.unitOrthogonal(), e2 = pose.axis.cross(e1);
  double least = 1e300;
  for (const auto& t : mesh.triangles) {
    std::array<Vec3, 3> local;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 d = mesh.vertices[static_cast<std::size_t>(t[k])] - pose.tip;
      local[k] = {e1.dot(d), e2.dot(d), pose.axis.dot(d)};
    }
    for (const Revolved& part : body) least = std::min(least, triangle_gap(part, local).value);
  }
  return least;
}

TEST(MotionGap, CylinderThatPassesAPointIsNearestAbreast) {
  const std::vector<Revolved> body{Revolved({{0, 4}, {30, 4}})};
  const ObstacleTree tree(points({{500, 0, 0}, {62, 9, 15}}));
  const std::vector<Segment> way{straight({-100, 0, 0}, {0, 0, 0}), straight({0, 0, 0}, {100, 0, 0})};
  const GapPlace found = MotionGap(body, tree, way).least(kAccuracyMm, kNoLimit);
  EXPECT_NEAR(found.value, 5.0, kAccuracyMm);
  EXPECT_GE(found.value, 5.0 - 1e-9) << "a value is that of a real pose";
  EXPECT_EQ(found.segment, 1);
  EXPECT_NEAR(found.tau, 0.62, 5e-3);
  EXPECT_EQ(found.triangle, 1) << "its number in the mesh";
  EXPECT_LT((found.point - Vec3(62, 9, 15)).norm(), 1e-9);
  EXPECT_NEAR(found.z, 15.0, 1e-9);
  EXPECT_NEAR(found.rho, 4.0, 1e-9);
}

TEST(MotionGap, ABallAlongALineKeepsTheDistanceOfTheLine) {
  const std::vector<Revolved> body{Revolved({{12.0, 0.0}}, 3.0)};
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Vec3 from = random_point(random, 20.0), to = random_point(random, 20.0), x = random_point(random, 30.0);
    const Vec3 axis = random_unit(random), start = from + 12.0 * axis;
    const double t = std::clamp((x - start).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
    const double wanted = (x - start - t * (to - from)).norm() - 3.0;
    const ObstacleTree tree(points({x}));
    const std::vector<Segment> way{straight(from, to, axis)};
    const GapPlace found = MotionGap(body, tree, way).least(kAccuracyMm, kNoLimit);
    ASSERT_NEAR(found.value, wanted, gap_bound(wanted, kAccuracyMm)) << i;
  }
}

TEST(MotionGap, ATurningBallMovesOnACircle) {
  // The ball sits 40 above the tip, which stands still: from 40 degrees on one side through the top to the other.
  const std::vector<Revolved> body{Revolved({{40.0, 0.0}}, 3.0)};
  const double a = 40.0 / 57.29577951308232;
  const Vec3 left(-std::sin(a), 0, std::cos(a)), right(std::sin(a), 0, std::cos(a));
  Segment turn;
  turn.w0 = left, turn.dw = right - left;
  const ObstacleTree behind(points({{0, 5, 40}}));
  EXPECT_NEAR(MotionGap(body, behind, {turn}).least(kAccuracyMm, kNoLimit).value, 2.0, kAccuracyMm);
  // Above the circle, at any place of it: the chord would say up to 9 mm more.
  for (int i = -19; i <= 19; ++i) {
    const double at = 0.05 * i * a;
    const Vec3 n(std::sin(at), 0, std::cos(at)), e = 200.0 * Vec3::UnitY(), f = 200.0 * n.cross(Vec3::UnitY());
    const ObstacleTree point(points({53.0 * n}));
    EXPECT_NEAR(MotionGap(body, point, {turn}).least(kAccuracyMm, kNoLimit).value, 10.0, kAccuracyMm) << i;
    // A plane across the way out: nearest where the circle touches its parallel, between the ends of any interval.
    const ObstacleTree plane(TriangleMesh{{53.0 * n + e, 53.0 * n - e + f, 53.0 * n - e - f}, {{0, 1, 2}}});
    EXPECT_NEAR(MotionGap(body, plane, {turn}).least(kAccuracyMm, kNoLimit).value, 10.0, kAccuracyMm) << i;
  }
}

TEST(MotionGap, APlaneBesideTheWayIsSettledWithItsDistance) {
  const std::vector<Revolved> body{Revolved({{0, 2}, {30, 4}})};
  TriangleMesh plane = square(300.0, 0.0);
  for (Vec3& x : plane.vertices) x = Vec3(x.x(), 7.0, x.y());
  const ObstacleTree tree(plane);
  const std::vector<Segment> way{straight({-50, 0, 0}, {50, 0, 0}), straight({50, 0, 0}, {-50, 1, 3})};
  EXPECT_NEAR(MotionGap(body, tree, way).least(kAccuracyMm, kNoLimit).value, 2.0, kAccuracyMm);
}

TEST(MotionGap, ACollisionIsAsDeepAsTheDeepestPoint) {
  const std::vector<Revolved> body{Revolved({{0, 4}, {30, 4}})};
  const std::vector<Segment> way{straight({-100, 1, 0}, {100, 1, 0})};
  const ObstacleTree tree(points({{0, 0, 15}, {30, 3, 15}}));
  const GapPlace found = MotionGap(body, tree, way).least(kAccuracyMm, kNoLimit);
  EXPECT_LE(found.value, -3.0 + gap_bound(-3.0, kAccuracyMm));
  EXPECT_GE(found.value, -3.0 - 1e-6);
  EXPECT_EQ(found.triangle, 0);
  EXPECT_DOUBLE_EQ(gap_bound(-3.0, kAccuracyMm), 3.0 * kDepthShare);
  EXPECT_DOUBLE_EQ(gap_bound(3.0, kAccuracyMm), kAccuracyMm);
}

TEST(MotionGap, NothingBelowTheLimitSaysSo) {
  const std::vector<Revolved> body{Revolved({{0, 4}, {30, 4}})};
  const ObstacleTree tree(points({{50, 9, 15}})), none;
  const std::vector<Segment> way{straight({0, 0, 0}, {100, 0, 0})};
  const GapPlace far = MotionGap(body, tree, way).least(kAccuracyMm, 4.0);
  EXPECT_EQ(far.value, 4.0);
  EXPECT_EQ(far.segment, -1);
  EXPECT_NEAR(MotionGap(body, tree, way).least(kAccuracyMm, 5.01).value, 5.0, kAccuracyMm);
  EXPECT_EQ(MotionGap(body, none, way).least(kAccuracyMm, kNoLimit).segment, -1);
  EXPECT_EQ(MotionGap({}, tree, way).least(kAccuracyMm, kNoLimit).segment, -1);
  EXPECT_EQ(MotionGap(body, tree, {}).least(kAccuracyMm, kNoLimit).segment, -1);
}

TEST(MotionGap, SaysWhetherItStaysAboveAsTheLeastDoes) {
  Random random(5);
  const std::vector<Revolved> body = convex_bodies({{0, 3}, {10, 2}, {20, 5}, {30, 5}});
  const int rounds = kSanitized ? 2 : 10;
  for (int round = 0; round < rounds; ++round) {
    const ObstacleTree tree(rubble(random, 25));
    const std::vector<Segment> way = turning_segments(random, 3);
    const MotionGap motion(body, tree, way);
    const double least = motion.least(kAccuracyMm, kNoLimit).value, bound = gap_bound(least, kAccuracyMm);
    EXPECT_TRUE(motion.stays_above(least - 4.0 * bound, kAccuracyMm)) << round << ": " << least;
    EXPECT_FALSE(motion.stays_above(least + bound, kAccuracyMm)) << round << ": " << least;
  }
  EXPECT_TRUE(MotionGap(body, ObstacleTree(), turning_segments(random, 3)).stays_above(1e9, kAccuracyMm));
}

/// Below a shank's lower edge a face that leans enters by a few hundredths: first intervals as short as the bound of such a depth would be a
/// thousand a segment.
TEST(MotionGap, AShallowCollisionBelowAnEdgeIsMeasuredInAMoment) {
  const std::vector<Revolved> body = convex_bodies({{0, 4}, {60, 4}});
  constexpr int kCells = 100;
  TriangleMesh wall;
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j)
      wall.vertices.emplace_back(100.0 * i / kCells, 4.0 + 0.005 * (j - 50), 0.01 * (j - 50));
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const int k = i * (kCells + 1) + j;
      wall.triangles.push_back({k, k + 1, k + kCells + 1});
      wall.triangles.push_back({k + 1, k + kCells + 1, k + kCells + 2});
    }
  const ObstacleTree tree(wall);
  const auto seconds = [&](double away, double least) {
    std::vector<Segment> way;
    for (int k = 0; k < 100; ++k) way.push_back(straight({1.0 * k, -away, 0}, {1.0 * k + 1.0, -away, 0}));
    const std::clock_t begin = std::clock();
    EXPECT_NEAR(MotionGap(body, tree, way).least(1e-3, kNoLimit).value, least, 2e-3);
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  };
  (void)seconds(0.1, 0.1 / std::sqrt(1.25));
  EXPECT_LT(seconds(-0.1, -0.1 / 1.5), kSanitized ? 5.0 : 0.6) << "of processor time";
}

TEST(MotionGap, AtOnePlaceItIsTheDistanceOfThatPose) {
  Random random(2);
  const std::vector<Revolved> body = convex_bodies({{0, 3}, {10, 2}, {20, 5}, {30, 5}});
  const TriangleMesh mesh = rubble(random, 60);
  const ObstacleTree tree(mesh);
  const std::vector<Segment> way = turning_segments(random, 6);
  const MotionGap motion(body, tree, way);
  for (int i = 0; i < 60; ++i) {
    const int segment = i % 6;
    const double tau = random.uniform();
    const double wanted = at_pose(body, mesh, way[static_cast<std::size_t>(segment)].at(tau));
    const double found = motion.at(segment, tau, kAccuracyMm, kNoLimit);
    ASSERT_NEAR(found, wanted, wanted < 0.0 ? gap_bound(wanted, kAccuracyMm) : 1e-7);
    ASSERT_EQ(motion.at(segment, tau, kAccuracyMm, wanted - 1.0), wanted - 1.0) << "not below the limit";
  }
}

TEST(MotionGap, NoPoseInBetweenIsNearer) {
  Random random(3);
  const std::vector<Revolved> body = convex_bodies({{0, 3}, {10, 2}, {20, 5}, {30, 5}});
  const int rounds = kSanitized ? 3 : 12, steps = kSanitized ? 20 : 150;
  int free = 0, hit = 0;
  for (int round = 0; round < rounds; ++round) {
    const TriangleMesh mesh = rubble(random, 25);
    const ObstacleTree tree(mesh);
    const std::vector<Segment> way = turning_segments(random, 3);
    const GapPlace found = MotionGap(body, tree, way).least(kAccuracyMm, kNoLimit);
    (found.value > 0.0 ? free : hit) += 1;
    double dense = 1e300;
    for (const Segment& g : way)
      for (int i = 0; i <= steps; ++i)
        dense = std::min(dense, at_pose(body, mesh, g.at(static_cast<double>(i) / steps)));
    ASSERT_GE(dense, found.value - gap_bound(found.value, kAccuracyMm)) << round;
    ASSERT_LE(found.value, dense + kAccuracyMm + gap_bound(dense, kAccuracyMm)) << round;
    const Pose there = way[static_cast<std::size_t>(found.segment)].at(found.tau);
    ASSERT_NEAR(at_pose(body, mesh, there), found.value, gap_bound(found.value, kAccuracyMm))
        << "the place that it names";
  }
  EXPECT_TRUE(free > 0 || kSanitized);
  EXPECT_TRUE(hit > 0 || kSanitized);
}

TEST(MotionGap, BackwardsItIsTheSameAndSoItIsWithAnyNumberOfThreads) {
  Random random(4);
  const std::vector<Revolved> body = convex_bodies({{0, 3}, {30, 5}});
  const ObstacleTree tree(rubble(random, 40));
  const std::vector<Segment> way = turning_segments(random, 100);
  std::vector<Segment> back;
  for (const Segment& g : way) {
    Segment turned = g;
    turned.a0 += g.da, turned.da = -g.da, turned.w0 += g.dw, turned.dw = -g.dw;
    back.insert(back.begin(), turned);
  }
  const GapPlace there = MotionGap(body, tree, way).least(kAccuracyMm, kNoLimit);
  const double bound = gap_bound(there.value, kAccuracyMm);
  EXPECT_NEAR(MotionGap(body, tree, back).least(kAccuracyMm, kNoLimit).value, there.value, bound);
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    const GapPlace again = MotionGap(body, tree, way).least(kAccuracyMm, kNoLimit);
    EXPECT_EQ(again.value, there.value);
    EXPECT_EQ(again.segment, there.segment);
    EXPECT_EQ(again.tau, there.tau);
    EXPECT_EQ(again.point, there.point);
  }
  set_thread_count(0);
}

}  // namespace
}  // namespace flank::internal::verify
