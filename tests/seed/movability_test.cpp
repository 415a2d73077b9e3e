#include "flank/seed/movability.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>

#include "flank/base/random.h"
#include "seed/exact_targets.h"

namespace flank::internal {
namespace {

using testing::barrel_target;
using testing::cone_target;
using testing::ExactTarget;
using testing::plane_target;
using testing::pose_off;

constexpr int kSamples = 24;

std::vector<Footpoint> random_feet(Random& random) {
  std::vector<Footpoint> feet(kSamples);
  for (Footpoint& foot : feet) {
    foot.normal = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    foot.patch = 0;
  }
  return feet;
}

double form(const std::vector<Footpoint>& feet, const AxisVelocity& v, double axis_length) {
  double sum = 0.0;
  for (int j = 0; j < kSamples; ++j) {
    const double e = feet[static_cast<std::size_t>(j)].normal.dot(v.at(axis_length * j / (kSamples - 1), axis_length));
    sum += e * e / kSamples;
  }
  return sum;
}

/// The five-parameter problem as a generalised eigenproblem A x = lambda B x with B = diag(1, 1, 0, 0, 0): its largest
/// 1/lambda of A^-1 B, solved densely.
double dense_value(const std::vector<Footpoint>& feet, const Pose& pose, double axis_length) {
  const Vec3 e1 = pose.axis.unitOrthogonal(), e2 = pose.axis.cross(e1);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(5, 5), b = a;
  for (int j = 0; j < kSamples; ++j) {
    const Vec3& n = feet[static_cast<std::size_t>(j)].normal;
    const double sigma = axis_length * j / (kSamples - 1) - 0.5 * axis_length;
    Eigen::Matrix<double, 5, 1> row;
    row << n.dot(e1), n.dot(e2), n.dot(pose.axis), sigma * n.dot(e1), sigma * n.dot(e2);
    a += row * row.transpose() / kSamples;
  }
  b(0, 0) = b(1, 1) = 1.0;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(b, a);
  return 1.0 / eigen.eigenvalues()[4];
}

TEST(Movability, EqualsTheDenseEigenproblem) {
  Random random(7);
  for (int trial = 0; trial < 50; ++trial) {
    const Pose pose{Vec3(random.normal(), random.normal(), random.normal()),
                    Vec3(random.normal(), random.normal(), random.normal()).normalized()};
    const std::vector<Footpoint> feet = random_feet(random);
    const Movability m = movability(feet, pose, 35.0);
    const double expected = dense_value(feet, pose, 35.0);
    EXPECT_NEAR(m.value, expected, 1e-6 * expected);
    EXPECT_NEAR(m.value, form(feet, m.velocity, 35.0), 1e-14);
    EXPECT_LE(m.low, m.high);
  }
}

TEST(Movability, VelocityIsNormalisedAcrossTheAxisAndOptimal) {
  Random random(11);
  const Pose pose{Vec3(1, 2, 3), Vec3(0.2, -0.4, 1.0).normalized()};
  const std::vector<Footpoint> feet = random_feet(random);
  const Movability m = movability(feet, pose, 20.0);
  EXPECT_NEAR((m.velocity.middle - m.velocity.middle.dot(pose.axis) * pose.axis).norm(), 1.0, 1e-12);
  EXPECT_NEAR(m.velocity.omega.dot(pose.axis), 0.0, 1e-14);
  for (int trial = 0; trial < 2000; ++trial) {
    AxisVelocity v = m.velocity;
    const double size = std::pow(10.0, random.uniform(-4.0, 0.5));
    v.middle += size * Vec3(random.normal(), random.normal(), random.normal());
    v.omega += size / 10.0 * pose.axis.cross(Vec3(random.normal(), random.normal(), random.normal()));
    const double across = (v.middle - v.middle.dot(pose.axis) * pose.axis).norm();
    v.middle /= across;
    v.omega /= across;
    EXPECT_GE(form(feet, v, 20.0), m.value * (1.0 - 1e-6));
  }
}

TEST(Movability, VanishesOnExactEnvelopes) {
  for (const ExactTarget& exact : {barrel_target(), cone_target(), plane_target()}) {
    for (const double t : {0.2, 0.5, 0.8}) {
      const AxisJet jet = exact.motion.jet(t);
      const Movability m = movability(*exact.target, {jet.tip, jet.u}, exact.motion.axis_length);
      EXPECT_LT(m.value, 1e-10) << t;
      const double half = 0.5 * exact.motion.axis_length;
      const Vec3 v = jet.velocity(half), across = (v - v.dot(jet.u) * jet.u).normalized();
      EXPECT_GT(std::abs(m.velocity.middle.dot(across)), 0.999) << t;
    }
  }
}

TEST(Movability, FindsTheTurnOfAConesAxis) {
  // (On a barrel <n, u> is nearly linear in s: there a slide along the axis makes up for a turn, and the turn is open.)
  const ExactTarget exact = cone_target();
  for (const double t : {0.3, 0.6}) {
    const AxisJet jet = exact.motion.jet(t);
    const Vec3 v = jet.velocity(0.5 * exact.motion.axis_length), across = v - v.dot(jet.u) * jet.u;
    const Movability m = movability(*exact.target, {jet.tip, jet.u}, exact.motion.axis_length);
    const double sign = m.velocity.middle.dot(across) > 0.0 ? 1.0 : -1.0;
    const Vec3 up = jet.u.cross(across.normalized());
    EXPECT_NEAR(sign * m.velocity.omega.dot(up), jet.u_d1.dot(up) / across.norm(), 1e-6) << t;
  }
}

TEST(Movability, ALineThatCannotMoveSaysSo) {
  // On the plane y = -5 an axis that leans into it moves well; one whose normals point everywhere does not.
  Random random(3);
  const std::vector<Footpoint> feet = random_feet(random);
  EXPECT_GT(movability(feet, {Vec3::Zero(), Vec3::UnitZ()}, 10.0).value, 0.01);
}

TEST(Movability, AxialSlideIsNotTakenForTravel) {
  // Normals that turn along the axis but stay across it: sliding is free (E = 0), travelling is not.
  std::vector<Footpoint> feet(kSamples);
  for (int j = 0; j < kSamples; ++j) {
    const double angle = 2.0 * std::numbers::pi * j / (kSamples - 1);
    feet[static_cast<std::size_t>(j)].normal = Vec3(std::cos(3.0 * angle), std::sin(3.0 * angle), 0.0);
  }
  const Movability m = movability(feet, {Vec3::Zero(), Vec3::UnitZ()}, 10.0);
  EXPECT_GT(m.value, 0.1);
  EXPECT_NEAR(m.velocity.middle.z(), 0.0, 1e-9);
}

TEST(Movability, FootpointsPastTheBorderCountLessAndOnItNothing) {
  EXPECT_EQ(footpoint_weight(Location::kInside), 1.0);
  EXPECT_GT(footpoint_weight(Location::kExtension), 0.0);
  EXPECT_LT(footpoint_weight(Location::kExtension), 1.0);
  EXPECT_EQ(footpoint_weight(Location::kBorder), 0.0);
  std::vector<Footpoint> feet(kSamples);
  for (Footpoint& foot : feet) foot.location = Location::kBorder;
  EXPECT_FALSE(movability(feet, {Vec3::Zero(), Vec3::UnitX()}, 10.0).valid());
}

TEST(Movability, ReversingTheAxisKeepsTheValue) {
  const ExactTarget exact = barrel_target();
  const double length = exact.motion.axis_length;
  const Pose pose = pose_off(exact.motion.pose(0.5), length, {0.3, 0.4, 0}, {-0.2, 0.5, 0});
  const double a = movability(*exact.target, pose, length).value;
  const double b = movability(*exact.target, {pose.at(length), -pose.axis}, length).value;
  EXPECT_NEAR(a, b, 1e-9 * a + 1e-14);
}

TEST(Movability, SteeringKeepsTheHeadingWhereTheFormLeavesIt) {
  // All normals along the axis: every direction of travel is as good.
  std::vector<Footpoint> feet(kSamples);
  for (Footpoint& foot : feet) foot.normal = Vec3::UnitZ();
  MovabilityOptions options;
  options.previous = Vec3(0.6, -0.8, 0.0);
  const Movability m = movability(feet, {Vec3::Zero(), Vec3::UnitZ()}, 10.0, options);
  EXPECT_NEAR(m.velocity.middle.dot(options.previous), 1.0, 1e-9);
}

}  // namespace
}  // namespace flank::internal
