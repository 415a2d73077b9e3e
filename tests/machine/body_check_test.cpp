// Table and head on the way: where they meet is found, also between two places, and is named.
#include "flank/machine/body_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/base/random.h"
#include "flank/machine/model/machine_file.h"
#include "flank/machine/setup_search.h"
#include "machine/machine_paths.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

constexpr double kDegree = M_PI / 180.0;

/// Trunnion A with table C: a table of radius 100 whose top is at z = -20, and a spindle that ends at the gauge line,
/// 150 above the tool's tip.
Machine trunnion() {
  Machine machine = read_machine("fanuc-ac");
  machine.gauge = Vec3::Zero();
  machine.bodies = {{"table", 0, MachineBody::Shape::kCylinder, {0, 0, -60}, {0, 0, -20}, 100.0},
                    {"spindle", kJointCount, MachineBody::Shape::kCylinder, {0, 0, 0}, {0, 0, 200}, 50.0}};
  return machine;
}

/// Joints by their letters, mm and degrees.
JointValues at(const Machine& machine, const std::string& letters, const std::vector<double>& values) {
  JointValues q{};
  for (std::size_t i = 0; i < letters.size(); ++i)
    for (std::size_t k = 0; k < kJointCount; ++k)
      if (machine.joints[k].name[0] == letters[i])
        q[k] = machine.joints[k].kind == JointKind::kRotary ? values[i] * kDegree : values[i];
  return q;
}

std::vector<BodyHit> check(const Machine& machine, const std::vector<JointValues>& track, double required = 0.0) {
  const Kinematics kinematics(machine, machine.tool_length);
  return check_bodies(machine, kinematics, machine_solids(machine), track, required);
}

TEST(BodyCheck, FindsWhereTheSpindleMeetsTheTable) {
  const Machine machine = trunnion();
  EXPECT_TRUE(check(machine, {at(machine, "Z", {100}), at(machine, "Z", {-19.9})}).empty());
  const std::vector<BodyHit> hits = check(machine, {at(machine, "Z", {100}), at(machine, "Z", {-40})});
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0].moving, "spindle");
  EXPECT_EQ(hits[0].standing, "table");
  EXPECT_EQ(hits[0].place, 1u);
  EXPECT_NEAR(hits[0].joints[machine.linear[2]], -20.0, 2.0 * kBodyErrorMm);
  const std::string text = hit_text(machine, hits[0]);
  EXPECT_NE(text.find("spindle and table"), std::string::npos) << text;
  EXPECT_NE(text.find(" Z -19.9"), std::string::npos) << text;
}

TEST(BodyCheck, KeepsTheDistanceThatIsAskedFor) {
  const Machine machine = trunnion();
  const std::vector<JointValues> track{at(machine, "Z", {100}), at(machine, "Z", {-15})};
  EXPECT_TRUE(check(machine, track, 4.9).empty());
  EXPECT_EQ(check(machine, track, 5.1).size(), 1u);
}

// At both ends the two are far apart, and half way they meet: the table's edge comes up.
TEST(BodyCheck, LooksBetweenThePlaces) {
  Machine machine = trunnion();
  machine.bodies[0].from.z() = -22.0;
  const JointValues before = at(machine, "YZA", {150.5, -10, -60}), after = at(machine, "YZA", {150.5, -10, 60});
  EXPECT_TRUE(check(machine, {before}).empty());
  EXPECT_TRUE(check(machine, {after}).empty());
  EXPECT_EQ(check(machine, {before, after}).size(), 1u);
}

TEST(BodyCheck, TheToolMeetsTheMachineButNotTheWork) {
  Machine machine = trunnion();
  const Kinematics kinematics(machine, machine.tool_length);
  std::vector<SolidBody> solids = machine_solids(machine);
  const auto box = [](double z) { return std::vector{ConvexShape::box({-5, -5, z}, {5, 5, z + 10})}; };
  solids.emplace_back("the tool", SolidKind::kTool, kJointCount, box(-150.0));
  solids.emplace_back("the part", SolidKind::kWork, 0, box(-20.0));
  const auto hits = [&](double z) {
    const JointValues q = at(machine, "Z", {z});
    return check_bodies(machine, kinematics, solids, std::span(&q, 1), 0.0);
  };
  EXPECT_TRUE(hits(131.0).empty()) << "in the part, above the table";
  ASSERT_EQ(hits(129.0).size(), 1u);
  EXPECT_EQ(hits(129.0)[0].moving, "the tool");
  EXPECT_EQ(hits(129.0)[0].standing, "table");
  ASSERT_EQ(hits(-12.0).size(), 1u);
  EXPECT_EQ(hits(-12.0)[0].moving, "spindle");
  EXPECT_EQ(hits(-12.0)[0].standing, "the part");
}

// What is told to be clear is clear at many places of the way, on any way and machine.
TEST(BodyCheck, WhatItLetsPassIsClear) {
  const int trials = kSanitized ? 30 : 150;
  Random random(8);
  for (const char* name : {"fanuc-ac", "fanuc-head-table-bc", "heidenhain-head-head-ca"}) {
    int clear = 0, hit = 0;
    for (int trial = 0; trial < trials; ++trial) {
      Machine machine = read_machine(name);
      machine.bodies = {{"table", 0, MachineBody::Shape::kBox, {-80, -60, -40}, {80, 60, 0}, 0.0},
                        {"head", kJointCount, MachineBody::Shape::kCylinder, {0, 0, 0}, {0, 0, 120}, 40.0}};
      machine.gauge = Vec3::Zero();
      JointValues from{}, to{};
      for (std::size_t k = 0; k < kJointCount; ++k) {
        const double size = machine.joints[k].kind == JointKind::kRotary ? 1.0 : 100.0;
        from[k] = random.uniform(-size, size), to[k] = random.uniform(-size, size);
      }
      // From where nothing is in reach down to a head as deep as the table's edge when it is tilted.
      for (JointValues* q : {&from, &to}) (*q)[machine.linear[2]] = random.uniform(-60, 250);
      const bool told = !check(machine, {from, to}).empty();
      bool seen = false;
      for (int i = 0; i <= 400; ++i) {
        JointValues q{};
        for (std::size_t k = 0; k < kJointCount; ++k) q[k] = std::lerp(from[k], to[k], i / 400.0);
        seen = seen || !check(machine, {q}).empty();
      }
      EXPECT_TRUE(told || !seen) << name << ' ' << trial;
      ++(told ? hit : clear);
    }
    EXPECT_GT(clear, trials / 15) << name;
    EXPECT_GT(hit, trials / 15) << name;
  }
}

// The part is put higher where the table would be in the way.
TEST(BodyCheck, TheSearchForASetUpKeepsOffTheTable) {
  Machine machine = trunnion();
  const Kinematics kinematics(machine, machine.tool_length);
  const Path path = paths::twisted(30);
  const std::vector<Pose>& poses = path.strips[0].poses;
  const FoundSetup low = search_setup(machine, kinematics, {.poses = poses});
  ASSERT_TRUE(low.setup);
  const double height = low.setup->translation.z();
  machine.bodies[0].to.z() = height + 5.0;
  std::vector<SolidBody> solids = machine_solids(machine);
  solids.emplace_back("the tool", SolidKind::kTool, kJointCount,
                      std::vector{ConvexShape::frustum({0, 0, -150}, 10.0, {0, 0, 0}, 10.0)});
  const FoundSetup found = search_setup(machine, kinematics, {.poses = poses}, solids);
  ASSERT_TRUE(found.setup) << found.reason;
  std::vector<MachinePose> placed;
  for (const Pose& p : poses) placed.push_back({found.setup->to_work(p), !placed.empty()});
  const JointChoice choice = choose_joints(machine, kinematics, placed);
  ASSERT_FALSE(choice.unreachable);
  for (const JointValues& q : choice.joints)
    EXPECT_TRUE(check_bodies(machine, kinematics, solids, std::span(&q, 1), 0.0).empty());
  EXPECT_NE(setup_text(*found.setup), setup_text(*low.setup));
}

}  // namespace
}  // namespace flank::internal
