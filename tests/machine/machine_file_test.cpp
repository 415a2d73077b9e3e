// Machine files: what is shipped reads, and what is wrong is refused at its line and column.
#include "flank/machine/model/machine_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "flank/error.h"
#include "flank/machine/kinematics.h"
#include "flank/machine/model/machine_text.h"

namespace flank::internal {
namespace {

std::string shipped_text(const std::string& name) {
  std::ifstream in(machine_folder() + "/" + name + ".toml");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string refusal(const std::string& text) {
  try {
    (void)machine_from_toml(text, "m.toml");
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).rfind("m.toml: ", 0), 0u) << e.what();
    return e.what();
  }
  return "accepted";
}

void expect_refused(const std::string& text, const std::string& a, const std::string& b = "") {
  const std::string message = refusal(text);
  EXPECT_NE(message.find(a), std::string::npos) << message;
  EXPECT_NE(message.find(b), std::string::npos) << message;
}

TEST(MachineFile, AllThatAreShippedReadAndAreListed) {
  const std::vector<std::string> names = machine_names();
  for (const char* wanted : {"linuxcnc-xyzac-trt", "linuxcnc-xyzbc-trt", "fanuc-ac", "siemens-ac", "heidenhain-ac",
                             "joint-ac", "joint-bc", "fanuc-head-table-bc", "heidenhain-head-head-ca"})
    EXPECT_NE(std::find(names.begin(), names.end(), wanted), names.end()) << wanted;
  for (const std::string& name : names) {
    const Machine machine = read_machine(name);
    EXPECT_EQ(machine.name, name);
    EXPECT_FALSE(machine.description.empty());
    EXPECT_NE(machine_list_text().find(name), std::string::npos);
    EXPECT_NE(machine_to_text(machine).find(machine.nesting()), std::string::npos);
    EXPECT_NE(machine_to_json(machine).find("\"joints\""), std::string::npos);
  }
}

TEST(MachineFile, ReadsUnitsAndTheOrderOfTheChain) {
  const Machine machine = read_machine("linuxcnc-xyzac-trt");
  EXPECT_EQ(machine.nesting(), "table-table");
  // From the work to the tool: the rotary table, what tilts it, then the linear joints.
  EXPECT_EQ(machine.joints[0].name, "C");
  EXPECT_EQ(machine.joints[1].name, "A");
  EXPECT_EQ(machine.joints[4].name, "Z");
  EXPECT_TRUE(machine.joints[1].reversed);
  EXPECT_DOUBLE_EQ(machine.joints[1].high, 120.0 * std::numbers::pi / 180.0);
  EXPECT_DOUBLE_EQ(machine.linear_joint(0).speed, 500.0);
  EXPECT_EQ(machine.joints[1].point, Vec3(0, 20, 10));
  EXPECT_EQ(machine.dialect.tcp_on, "M428");
  EXPECT_EQ(read_machine("fanuc-head-table-bc").nesting(), "head-table");
  EXPECT_EQ(read_machine("heidenhain-head-head-ca").nesting(), "head-head");
}

TEST(MachineFile, ReadsLimitsOfJerkAndTheTimeOfABlock) {
  const std::string good = shipped_text("fanuc-ac");
  EXPECT_TRUE(std::isinf(machine_from_toml(good, "m.toml").joints[0].jerk));
  std::string text = replaced(good, "acceleration_deg_s2", "jerk_deg_s3 = 9000\nacceleration_deg_s2");
  text = replaced(text, "acceleration_mm_s2", "jerk_mm_s3 = 50000\nacceleration_mm_s2");
  text = replaced(text, "[control]", "[control]\nblock_time_ms = 1.5");
  const Machine machine = machine_from_toml(text, "m.toml");
  int limits = 0;
  for (const Joint& joint : machine.joints) {
    if (std::isinf(joint.jerk)) continue;
    ++limits;
    EXPECT_NEAR(in_units(joint, joint.jerk), joint.kind == JointKind::kRotary ? 9000.0 : 50000.0, 1e-6);
  }
  EXPECT_EQ(limits, 2);
  EXPECT_DOUBLE_EQ(machine.block_time, 1.5e-3);
  EXPECT_NE(machine_to_text(machine).find("jerk 5e+04 /s^3"), std::string::npos) << machine_to_text(machine);
  EXPECT_NE(machine_to_json(machine).find("\"jerk\": 50000.0"), std::string::npos);
  expect_refused(replaced(text, "jerk_mm_s3 = 50000", "jerk_mm_s3 = 0"), "jerk_mm_s3");
  expect_refused(replaced(text, "block_time_ms = 1.5", "block_time_ms = -1"), "block_time_ms");
}

TEST(MachineFile, SaysLineAndColumnAndWhatWouldBeAccepted) {
  const std::string good = shipped_text("fanuc-ac");
  EXPECT_EQ(refusal(good), "accepted");
  expect_refused("name = ", "m.toml: line 1, column ");
  expect_refused(replaced(good, "kind = \"rotary\"", "kind = \"round\""), "line 10, column 8",
                 "expected \"linear\", \"rotary\"");
  expect_refused(replaced(good, "speed_deg_s = 100", "speed_deg_s = -1"), "speed_deg_s: expected a number from");
  expect_refused(replaced(good, "speed_deg_s = 100", "speed_deg_s = \"fast\""), "speed_deg_s: expected a number from");
  expect_refused(replaced(good, "speed_deg_s = 100", "speed = 100"), "speed_deg_s: is missing");
  expect_refused(replaced(good, "speed_deg_s = 100", "speed_deg_s = 100\nspeeed = 3"), "unknown key \"speeed\"",
                 "speed_deg_s");
  expect_refused(replaced(good, "travel_deg = [-30.0, 120.0]", "travel_deg = [120.0, -30.0]"), "lower < upper");
  expect_refused(replaced(good, "travel_deg = [-30.0, 120.0]", "travel_deg = [120.0]"), "2 numbers");
  expect_refused(replaced(good, "travel_deg = [-30.0, 120.0]", "travel_deg = [0.0, nan]"), "2 numbers");
  expect_refused(replaced(good, "direction = [1.0, 0.0, 0.0]", "direction = [0.0, 0.0, 0.0]"), "direction");
  expect_refused(replaced(good, "schema = \"openflank/machine/1\"", "schema = \"openflank/machine/9\""),
                 "openflank/machine/1");
  expect_refused(replaced(good, "language = \"fanuc\"", "language = \"basic\""), "\"heidenhain\"");
  expect_refused(replaced(good, "rotary = \"AC\"", "rotary = \"AB\""), "expected \"AC\", \"CA\"");
  expect_refused(replaced(good, "[control]", "[contrl]"), "control: is missing");
}

TEST(MachineFile, RefusesChainsThatHoldNoTool) {
  const std::string good = shipped_text("fanuc-ac");
  expect_refused(replaced(good, "name = \"C\"", "name = \"A\""), "A is used twice");
  expect_refused(replaced(good, "direction = [0.0, 0.0, 1.0]", "direction = [1.0, 0.0, 0.0]"), "parallel");
  // The joint that is nearer to the tool would turn it about itself.
  std::string about_itself = replaced(good, "direction = [1.0, 0.0, 0.0]", "direction = [0.0, 0.0, 2.0]");
  about_itself = replaced(about_itself, "direction = [0.0, 0.0, 1.0]", "direction = [1.0, 0.0, 0.0]");
  expect_refused(about_itself, "turns the tool about itself");
  expect_refused(replaced(good, "direction = [0.0, 1.0, 0.0]", "direction = [1.0, 0.0, 0.0]"), "lie in one plane");
  const std::size_t z = good.find("[[head]]\nname = \"Z\"");
  expect_refused(good.substr(0, z) + good.substr(good.find("[spindle]")), "2 linear and 2 rotary axes");
}

TEST(MachineFile, ReadsOutlinesOfTableAndHead) {
  const std::string good = shipped_text("fanuc-ac");
  const Machine machine = machine_from_toml(good, "m.toml");
  ASSERT_EQ(machine.bodies.size(), 2u);
  EXPECT_EQ(machine.bodies[0].name, "table");
  EXPECT_EQ(machine.bodies[0].link, 0u) << "on C, which carries the work";
  EXPECT_EQ(machine.bodies[0].to, Vec3(0, 0, -30));
  EXPECT_EQ(machine.bodies[0].radius, 125.0);
  EXPECT_EQ(machine.bodies[1].link, kJointCount) << "on Z, which carries the tool";
  const auto with = [&](const std::string& on, const std::string& shape) {
    return replaced(good, "[spindle]", "[[body]]\nname = \"cover\"\non = \"" + on + "\"\n" + shape + "\n\n[spindle]");
  };
  const std::string box = "box_mm = [0, 0, 0, 1, 2, 3]";
  EXPECT_EQ(machine_from_toml(with("A", box), "m.toml").bodies[2].link, 1u) << "between C and A";
  EXPECT_EQ(machine_from_toml(with("bed", box), "m.toml").bodies[2].link, 2u);
  EXPECT_EQ(machine_from_toml(with("X", box), "m.toml").bodies[2].link, 3u);
  EXPECT_NE(machine_to_text(machine).find("spindle nose"), std::string::npos);
  EXPECT_NE(machine_to_json(machine).find("\"bodies\""), std::string::npos);
  expect_refused(with("B", box), "expected \"bed\"", "\"A\"");
  expect_refused(with("A", ""), "either box_mm or cylinder_mm");
  expect_refused(with("A", box + "\nradius_mm = 3"), "unknown key \"radius_mm\"");
  expect_refused(with("A", "box_mm = [0, 0, 0, 1, 0, 3]"), "box_mm", "lower corner");
  expect_refused(with("A", "cylinder_mm = [0, 0, 0, 0, 0, 1]"), "radius_mm: is missing");
  expect_refused(with("A", "cylinder_mm = [0, 0, 0, 0, 0, 0]\nradius_mm = 1"), "cylinder_mm", "differ");
}

TEST(MachineFile, RefusesWhatAControlCannot) {
  const std::string linuxcnc = shipped_text("linuxcnc-xyzac-trt");
  expect_refused(replaced(linuxcnc, "join = \"axes\"", "join = \"great-circle\""),
                 "LinuxCNC can join blocks by \"axes\" only");
  expect_refused(replaced(linuxcnc, "positions = \"tip-rotary\"", "positions = \"tip-vector\""), "no vectors");
  expect_refused(replaced(shipped_text("heidenhain-ac"), "feed = \"per-minute\"", "feed = \"inverse-time\""),
                 "per-minute");
}

TEST(MachineFile, NamesTheKnownMachinesForOneThatIsNone) {
  try {
    (void)read_machine("lathe");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("fanuc-ac"), std::string::npos) << e.what();
  }
  EXPECT_THROW((void)read_machine("no/such/file.toml"), InputError);
  EXPECT_THROW((void)read_machine("/tmp"), InputError);
}

}  // namespace
}  // namespace flank::internal
