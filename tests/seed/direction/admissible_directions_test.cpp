#include "flank/seed/direction/admissible_directions.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "flank/base/random.h"
#include "seed/direction/direction_shapes.h"
#include "seed/exact_targets.h"

namespace flank::internal {
namespace {

using testing::differences;
using testing::Shape;
using testing::shape_distance;
using testing::shape_foot;

constexpr double kStepMm = 0.02;        // of the finite differences
constexpr double kContactError = 1e-6;  // mm, none, 1/mm: d - r, its first and its second derivative
constexpr double kRoundTripError = 1e-12;

/// A footpoint in the standard frame: d1 = x, d2 = y, n = z.
Footpoint standard_foot(double k1, double k2) {
  Footpoint foot;
  foot.k1 = k1;
  foot.k2 = k2;
  return foot;
}

/// A sphere that has four directions at the footpoint, away from focal points: r k2 <= 0.8, mu inside the range.
RadialJet fitting_jet(const Footpoint& foot, Random& random) {
  RadialJet jet;
  jet.r = random.uniform(2.0, 8.0);
  if (foot.k2 > 0.0) jet.r = std::min(jet.r, 0.8 / foot.k2);
  jet.d1 = random.uniform(-0.6, 0.6);
  const double lambda1 = -foot.k1 / (1.0 - jet.r * foot.k1), lambda2 = -foot.k2 / (1.0 - jet.r * foot.k2);
  jet.d2 = (1.0 - jet.d1 * jet.d1) * (lambda2 + random.uniform(0.02, 0.98) * (lambda1 - lambda2));
  return jet;
}

/// Largest of |d - r|, |(d - r)'|, |(d - r)''| at s along the axis.
double contact_error(const std::function<double(const Vec3&)>& distance, const Pose& axis, double s,
                     const RadialJet& jet) {
  const Vec3 d = differences([&](double x) { return distance(axis.at(s + x)); }, kStepMm);
  return (d - Vec3(jet.r, jet.d1, jet.d2)).cwiseAbs().maxCoeff();
}

struct Tally {
  int directions = 0, convex = 0, concave = 0;  // of tools: r'' < 0, r'' > 0
  double worst = 0.0;
};

void check_point(const Footpoint& foot, const RadialJet& jet, const std::function<double(const Vec3&)>& distance,
                 Tally& tally) {
  constexpr double kS = 7.0;
  const AdmissibleDirections found = admissible_directions(foot, jet);
  ASSERT_EQ(found.status, DirectionStatus::kFour);
  for (const Vec3& u : found.roots()) {
    EXPECT_NEAR(u.norm(), 1.0, 1e-14);
    const Pose axis = contact_axis(foot, jet.r, kS, u);
    EXPECT_LT((axis.at(kS) - found.centre).norm(), 1e-13);
    tally.worst = std::max(tally.worst, contact_error(distance, axis, kS, jet));
    ++tally.directions;
  }
  ++(jet.d2 > 0.0 ? tally.concave : tally.convex);
}

Tally check_shape(const Shape& shape, double u0, double u1, double v0, double v1) {
  Random random(11);
  Tally tally;
  for (int trial = 0; trial < 200; ++trial) {
    const double u = random.uniform(u0, u1), v = random.uniform(v0, v1);
    const Footpoint foot = shape_foot(shape, u, v);
    const RadialJet jet = fitting_jet(foot, random);
    check_point(
        foot, jet, [&](const Vec3& p) { return shape_distance(shape, p, u, v); }, tally);
  }
  EXPECT_EQ(tally.directions, 800);
  EXPECT_LT(tally.worst, kContactError);
  return tally;
}

TEST(AdmissibleDirections, TouchTheTorusToSecondOrder) {
  const Tally outer = check_shape(testing::torus_shape(40.0, 25.0), 0.0, 6.0, -1.3, 1.3);
  EXPECT_EQ(outer.concave, 200);  // of a convex place only a concave meridian is the equal
  const Tally inner = check_shape(testing::turned_round(testing::torus_shape(40.0, 25.0)), 0.0, 6.0, -1.3, 1.3);
  EXPECT_EQ(inner.convex, 200);
  const Tally neck = check_shape(testing::torus_shape(60.0, 25.0), 0.0, 6.0, 2.0, 4.3);
  EXPECT_GT(std::min(neck.convex, neck.concave), 20);
}

TEST(AdmissibleDirections, TouchTheTorusByItsOwnDistanceFormula) {
  Random random(5);
  const Shape shape = testing::torus_shape(60.0, 25.0);
  Tally tally;
  for (int trial = 0; trial < 50; ++trial) {
    const Footpoint foot = shape_foot(shape, random.uniform(0.0, 6.0), random.uniform(2.0, 4.3));
    const RadialJet jet = fitting_jet(foot, random);
    check_point(
        foot, jet, [](const Vec3& p) { return testing::torus_distance(60.0, 25.0, p); }, tally);
  }
  EXPECT_EQ(tally.directions, 200);
  EXPECT_LT(tally.worst, kContactError);
}

TEST(AdmissibleDirections, TouchTheEllipsoidToSecondOrder) {
  const Vec3 axes(30.0, 45.0, 70.0);
  EXPECT_EQ(check_shape(testing::ellipsoid_shape(axes), 0.1, 6.0, -1.2, 1.2).concave, 200);
  EXPECT_EQ(check_shape(testing::turned_round(testing::ellipsoid_shape(axes)), 0.1, 6.0, -1.2, 1.2).convex, 200);
}

TEST(AdmissibleDirections, TouchTheSaddleToSecondOrder) {
  const Tally tally = check_shape(testing::saddle_shape(0.04, 0.03, 2e-4), -15.0, 15.0, -15.0, 15.0);
  EXPECT_GT(std::min(tally.convex, tally.concave), 20);
}

TEST(AdmissibleDirections, TouchANurbsTargetToSecondOrder) {
  const testing::ExactTarget exact = testing::barrel_target();
  Random random(3);
  Tally tally;
  for (const SurfaceSample& sample : exact.target->samples(4.0)) {
    const Footpoint foot = exact.target->closest(sample.point + 2.0 * sample.normal);
    if (foot.location != Location::kInside) continue;
    const RadialJet jet = fitting_jet(foot, random);
    check_point(
        foot, jet, [&](const Vec3& p) { return exact.target->track(p, foot).distance; }, tally);
  }
  EXPECT_GT(tally.directions, 200);
  EXPECT_LT(tally.worst, kContactError);
}

/// The axis that made an exact envelope is one of the directions of its contact points.
TEST(AdmissibleDirections, FindTheAxisOfAnExactEnvelope) {
  for (const testing::ExactTarget& exact : {testing::barrel_target(), testing::cone_target()}) {
    for (int i = 1; i < 20; ++i) {
      const double t = i / 20.0, s = exact.tool.axis_length() * (0.1 + 0.04 * i);
      const Pose pose = exact.motion.pose(t);
      const Footpoint foot = exact.target->closest(pose.at(s));
      double nearest = 1.0;
      const AdmissibleDirections found = admissible_directions(foot, exact.tool.at(s));
      for (const Vec3& u : found.roots()) nearest = std::min(nearest, (u - pose.axis).norm());
      EXPECT_LT(nearest, 1e-5) << "t = " << t;
    }
  }
}

/// B (11), (12) as printed, rho = 1 / k: the squares of the components along d1 and d2.
Vec2 squares_of_paper(const Footpoint& foot, const RadialJet& jet) {
  const double rho1 = 1.0 / foot.k1, rho2 = 1.0 / foot.k2, r = jet.r, d2 = jet.d2, q = jet.d1 * jet.d1 - 1.0;
  const double alpha1 = q * (rho1 - r) - d2 * (r * r + rho1 * rho2) + d2 * r * (rho1 + rho2);
  const double alpha2 = q * (r - rho2) + d2 * (r * r + rho1 * rho2) - d2 * r * (rho1 + rho2);
  return Vec2(-alpha1, -alpha2) / (rho1 - rho2);
}

TEST(AdmissibleDirections, AgreeWithTheFormulasOfThePaper) {
  Random random(17);
  int checked = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    double a = random.uniform(-0.05, 0.05), b = random.uniform(-0.05, 0.05);
    if (std::min(std::abs(a), std::abs(b)) < 2e-3 || std::abs(a - b) < 2e-3)
      continue;  // there the printed form cancels
    const Footpoint foot = standard_foot(std::min(a, b), std::max(a, b));
    const RadialJet jet = fitting_jet(foot, random);
    const Vec2 paper = squares_of_paper(foot, jet);
    const AdmissibleDirections found = admissible_directions(foot, jet);
    ASSERT_EQ(found.count, 4);
    for (const Vec3& u : found.roots()) {
      EXPECT_NEAR(u.x() * u.x(), paper.x(), kRoundTripError);
      EXPECT_NEAR(u.y() * u.y(), paper.y(), kRoundTripError);
      const double bent = found.lambda1 * u.x() * u.x() + found.lambda2 * u.y() * u.y();  // (10), second line
      EXPECT_NEAR(bent, jet.d2, kRoundTripError);
      EXPECT_NEAR(u.z(), jet.d1, kRoundTripError);  // (9)
    }
    ++checked;
  }
  EXPECT_GT(checked, 1500);
}

TEST(AdmissibleDirections, TheFourAreAllDifferentAndSymmetric) {
  Random random(23);
  const Footpoint foot = standard_foot(-0.03, 0.02);
  const AdmissibleDirections found = admissible_directions(foot, fitting_jet(foot, random));
  ASSERT_EQ(found.count, 4);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((found.directions[i] - found.directions[j]).norm(), 0.05);
  EXPECT_LT((found.directions[0] + found.directions[3] - 2.0 * found.directions[0].z() * foot.normal).norm(), 1e-14);
}

/// A cone follows the asymptotic directions: tan^2(theta) = -lambda1 / lambda2.
TEST(AdmissibleDirections, ConesFollowAsymptoticDirections) {
  const RadialJet cone{5.0, 0.2, 0.0};
  const AdmissibleDirections saddle = admissible_directions(standard_foot(-0.02, 0.05), cone);
  ASSERT_EQ(saddle.status, DirectionStatus::kFour);
  EXPECT_NEAR(std::pow(std::tan(saddle.theta), 2.0), (0.02 / 1.1) / (0.05 / 0.75), 1e-12);
  const AdmissibleDirections convex = admissible_directions(standard_foot(-0.02, -1e-5), cone);
  EXPECT_EQ(convex.status, DirectionStatus::kNone);
  EXPECT_NEAR(convex.gap, 1e-5, 1e-8);
  EXPECT_NEAR(convex.theta, 0.5 * std::numbers::pi, 1e-15);  // d2, the straighter direction
}

TEST(AdmissibleDirections, AConeOnADevelopableLiesAlongItsRuling) {
  const RadialJet cone{5.0, 0.2, 0.0};
  for (const double noise : {0.0, 1e-17, -1e-17}) {
    const AdmissibleDirections bulge = admissible_directions(standard_foot(-0.02, noise), cone);
    ASSERT_EQ(bulge.status, DirectionStatus::kTwo) << noise;
    EXPECT_LT((bulge.directions[0] - Vec3(0.0, std::sqrt(0.96), 0.2)).norm(), 1e-14);
    EXPECT_LT((bulge.directions[1] - Vec3(0.0, -std::sqrt(0.96), 0.2)).norm(), 1e-14);
    const AdmissibleDirections hollow = admissible_directions(standard_foot(noise, 0.02), cone);
    ASSERT_EQ(hollow.status, DirectionStatus::kTwo) << noise;
    EXPECT_LT((hollow.directions[0] - Vec3(std::sqrt(0.96), 0.0, 0.2)).norm(), 1e-14);
  }
}

TEST(AdmissibleDirections, OnASphereEveryDirectionOrNone) {
  const Shape sphere = testing::ellipsoid_shape(Vec3::Constant(30.0));
  const Footpoint foot = shape_foot(sphere, 0.4, 0.3);
  RadialJet jet{5.0, 0.25, 0.0};
  jet.d2 = (1.0 - jet.d1 * jet.d1) / 35.0;  // lambda = 1 / (R + r)
  const AdmissibleDirections every = admissible_directions(foot, jet);
  ASSERT_EQ(every.status, DirectionStatus::kEvery);
  EXPECT_EQ(every.count, 0);
  for (int i = 0; i < 12; ++i) {
    const Pose axis = contact_axis(foot, jet.r, 3.0, axis_direction(foot, jet, i));
    EXPECT_LT(contact_error([](const Vec3& p) { return p.norm() - 30.0; }, axis, 3.0, jet), kContactError);
  }
  jet.d2 *= 1.0 + 1e-6;
  const AdmissibleDirections none = admissible_directions(foot, jet);
  EXPECT_EQ(none.status, DirectionStatus::kNone);
  EXPECT_NEAR(none.gap, 1e-6 / 35.0, 1e-10);
}

TEST(AdmissibleDirections, ACylinderOnAPlaneTurnsFreely) {
  EXPECT_EQ(admissible_directions(standard_foot(0.0, 0.0), {5.0, 0.0, 0.0}).status, DirectionStatus::kEvery);
  EXPECT_EQ(admissible_directions(standard_foot(0.0, 0.0), {5.0, 0.0, -1e-3}).status, DirectionStatus::kNone);
}

/// One radius at two places of a barrel: each has its own slope, so its own directions, and both are exact.
TEST(AdmissibleDirections, ARadiusThatOccursTwiceIsOrdinary) {
  const RadialFunction barrel(ToolFamily::kBarrel, 30.0, Eigen::Vector3d(90.0, 6.0, 15.0));
  const Shape shape = testing::torus_shape(60.0, 25.0);
  const double u = 0.3, v = 3.0;
  const Footpoint foot = shape_foot(shape, u, v);
  ASSERT_NEAR(barrel.at(9.0).r, barrel.at(21.0).r, 1e-14);
  Tally tally;
  for (const double s : {9.0, 21.0})
    check_point(
        foot, barrel.at(s), [&](const Vec3& p) { return shape_distance(shape, p, u, v); }, tally);
  EXPECT_EQ(tally.directions, 8);
  EXPECT_LT(tally.worst, kContactError);
  const Vec3 low = admissible_directions(foot, barrel.at(9.0)).directions[0];
  EXPECT_NEAR(low.dot(foot.normal), barrel.at(9.0).d1, 1e-14);
  EXPECT_GT(low.dot(foot.normal), 0.01);
}

TEST(AdmissibleDirections, FocalPointsAreToldApartFromGouging) {
  const Footpoint hollow = standard_foot(0.01, 0.2);
  const AdmissibleDirections focal = admissible_directions(hollow, {5.0, 0.0, -0.01 / 0.95});
  EXPECT_EQ(focal.status, DirectionStatus::kFocal);
  EXPECT_EQ(focal.count, 0);
  EXPECT_EQ(focal.theta, 0.0);
  EXPECT_NEAR(focal.gap, 0.0, 1e-15);
  EXPECT_EQ(admissible_directions(hollow, {5.0 + 1e-6, 0.0, 0.0}).status, DirectionStatus::kGouge);
  EXPECT_EQ(admissible_directions(hollow, {5.0 - 1e-6, 0.0, -0.1}).status, DirectionStatus::kFour);
}

TEST(AdmissibleDirections, WhatIsNoToolIsToldSo) {
  const Footpoint foot = standard_foot(-0.01, 0.01);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const RadialJet& jet : {RadialJet{0.0, 0.0, 0.0}, RadialJet{-1.0, 0.0, 0.0}, RadialJet{5.0, 1.0, 0.0},
                               RadialJet{nan, 0.0, 0.0}, RadialJet{5.0, nan, 0.0}, RadialJet{5.0, 0.0, nan}})
    EXPECT_EQ(admissible_directions(foot, jet).status, DirectionStatus::kNotATool);
}

/// Wherever there are roots, 1 - r'^2 - r r'' > 0: the outer torus of paper B's Example 1 never gets any.
TEST(AdmissibleDirections, OnlyLegitimateSpheresHaveRoots) {
  Random random(29);
  int with = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const double a = random.uniform(-0.3, 0.15), b = random.uniform(-0.3, 0.15);
    const RadialJet jet{random.uniform(0.5, 8.0), random.uniform(-0.9, 0.9), random.uniform(-0.5, 0.5)};
    if (admissible_directions(standard_foot(std::min(a, b), std::max(a, b)), jet).count == 0) continue;
    EXPECT_GT(1.0 - jet.d1 * jet.d1 - jet.r * jet.d2, 0.0);
    ++with;
  }
  EXPECT_GT(with, 300);
}

}  // namespace
}  // namespace flank::internal
