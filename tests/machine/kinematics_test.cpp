// Kinematics of any chain: forward and inverse are each other's inverse, and closed forms where there are any.
#include "flank/machine/kinematics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <numbers>

#include "flank/base/random.h"
#include "flank/machine/model/machine_file.h"

namespace flank::internal {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<Machine> shipped() {
  std::vector<Machine> machines;
  for (const std::string& name : machine_names()) machines.push_back(read_machine(name));
  return machines;
}

/// A machine of any nesting, with skew axes.
Machine random_machine(Random& random) {
  const auto unit = [&] {
    Vec3 v;
    do v = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    while (v.norm() < 0.1 || v.norm() > 1.0);
    return Vec3(v.normalized());
  };
  Machine machine;
  while (true) {
    std::array<int, 5> kinds{0, 0, 0, 1, 1};
    for (std::size_t k = 4; k > 0; --k)
      std::swap(kinds[k], kinds[static_cast<std::size_t>(random.uniform() * static_cast<double>(k + 1))]);
    std::size_t linear = 0, rotary = 0;
    for (std::size_t k = 0; k < 5; ++k) {
      Joint& joint = machine.joints[k];
      joint.kind = kinds[k] == 1 ? JointKind::kRotary : JointKind::kLinear;
      joint.direction = unit();
      joint.point = 100.0 * unit();
      joint.reversed = random.uniform(0, 1) < 0.5;
      if (kinds[k] == 1)
        machine.rotary[rotary++] = k;
      else
        machine.linear[linear++] = k;
    }
    machine.gauge = 50.0 * unit();
    machine.tool_axis = unit();
    Eigen::Matrix3d m;
    for (int k = 0; k < 3; ++k) m.col(k) = machine.linear_joint(static_cast<std::size_t>(k)).direction;
    const Vec3 &a = machine.rotary_joint(0).direction, &b = machine.rotary_joint(1).direction;
    if (std::abs(m.determinant()) > 0.2 && a.cross(b).norm() > 0.3 && b.cross(machine.tool_axis).norm() > 0.3)
      return machine;
  }
}

JointValues random_joints(const Machine& machine, Random& random) {
  JointValues q{};
  for (const std::size_t k : machine.linear) q[k] = random.uniform(-300, 300);
  for (const std::size_t k : machine.rotary) q[k] = random.uniform(-kPi, kPi);
  return q;
}

void expect_round_trip(const Machine& machine, Random& random) {
  const Kinematics kinematics(machine, 73.0);
  const JointValues q = random_joints(machine, random);
  const Pose pose = kinematics.forward(q);
  const RotaryValues turned = kinematics.rotary_of(q);
  ASSERT_NEAR((kinematics.direction(turned) - pose.axis).norm(), 0.0, 1e-14);
  const RotarySolutions solutions = kinematics.rotary(pose.axis, turned[0]);
  ASSERT_EQ(solutions.count, 2);
  double nearest = 1e300;
  for (const RotaryValues& rotary : solutions.values) {
    const JointValues back = kinematics.joints(pose.tip, rotary);
    const Pose again = kinematics.forward(back);
    EXPECT_NEAR((again.tip - pose.tip).norm(), 0.0, 1e-9);
    EXPECT_NEAR((again.axis - pose.axis).norm(), 0.0, 1e-12);
    double difference = 0.0;
    for (std::size_t k = 0; k < 2; ++k)
      difference = std::max(difference, std::abs(std::remainder(rotary[k] - turned[k], 2 * kPi)));
    nearest = std::min(nearest, difference);
  }
  // One of the two is where we came from; how well it is known falls off with the distance from the singular direction.
  EXPECT_LT(nearest, 1e-12 / std::min(solutions.sine, 0.01) + 1e-9) << solutions.sine;
}

TEST(Kinematics, InverseUndoesForwardOnAnyChain) {
  Random random(1);
  for (int k = 0; k < 500; ++k) expect_round_trip(random_machine(random), random);
}

TEST(Kinematics, InverseUndoesForwardOnShippedMachines) {
  Random random(2);
  for (const Machine& machine : shipped())
    for (int k = 0; k < 200; ++k) expect_round_trip(machine, random);
}

TEST(Kinematics, KeepsItsDigitsNearTheSingularDirection) {
  for (const Machine& machine : shipped()) {
    const Kinematics kinematics(machine, 60.0);
    for (const double tilt : {1e-2, 1e-4, 1e-6, 1e-8}) {
      const RotaryValues turned{0.7, tilt};
      const RotarySolutions solutions = kinematics.rotary(kinematics.direction(turned), 0.0);
      ASSERT_EQ(solutions.count, 2);
      const double error = std::min(std::abs(solutions.values[0][1] - tilt), std::abs(solutions.values[1][1] - tilt));
      EXPECT_LT(error, 1e-15) << machine.name << ' ' << tilt;
    }
  }
}

TEST(Kinematics, AFreeAngleIsTheOneThatWasGiven) {
  const Kinematics kinematics(read_machine("fanuc-ac"), 60.0);
  const RotarySolutions solutions = kinematics.rotary(Vec3::UnitZ(), 1.25);
  EXPECT_TRUE(solutions.singular);
  EXPECT_EQ(solutions.values[0][0], 1.25);
  EXPECT_EQ(solutions.values[0][1], 0.0);
}

TEST(Kinematics, WhatIsOutOfReachHasNoSolution) {
  // A nutating head of 45 degrees cannot look below the horizon.
  Machine machine = read_machine("heidenhain-head-head-ca");
  for (Joint& joint : machine.joints)
    if (joint.name == "A") joint.direction = Vec3(1, 0, 1).normalized();
  const Kinematics kinematics(machine, 60.0);
  EXPECT_EQ(kinematics.rotary(Vec3(0.1, 0.2, -0.9).normalized(), 0.0).count, 0);
  EXPECT_EQ(kinematics.rotary(Vec3(0.1, 0.2, 0.9).normalized(), 0.0).count, 2);
}

// The formulas of a trunnion with tilting and rotary table as its makers write them: p counts from the rotary point.
TEST(Kinematics, AgreesWithTheClosedFormOfATrunnion) {
  const Machine machine = read_machine("linuxcnc-xyzac-trt");
  const double dy = 20.0, dz = 10.0 + 60.0;
  const Kinematics kinematics(machine, 60.0);
  Random random(3);
  for (int k = 0; k < 100; ++k) {
    const double a = random.uniform(-2, 2), c = random.uniform(-3, 3);
    const Vec3 tip(random.uniform(-90, 90), random.uniform(-90, 90), random.uniform(-90, 90));
    const double x = tip.x(), y = tip.y(), z = tip.z() + 60.0;
    const double sa = std::sin(a), ca = std::cos(a), sc = std::sin(c), cc = std::cos(c);
    const Vec3 expected(cc * x - sc * y, sc * ca * x + cc * ca * y - sa * z - ca * dy + sa * dz + dy,
                        sc * sa * x + cc * sa * y + ca * z - sa * dy - ca * dz + dz);
    const JointValues q = kinematics.joints(tip, {c, a});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(q[machine.linear[i]], expected(static_cast<int>(i)), 1e-10);
  }
}

TEST(Kinematics, AnInverseTakesAboutAMicrosecond) {
  const Kinematics kinematics(read_machine("fanuc-ac"), 60.0);
  const int count = 200000;
  double sum = 0.0;
  const std::clock_t start = std::clock();  // of the processor: other work does not count
  for (int k = 0; k < count; ++k) {
    const double t = 1e-5 * k;
    const Vec3 u = Vec3(0.3 + 0.1 * std::sin(t), 0.2, 0.8).normalized();
    sum += kinematics.joints(Vec3(t, 1, 2), kinematics.rotary(u, 0.0).values[0])[2];
  }
  const double us = 1e6 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / count;
  RecordProperty("inverse_us", std::to_string(us));
  EXPECT_TRUE(std::isfinite(sum));
  EXPECT_LT(us, 20.0);  // a figure for people, told on a machine that may be busy
}

}  // namespace
}  // namespace flank::internal
