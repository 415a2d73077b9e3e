#include "flank/verify/swept/segment_minimum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "verify/brute_force.h"

namespace flank::internal::verify {
namespace {

/// A segment that shifts and turns by up to half a radian.
Segment random_segment(Random& random) {
  Segment g;
  g.a0 = brute::random_vector(random, 3.0);
  g.da = brute::random_vector(random, 2.0);
  g.w0 = brute::random_unit(random);
  g.dw = (g.w0 + brute::random_vector(random, 0.3)).normalized() - g.w0;
  return g;
}

Segment straight(const Vec3& from, const Vec3& to, const Vec3& axis) {
  Segment g;
  g.a0 = from, g.da = to - from, g.w0 = axis;
  return g;
}

/// Dense in tau, golden sections in both variables.
double brute_minimum(const Segment& g, const RadialFunction& radial, const Vec3& x, double low, double high) {
  return brute::least(low, high, 60, 1.0, [&](double tau) { return brute::pose_distance(radial, x, g.at(tau), 100); });
}

TEST(DistanceJet, DerivativesAreThoseOfFiniteDifferences) {
  constexpr double kStep = 1e-4;
  Random random(1);
  for (int round = 0; round < 200; ++round) {
    const Tool tool = brute::random_tool(random, 20.0);
    const RadialTable radial(tool.radial);
    const Segment g = random_segment(random);
    const double tau = random.uniform(0.1, 0.9), s = random.uniform(1.0, 19.0);
    const Vec3 x = g.at(tau).at(s) + random.uniform(1.0, 8.0) * brute::random_unit(random);
    const DistanceJet j = distance_jet(g, radial, x, tau, s);
    const auto f = [&](double dt, double ds) { return distance_value(g, radial, x, tau + dt, s + ds); };
    ASSERT_NEAR(j.f, f(0, 0), 1e-13);
    ASSERT_NEAR(j.distance, (x - g.at(tau).at(s)).norm(), 1e-13);
    ASSERT_NEAR(j.dt, (f(kStep, 0) - f(-kStep, 0)) / (2 * kStep), 1e-5);
    ASSERT_NEAR(j.ds, (f(0, kStep) - f(0, -kStep)) / (2 * kStep), 1e-6);
    ASSERT_NEAR(j.dtt, (f(kStep, 0) - 2 * f(0, 0) + f(-kStep, 0)) / (kStep * kStep), 1e-4 * (1.0 + std::abs(j.dtt)));
    ASSERT_NEAR(j.dss, (f(0, kStep) - 2 * f(0, 0) + f(0, -kStep)) / (kStep * kStep), 1e-4);
    const double mixed =
        (f(kStep, kStep) - f(kStep, -kStep) - f(-kStep, kStep) + f(-kStep, -kStep)) / (4 * kStep * kStep);
    ASSERT_NEAR(j.dts, mixed, 1e-4 * (1.0 + std::abs(j.dts)));
  }
}

TEST(PlanePoint, IsHeightAndDistanceFromTheAxis) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Vec3 tip = brute::random_vector(random, 5.0), axis = brute::random_unit(random);
    const double z = random.uniform(-9.0, 9.0), rho = random.uniform(0.0, 9.0);
    const PlanePoint p = plane_point(tip, axis, tip + z * axis + rho * axis.unitOrthogonal());
    ASSERT_NEAR(p.z, z, 1e-12);
    ASSERT_NEAR(p.rho, rho, 1e-12);
  }
}

TEST(Descend, ACylinderPassingAPointIsNearestAbreastOfIt) {
  const RadialTable radial(RadialFunction(ToolFamily::kCone, 20.0, Eigen::Vector2d(3.0, 0.05)));
  const Segment g = straight({0, 0, 0}, {10, 0, 0}, Vec3::UnitZ());
  const double slope = std::sin(0.05), cosine = std::cos(0.05);
  for (const double at : {0.2, 0.5, 0.93}) {
    const Vec3 x(10.0 * at, 7.0, 9.0);
    SegmentMinimum found{0.0, 0.4, 10.0};
    ASSERT_TRUE(descend(g, radial, x, 0.0, 1.0, found));
    EXPECT_NEAR(found.tau, at, 1e-7);
    EXPECT_NEAR(found.s, 9.0 + 7.0 * slope / cosine, 1e-6) << "the sphere that touches a cone sits above its point";
    EXPECT_NEAR(found.f, 7.0 * cosine - 3.0 - 9.0 * slope, 1e-12);
  }
}

TEST(Descend, StopsAtTheBoundsWhereTheMinimumLiesBeyond) {
  const RadialTable radial(RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 3.0)));
  const Segment g = straight({0, 0, 0}, {10, 0, 0}, Vec3::UnitZ());
  SegmentMinimum late{0.0, 0.3, 5.0};
  ASSERT_TRUE(descend(g, radial, {13.0, 4.0, 26.0}, 0.25, 0.75, late));
  EXPECT_EQ(late.tau, 0.75);
  EXPECT_EQ(late.s, 20.0);
  EXPECT_NEAR(late.f, Vec3(5.5, 4.0, 6.0).norm() - 3.0, 1e-12);
  SegmentMinimum early{0.0, 0.6, 15.0};
  ASSERT_TRUE(descend(g, radial, {-3.0, 4.0, -6.0}, 0.25, 0.75, early));
  EXPECT_EQ(early.tau, 0.25);
  EXPECT_EQ(early.s, 0.0);
}

TEST(Descend, GivesUpOnTheAxisItself) {
  const RadialTable radial(RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 3.0)));
  SegmentMinimum found{0.0, 0.5, 9.0};
  EXPECT_FALSE(descend(straight({0, 0, 0}, {10, 0, 0}, Vec3::UnitZ()), radial, {5.0, 1e-7, 9.0}, 0.0, 1.0, found));
}

TEST(Descend, NeverEndsAboveItsStartAndIsALocalMinimumWhereItSettles) {
  Random random(3);
  int settled = 0;
  for (int round = 0; round < 400; ++round) {
    const Tool tool = brute::random_tool(random, 20.0);
    const RadialTable radial(tool.radial);
    const Segment g = random_segment(random);
    const Vec3 x = g.at(0.5).at(random.uniform(0.0, 20.0)) + random.uniform(0.5, 12.0) * brute::random_unit(random);
    const SegmentMinimum start{0.0, random.uniform(), random.uniform(0.0, 20.0)};
    SegmentMinimum found = start;
    const bool done = descend(g, radial, x, 0.0, 1.0, found);
    ASSERT_LE(found.f, distance_value(g, radial, x, start.tau, start.s) + 1e-13);
    ASSERT_NEAR(found.f, distance_value(g, radial, x, found.tau, found.s), 1e-12) << "the value is that of the place";
    ASSERT_TRUE(found.tau >= 0.0 && found.tau <= 1.0 && found.s >= 0.0 && found.s <= 20.0);
    if (!done) continue;
    ++settled;
    for (const double dt : {-1e-4, 0.0, 1e-4})
      for (const double ds : {-1e-3, 0.0, 1e-3})
        ASSERT_GE(
            distance_value(g, radial, x, std::clamp(found.tau + dt, 0.0, 1.0), std::clamp(found.s + ds, 0.0, 20.0)),
            found.f - 1e-11);
  }
  EXPECT_GT(settled, 150);
}

TEST(BracketedMinimum, IsTheLeastOverTheWholePieceByBruteForce) {
  Random random(4);
  for (int round = 0; round < 60; ++round) {
    const Tool tool = brute::random_tool(random, 20.0);
    const ToolDistance distance(tool.radial);
    const Segment g = random_segment(random);
    const double low = random.uniform(0.0, 0.4), high = random.uniform(0.6, 1.0);
    // Near the axis as well, where descent is not to be trusted.
    const Vec3 x = g.at(random.uniform()).at(random.uniform(-3.0, 23.0)) +
                   random.uniform(0.0, round % 2 == 0 ? 0.2 : 10.0) * brute::random_unit(random);
    const SegmentMinimum found = bracketed_minimum(g, distance, x, low, high);
    ASSERT_NEAR(found.f, brute_minimum(g, tool.radial, x, low, high), 1e-8) << round;
    ASSERT_TRUE(found.tau >= low && found.tau <= high);
    ASSERT_NEAR(found.f, distance_value(g, distance.radial(), x, found.tau, found.s), 1e-9);
  }
}

TEST(BracketedMinimum, OfAPieceWithoutExtentIsThePoseAlone) {
  const ToolDistance distance(RadialFunction(ToolFamily::kBarrel, 20.0, Eigen::Vector3d(60.0, 4.0, 10.0)));
  const Segment g = straight({0, 0, 0}, {10, 0, 0}, Vec3::UnitZ());
  const SegmentMinimum found = bracketed_minimum(g, distance, {9.0, 0.0, 10.0}, 0.5, 0.5);
  EXPECT_EQ(found.tau, 0.5);
  EXPECT_NEAR(found.f, 0.0, 1e-12);
  EXPECT_NEAR(found.s, 10.0, 1e-6);
}

}  // namespace
}  // namespace flank::internal::verify
