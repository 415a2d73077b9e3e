// What a machine says of its own chain, and that what is shipped says it of itself.
#include "flank/machine/model/machine.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>
#include <utility>

#include "flank/machine/model/machine_file.h"

namespace flank::internal {
namespace {

TEST(Machine, ValuesAreToldInMillimetresAndDegrees) {
  Joint joint;
  EXPECT_EQ(in_units(joint, 12.5), 12.5);
  joint.kind = JointKind::kRotary;
  EXPECT_DOUBLE_EQ(in_units(joint, std::numbers::pi / 2.0), 90.0);
}

TEST(Machine, TheNestingIsThatOfItsRotaryJoints) {
  Machine machine;
  machine.rotary = {0, 1};
  for (const auto& [tables, nesting] :
       {std::pair(2, "table-table"), std::pair(1, "head-table"), std::pair(0, "head-head")}) {
    for (std::size_t k = 0; k < 2; ++k) machine.joints[k].table = static_cast<int>(k) < tables;
    EXPECT_EQ(machine.nesting(), nesting);
    EXPECT_EQ(machine.table_joints(), static_cast<std::size_t>(tables));
  }
}

TEST(Machine, EveryShippedChainIsFiveJointsFromTheWorkToTheTool) {
  for (const std::string& name : machine_names()) {
    SCOPED_TRACE(name);
    const Machine machine = read_machine(name);
    std::set<std::size_t> used(machine.linear.begin(), machine.linear.end());
    used.insert(machine.rotary.begin(), machine.rotary.end());
    EXPECT_EQ(used.size(), kJointCount);
    for (std::size_t k = 0; k < kJointCount; ++k) {
      const Joint& joint = machine.joints[k];
      // The work's joints first: nothing of the table stands behind the bed.
      EXPECT_EQ(joint.table, k < machine.table_joints()) << joint.name;
      EXPECT_NEAR(joint.direction.norm(), 1.0, 1e-12) << joint.name;
      EXPECT_LT(joint.low, joint.high) << joint.name;
    }
    for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(machine.rotary_joint(k).kind, JointKind::kRotary);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(machine.linear_joint(k).kind, JointKind::kLinear);
    for (const MachineBody& body : machine.bodies) EXPECT_LE(body.link, kJointCount) << body.name;
  }
}

}  // namespace
}  // namespace flank::internal
