#include <gtest/gtest.h>

#include "flank/error.h"
#include "verify/brute_force.h"

namespace flank::internal {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kExactMm = 1e-9;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kPoints = 4;
#else
constexpr int kPoints = 40;
#endif

Tool cylinder(double radius, double length) {
  Tool tool;
  tool.radial = RadialFunction::spline(length, Eigen::VectorXd::Constant(6, radius));
  return tool;
}

/// r = a + b s as a spline: its Greville points.
Tool cone(double tip, double slope, double length) {
  const int count = 7, spans = count - 3;
  Eigen::VectorXd c(count);
  for (int i = 0; i < count; ++i) {
    double greville = 0.0;
    for (int k = 1; k <= 3; ++k) greville += std::clamp(i + k - 3, 0, spans) * length / spans / 3.0;
    c[i] = tip + slope * greville;
  }
  Tool tool;
  tool.radial = RadialFunction::spline(length, c);
  return tool;
}

Path straight(const Vec3& from, const Vec3& to, int poses, const Vec3& axis = Vec3::UnitZ()) {
  Strip strip;
  for (int i = 0; i < poses; ++i)
    strip.poses.push_back({from + (to - from) * (static_cast<double>(i) / (poses - 1)), axis});
  return {{strip}};
}

TEST(SweptVolume, CylinderAlongALineIsTheDistanceToAPlaneStrip) {
  const SweptVolume volume(cylinder(3.0, 20.0), straight({0, 0, 0}, {50, 0, 0}, 11));
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x(random.uniform(-10, 60), random.uniform(-12, 12), random.uniform(-10, 30));
    const Vec3 nearest(std::clamp(x.x(), 0.0, 50.0), 0.0, std::clamp(x.z(), 0.0, 20.0));
    ASSERT_NEAR(volume.distance(x).f, (x - nearest).norm() - 3.0, kExactMm) << x.transpose();
  }
}

TEST(SweptVolume, ConeAtRestIsTheDistanceToItsFlankAndEnds) {
  const double tip = 2.0, slope = 0.3, length = 25.0;
  Strip strip;
  strip.poses.push_back({Vec3::Zero(), Vec3::UnitZ()});
  const SweptVolume volume(cone(tip, slope, length), Path{{strip}});
  const double w = std::sqrt(1.0 - slope * slope);
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x(random.uniform(-15, 15), random.uniform(-15, 15), random.uniform(-10, 40));
    const double rho = std::hypot(x.x(), x.y());
    const double s = std::clamp(x.z() + rho * slope / w, 0.0, length);
    ASSERT_NEAR(volume.distance(x).f, std::hypot(x.z() - s, rho) - tip - slope * s, kExactMm);
  }
}

TEST(SweptVolume, BarrelPushedSidewaysLeavesItsArc) {
  const double arc = 60.0, largest = 4.0, length = 20.0;
  Tool tool;
  Eigen::VectorXd p(3);
  tool.radial = RadialFunction(ToolFamily::kBarrel, length, (p << arc, largest, 10.0).finished());
  const SweptVolume volume(tool, straight({0, 0, 0}, {30, 0, 0}, 7));
  // Within the reach of the arc the distance in the plane across the motion is the distance to a circle.
  for (double z : {6.0, 8.5, 10.0, 12.0, 14.0})
    for (double y : {3.5, 4.0, 4.7})
      ASSERT_NEAR(volume.distance({14.2, y, z}).f, std::hypot(y + arc - largest, z - 10.0) - arc, kExactMm)
          << z << ' ' << y;
}

TEST(SweptVolume, BallOnACircleIsATorus) {
  const double ring = 20.0;
  Strip strip;
  const int steps = 2000;
  for (int i = 0; i <= steps; ++i) {
    const double a = 2.0 * kPi * i / steps;
    strip.poses.push_back({Vec3(ring * std::cos(a), ring * std::sin(a), 0.0), Vec3::UnitZ()});
  }
  const SweptVolume volume(cylinder(2.0, 1e-6), Path{{strip}});
  const double sagitta = ring * (1.0 - std::cos(kPi / steps));
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const Vec3 x(random.uniform(-25, 25), random.uniform(-25, 25), random.uniform(-4, 4));
    const double expected = std::hypot(std::hypot(x.x(), x.y()) - ring, x.z()) - 2.0;
    ASSERT_NEAR(volume.distance(x).f, expected, sagitta + 2e-6);
  }
}

TEST(SweptVolume, OfTheSameToolAlongAnotherPathIsAsIfMadeAnew) {
  const auto along = [](double y) {
    return Path{{{1, "flank", "", {{Vec3(0.0, y, 0.0), Vec3::UnitZ()}, {Vec3(9.0, y, 1.0), Vec3::UnitZ()}}}}};
  };
  const SweptVolume first(cylinder(1.5, 30.0), along(0.0)), anew(cylinder(1.5, 30.0), along(5.0));
  const SweptVolume shared(first, along(5.0));
  Random random(6);
  for (int i = 0; i < 100; ++i) {
    const Vec3 x(random.uniform(-3, 12), random.uniform(-3, 9), random.uniform(-3, 33));
    EXPECT_EQ(shared.distance(x).f, anew.distance(x).f);
  }
}

// What a cell of a face is proved to be near to (proof/cover_search.cpp).
TEST(SweptVolume, ABallGoesStraightFromPoseToPoseUpToItsOffset) {
  Random random(5);
  Strip strip;
  for (int i = 0; i <= 12; ++i)
    strip.poses.push_back({Vec3(3.0 * i, random.uniform(-1, 1), random.uniform(-1, 1)),
                           Vec3(0.3 * random.uniform(-1, 1), 0.3 * random.uniform(-1, 1), 1.0).normalized()});
  const SweptVolume volume(cylinder(1.5, 30.0), Path{{strip}});
  double most_off = 0.0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 x(random.uniform(1, 35), random.uniform(-4, 4), random.uniform(-2, 30));
    const SweptVolume::BallWay way = volume.ball_way(volume.distance(x));
    most_off = std::max(most_off, way.off);
    const Vec3 n = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
    const Vec3 at = way.from + random.uniform(0, 1) * way.along + way.radius * n;
    ASSERT_LE(volume.distance(at).f, way.off + kExactMm);
  }
  EXPECT_GT(most_off, 0.1) << "directions that turn by little prove nothing of it";
}

TEST(SweptVolume, ABallGoesAlmostStraightOverSeveralPoses) {
  Random random(6);
  Strip strip;
  for (int i = 0; i <= 60; ++i)
    strip.poses.push_back(
        {Vec3(0.4 * i, 0.002 * i * i + random.uniform(0, 2e-3), 0.0), Vec3(0.0, 1e-3 * i, 1.0).normalized()});
  const SweptVolume volume(cylinder(1.5, 30.0), Path{{strip}});
  constexpr double kReach = 1.6, kOff = 0.02;
  double longest = 0.0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 x(random.uniform(1, 22), random.uniform(-4, 4), random.uniform(-2, 30));
    const SweptVolume::BallWay way = volume.ball_way(volume.distance(x), kReach, kOff);
    longest = std::max(longest, way.along.norm());
    EXPECT_LE(way.off, kOff);
    const Vec3 n = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
    const Vec3 at = way.from + random.uniform(0, 1) * way.along + way.radius * n;
    ASSERT_LE(volume.distance(at).f, way.off + kExactMm);
  }
  EXPECT_GT(longest, 5 * 0.4);
  EXPECT_LT(longest, 2 * kReach + 3 * 0.4);
}

TEST(SweptVolume, TurningAboutItsTipSweepsAFan) {
  Strip strip;
  for (int i = 0; i <= 6; ++i) {
    const double a = 0.25 * i;
    strip.poses.push_back({Vec3::Zero(), Vec3(std::cos(a), std::sin(a), 0.0)});
  }
  const SweptVolume volume(cylinder(1.5, 30.0), Path{{strip}});
  for (double a : {0.1, 0.37, 0.9, 1.4})
    for (double radius : {3.0, 15.0, 29.0})
      for (double z : {0.2, 1.5, 4.0})
        ASSERT_NEAR(volume.distance({radius * std::cos(a), radius * std::sin(a), z}).f, z - 1.5, kExactMm);
}

class AgainstBruteForce : public ::testing::TestWithParam<int> {};

TEST_P(AgainstBruteForce, AgreesOnTwistedPathsOfSplineTools) {
  Random random(100 + GetParam());
  const double length = random.uniform(8.0, 40.0);
  const Tool tool = brute::random_tool(random, length);
  const int poses = 2 + static_cast<int>(random.uniform(0.0, 12.0));
  const Path path = brute::twisted_path(random, poses, random.uniform(0.2, 1.5) * length, random.uniform(0.0, 1.2));
  const SweptVolume volume(tool, path);
  for (int i = 0; i < kPoints; ++i) {
    const auto& ps = path.strips[0].poses;
    const Pose& near = ps[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(ps.size())))];
    const double s = random.uniform(-0.1, 1.1) * length;
    // Inside, at the flank and far away.
    const double away = random.uniform(0.0, 1.0) < 0.7
                            ? random.uniform(0.3, 1.5) * tool.radial.at(std::clamp(s, 0.0, length)).r
                            : random.uniform(0.0, length);
    const Vec3 x = near.at(s) + away * brute::random_unit(random);
    const SweptDistance d = volume.distance(x);
    ASSERT_NEAR(d.f, brute::swept_distance(tool, path, x, 40, 120), kExactMm)
        << "point " << i << " t " << d.t << " s " << d.s;
    const auto k = static_cast<std::size_t>(std::min(d.t, static_cast<double>(ps.size()) - 1.000001));
    const Pose pose = brute::between(ps[k], ps[k + 1], d.t - static_cast<double>(k));
    ASSERT_NEAR(d.f, brute::sphere_distance(tool.radial, x, pose, d.s), 1e-12)
        << "the place named is where the distance is taken";
  }
}

INSTANTIATE_TEST_SUITE_P(Random, AgainstBruteForce, ::testing::Range(0, 24));

TEST(SweptVolume, DeeplyWaistedToolIsMinimisedGlobally) {
  // Far from a waist both shoulders are local minima.
  Eigen::VectorXd c(8);
  c << 6.0, 5.0, 3.0, 1.6, 1.6, 3.0, 5.2, 6.3;
  Tool tool;
  tool.radial = RadialFunction::spline(24.0, c);
  ASSERT_TRUE(check_legitimacy(tool.radial).legitimate) << check_legitimacy(tool.radial).reason;
  Random random(7);
  const Path path = brute::twisted_path(random, 6, 12.0, 0.7);
  const SweptVolume volume(tool, path);
  for (int i = 0; i < 3 * kPoints; ++i) {
    const Vec3 x = path.strips[0].poses[3].at(12.0) + brute::random_vector(random, 25.0);
    ASSERT_NEAR(volume.distance(x).f, brute::swept_distance(tool, path, x, 40, 120), kExactMm) << i;
  }
}

TEST(SweptVolume, ReversingThePathChangesNothing) {
  Random random(11);
  const Tool tool = brute::random_tool(random, 20.0);
  const Path path = brute::twisted_path(random, 30, 25.0, 0.8);
  Path reversed = path;
  std::reverse(reversed.strips[0].poses.begin(), reversed.strips[0].poses.end());
  const SweptVolume a(tool, path), b(tool, reversed);
  for (int i = 0; i < 10 * kPoints; ++i) {
    const Vec3 x = path.strips[0].poses[15].at(10.0) + brute::random_vector(random, 20.0);
    ASSERT_NEAR(a.distance(x).f, b.distance(x).f, kExactMm);
  }
}

TEST(SweptVolume, RigidMotionOfEverythingChangesNothing) {
  Random random(12);
  const Tool tool = brute::random_tool(random, 20.0);
  const Path path = brute::twisted_path(random, 30, 25.0, 0.8);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, brute::random_unit(random)).toRotationMatrix();
  const Vec3 shift(5.0, -7.0, 3.0);
  Path moved = path;
  for (Pose& p : moved.strips[0].poses) p = {turn * p.tip + shift, turn * p.axis};
  const SweptVolume a(tool, path), b(tool, moved);
  for (int i = 0; i < 10 * kPoints; ++i) {
    const Vec3 x = path.strips[0].poses[15].at(10.0) + brute::random_vector(random, 20.0);
    ASSERT_NEAR(a.distance(x).f, b.distance(turn * x + shift).f, kExactMm);
  }
}

TEST(SweptVolume, SplittingAStripChangesNothing) {
  Random random(13);
  const Tool tool = brute::random_tool(random, 20.0);
  const Path path = brute::twisted_path(random, 30, 25.0, 0.8);
  Path split{{path.strips[0], path.strips[0]}};
  split.strips[0].poses.resize(12);
  split.strips[1].poses.erase(split.strips[1].poses.begin(), split.strips[1].poses.begin() + 11);
  const SweptVolume a(tool, path), b(tool, split);
  for (int i = 0; i < 10 * kPoints; ++i) {
    const Vec3 x = path.strips[0].poses[15].at(10.0) + brute::random_vector(random, 20.0);
    const SweptDistance one = a.distance(x), two = b.distance(x);
    ASSERT_NEAR(one.f, two.f, kExactMm);
    EXPECT_EQ(two.strip, one.t < 11.0 - 1e-6 ? 0 : one.t > 11.0 + 1e-6 ? 1 : two.strip);
  }
}

TEST(SweptVolume, ManyPointsAtOnceHaveTheSameDistances) {
  Random random(14);
  for (int round = 0; round < 4; ++round) {
    const Tool tool = brute::random_tool(random, 20.0);
    const Path path = brute::twisted_path(random, 200, 30.0, 0.8);
    const SweptVolume volume(tool, path);
    std::vector<Vec3> points;
    const Vec3 start = path.strips[0].poses[20].at(3.0), end = path.strips[0].poses[180].at(17.0);
    const Vec3 aside = 6.0 * brute::random_unit(random);
    for (int i = 0; i < 10 * kPoints; ++i) points.push_back(start + (end - start) * (0.1 * i / kPoints) + aside);
    std::vector<SweptDistance> together(points.size());
    volume.distances(points, 1e300, together);
    for (std::size_t i = 0; i < points.size(); ++i) ASSERT_NEAR(together[i].f, volume.distance(points[i]).f, kExactMm);
    volume.distances(points, 1.0, together);
    for (std::size_t i = 0; i < points.size(); ++i)
      ASSERT_NEAR(std::min(1.0, together[i].f), std::min(1.0, volume.distance(points[i]).f), kExactMm);
  }
}

TEST(SweptVolume, PointsThatLieTogetherHaveTheSameDistances) {
  // Passes beside each other, so that many parts of the path are near to every point.
  Path path;
  for (int k = 0; k < 12; ++k)
    path.strips.push_back(
        straight({0, 0.8 * k, 0}, {30, 0.8 * k + 0.5, 0}, 40, Vec3(0.1, 0.02 * k, 1.0).normalized()).strips.front());
  const SweptVolume volume(cone(2.0, 0.2, 15.0), path);
  Random random(8);
  std::vector<Vec3> points;
  std::vector<double> horizons;
  for (int row = 0; row < kPoints; ++row) {
    const Vec3 from(random.uniform(-5, 35), random.uniform(-8, 16), random.uniform(-4, 20));
    const Vec3 step(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
    for (int k = 0; k < 25; ++k) {
      points.push_back(from + k * step);
      horizons.push_back(random.uniform(-1.0, 6.0));
    }
  }
  std::vector<SweptDistance> together(points.size());
  volume.distances(points, horizons, together);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SweptDistance alone = volume.distance(points[i], horizons[i]);
    EXPECT_NEAR(together[i].f, alone.f, 1e-10) << points[i].transpose();
    EXPECT_EQ(together[i].strip < 0, alone.strip < 0) << points[i].transpose();
  }
}

TEST(SweptVolume, BeyondTheHorizonSaysSo) {
  const SweptVolume volume(cylinder(3.0, 20.0), straight({0, 0, 0}, {50, 0, 0}, 11));
  EXPECT_GE(volume.distance({25, 30, 10}, 2.0).f, 2.0);
  EXPECT_NEAR(volume.distance({25, 4.5, 10}, 2.0).f, 1.5, kExactMm);
  EXPECT_NEAR(volume.distance({25, 1.0, 10}, 2.0).f, -2.0, kExactMm);
}

TEST(SweptVolume, AnEmptyPathRemovesNothing) {
  const SweptVolume volume(cylinder(3.0, 20.0), Path{});
  EXPECT_EQ(volume.distance({0, 0, 0}, 5.0).strip, -1);
  EXPECT_GE(volume.distance({0, 0, 0}, 5.0).f, 5.0);
}

TEST(SweptVolume, RefusesPosesThatAreNone) {
  const Tool tool = cylinder(3.0, 20.0);
  Path path = straight({0, 0, 0}, {50, 0, 0}, 3);
  path.strips[0].poses[1].tip.x() = std::nan("");
  EXPECT_THROW(SweptVolume(tool, path), InputError);
  path = straight({0, 0, 0}, {50, 0, 0}, 3);
  path.strips[0].poses[2].axis *= 2.0;
  EXPECT_THROW(SweptVolume(tool, path), InputError);
  path = straight({0, 0, 0}, {50, 0, 0}, 3);
  path.strips[0].poses[2].axis *= -1.0;
  EXPECT_THROW(SweptVolume(tool, path), InputError);
}

}  // namespace
}  // namespace flank::internal
