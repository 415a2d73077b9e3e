// A wheel's folder: its plan, the copies of its operations, and the verdict on its roughing.
#include "flank/pipeline/folder/wheel_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/path_file.h"
#include "flank/pipeline/folder/free_height.h"
#include "flank/pipeline/folder/judge_roughing.h"
#include "flank/pipeline/judge/rough_left.h"
#include "flank/pipeline/program/operation_words.h"
#include "temporary_folder.h"
#include "verify/faces.h"

namespace flank::internal {
namespace {

constexpr const char* kPlan = R"({"schema": "openflank/plan/1",
  "axis": {"point_mm": [1, 0, 0], "direction": [0, 0, 2]}, "copies": 3, "sectors": 3, "whole": true,
  "most_engagement_deg": 120, "most_free_mm": 4.5, "blank": {"file": "blank.stl", "from": "turned"},
  "operations": [
    {"id": "10", "kind": "rough", "folder": "ops/10-rough", "copies": 3, "done": true},
    {"id": "20", "kind": "side", "folder": "ops/20-side", "copies": 3, "done": true},
    {"id": "50", "kind": "edge", "folder": "ops/50-edge", "copies": 3, "done": false, "problem": "no room"}]})";

class WheelPlanFile : public TemporaryFolder {
 protected:
  WheelPlanFile() : TemporaryFolder("wheel_plan") {}
  void write_plan(const std::string& text) const { write_file((root_ / "plan.json").string(), text); }
  [[nodiscard]] std::string complaint(const std::string& from, const std::string& to) const {
    std::string text = kPlan;
    text.replace(text.find(from), from.size(), to);
    write_plan(text);
    try {
      (void)read_wheel_plan(root_.string());
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }
};

Path one_pass() {
  return {{{1, "flank", "F1", {{Vec3(5.0, 0.0, 0.0), Vec3::UnitZ()}, {Vec3(6.0, 0.0, 1.0), Vec3::UnitX()}}}}};
}

TEST_F(WheelPlanFile, SaysWhatIsMachinedAndHowOften) {
  EXPECT_FALSE(read_wheel_plan(root_.string()));
  write_plan(kPlan);
  const WheelPlan plan = read_wheel_plan(root_.string()).value();
  EXPECT_EQ(plan.axis.direction, Vec3::UnitZ());
  EXPECT_FALSE(plan.up);
  EXPECT_EQ(plan.sectors, 3);
  EXPECT_EQ(plan.most_engagement_deg, 120.0);
  EXPECT_EQ(plan.most_free_mm, 4.5);
  EXPECT_EQ(plan.blank, (root_ / "blank.stl").string());
  ASSERT_EQ(plan.steps.size(), 3U);
  ASSERT_EQ(plan.roughing().size(), 1U);
  EXPECT_EQ(plan.roughing().front()->folder, (root_ / "ops/10-rough").string());
  EXPECT_FALSE(plan.steps[2].done);
  EXPECT_EQ(plan.steps[2].problem, "no room");
  std::string turned_over = kPlan;
  turned_over.insert(1, "\"up\": [0, 0, -3], ");
  write_plan(turned_over);
  EXPECT_EQ(read_wheel_plan(root_.string())->up, Vec3(0.0, 0.0, -1.0));
}

TEST_F(WheelPlanFile, WhatCannotBeUsedIsRefusedByName) {
  EXPECT_NE(complaint("120", "-1").find("most_engagement_deg"), std::string::npos);
  EXPECT_NE(complaint("ops/10-rough", "../other").find("operations[0].folder"), std::string::npos);
  EXPECT_NE(complaint("blank.stl", "/etc/passwd").find("blank.file"), std::string::npos);
  EXPECT_NE(complaint("\"done\": true", "\"done\": 1").find("operations[0].done"), std::string::npos);
  EXPECT_NE(complaint("[0, 0, 2]", "[0, 0, 0]").find("axis.direction"), std::string::npos);
  EXPECT_NE(complaint("\"sectors\": 3", "\"sectors\": 0").find("sectors"), std::string::npos);
}

TEST_F(WheelPlanFile, CopiesAreTurnedByThePitch) {
  write_plan(kPlan);
  WheelPlan plan = read_wheel_plan(root_.string()).value();
  const Path all = all_copies(one_pass(), plan, 3);
  ASSERT_EQ(all.strips.size(), 3U);
  EXPECT_EQ(all.strips[0].poses[0].tip, one_pass().strips[0].poses[0].tip);
  const double angle = 2.0 * std::numbers::pi / 3.0;
  EXPECT_NEAR((all.strips[1].poses[0].tip - Vec3(1.0 + 4.0 * std::cos(angle), 4.0 * std::sin(angle), 0.0)).norm(), 0.0,
              1e-12);
  EXPECT_EQ(all.strips[2].id, 3);
  plan.whole = false;
  EXPECT_EQ(all_copies(one_pass(), plan, 2).strips.size(), 2U) << "as many as there are, of a piece too";
}

TEST_F(WheelPlanFile, APathThatIsNotThatOfTheOperationsIsRefused) {
  write_plan(kPlan);
  const WheelPlan plan = read_wheel_plan(root_.string()).value();
  std::filesystem::create_directories(root_ / "ops/20-side");
  write_path(one_pass(), (root_ / "ops/20-side/path.json").string());
  Path whole = all_copies(one_pass(), plan, 3);
  EXPECT_NO_THROW(require_steps_make(plan, whole, "path.json"));
  whole.strips[1].poses[1].tip.x() += 1e-3;
  EXPECT_THROW(require_steps_make(plan, whole, "path.json"), InputError);
  whole = all_copies(one_pass(), plan, 3);
  whole.strips.pop_back();
  EXPECT_THROW(require_steps_make(plan, whole, "path.json"), InputError);
}

TEST_F(WheelPlanFile, ABladeThatThePartLacksStandsThereTurned) {
  std::string text = kPlan;
  text.insert(text.find("\"operations\""), "\"lacking\": [{\"faces\": [\"F1a\"], \"turns\": 1}], ");
  write_plan(text);
  const WheelPlan plan = read_wheel_plan(root_.string()).value();
  ASSERT_EQ(plan.lacking.size(), 1U);
  flank::internal::Setup setup;
  setup.part.faces = {test::plane_face("F1", 4.0, 2.0)};
  stand_whole(plan, setup);
  ASSERT_EQ(setup.standing.size(), 1U);
  // A third of a turn about the line through (1, 0, 0) along z.
  const double angle = 2.0 * std::numbers::pi / 3.0;
  Box3 box;
  for (const double x : {0.0, 4.0})
    for (const double z : {0.0, 2.0}) box.add(Vec3(1.0 + (x - 1.0) * std::cos(angle), (x - 1.0) * std::sin(angle), z));
  EXPECT_LT((setup.standing[0].box().low - box.low).norm(), 1e-9);
  EXPECT_LT((setup.standing[0].box().high - box.high).norm(), 1e-9);
}

TEST_F(WheelPlanFile, ABladesFacesCountForItsCopies) {
  std::string text = kPlan;
  text.replace(text.find(R"("folder": "ops/20-side")"), 0, R"("faces": ["F2"], )");
  flank::internal::Setup setup;
  setup.part.faces = {test::plane_face("F1", 4.0, 2.0), test::plane_face("F2", 4.0, 2.0)};
  setup.targets = {0, 1};
  write_plan(text);
  stand_whole(read_wheel_plan(root_.string()).value(), setup);
  EXPECT_EQ(setup.copies, (std::map<int, int>{{1, 3}})) << "the hub is one face";
  setup.copies.clear();
  text.replace(text.find(R"("whole": true)"), 13, R"("whole": false)");
  write_plan(text);
  stand_whole(read_wheel_plan(root_.string()).value(), setup);
  EXPECT_TRUE(setup.copies.empty()) << "of a piece of a wheel there are no copies";
}

TEST_F(WheelPlanFile, WhatIsLeftOutOfTheWheelIsACautionOfItsVerdict) {
  std::string text = kPlan;
  text.insert(text.find("\"operations\""), "\"left_out\": [\"F1\", \"F2\"], ");
  write_plan(text);
  const WheelPlan plan = read_wheel_plan(root_.string()).value();
  EXPECT_EQ(plan.left_out, (std::vector<std::string>{"F1", "F2"}));
  WheelPlan alone;
  for (const bool housing : {false, true}) {
    if (housing) alone.left_out = plan.left_out;
    Acceptance acceptance;
    accept_steps(alone, std::nullopt, acceptance);
    EXPECT_TRUE(acceptance.pass());
    ASSERT_EQ(acceptance.cautions.size(), housing ? 1U : 0U);
    for (const Shortfall& caution : acceptance.cautions)
      EXPECT_NE(caution.text.find("F1,F2: nothing was checked"), std::string::npos) << caution.text;
  }
}

TEST(JudgedRoughing, AnEngagementAboveTheLimitIsAReason) {
  JudgedRoughing roughing;
  roughing.tool.radial = RadialFunction(ToolFamily::kCylinder, 12.0, Eigen::VectorXd::Constant(1, 2.0));
  roughing.cuts.verdict = Verdict::kPass, roughing.cuts.tolerance_mm = 0.05;
  roughing.stock.kinds = {{.kind = "rough", .engagement_deg = 130.0, .strip = 4}};
  for (const double most : {180.0, 100.0}) {
    roughing.most_engagement_deg = most;
    Acceptance acceptance;
    accept_steps({}, roughing, acceptance);
    EXPECT_EQ(acceptance.pass(), most > 130.0);
    if (acceptance.pass()) continue;
    EXPECT_NE(acceptance.reasons.front().text.find("roughing: stock simulation"), std::string::npos);
  }
}

/// A hub [0, 40] x [0, 20] in y = 0, and the side of a blade on it, 9 mm high.
flank::internal::Setup blade_on_a_hub() {
  flank::internal::Setup setup;
  Face side = test::plane_face("F2", 40.0, 20.0);
  for (Vec3& p : side.surface.poles) p = Vec3(p.x(), 9.0 * p.z() / 20.0, 10.0);
  setup.part.faces = {test::plane_face("F1", 40.0, 20.0), side};
  setup.tolerance_mm = 0.05;
  return setup;
}

/// Tips of radius 1 along x with their spheres so high over the hub.
Path layers_at(const std::vector<double>& heights) {
  Path out;
  for (const double height : heights)
    out.strips.push_back(
        {1,
         "rough",
         "F1",
         {{Vec3(2.0, height + 1.0, 8.0), Vec3::UnitY()}, {Vec3(38.0, height + 1.0, 8.0), Vec3::UnitY()}}});
  return out;
}

TEST(FreeHeight, IsHowMuchDeeperAnOperationIsThanTheOneBeforeIt) {
  WheelPlan plan;
  plan.steps = {{.id = "10.1", .kind = "rough", .folder = "", .faces = {"F1"}, .problem = ""},
                {.id = "20", .kind = "side", .folder = "", .faces = {"F2"}, .problem = ""}};
  const flank::internal::Setup setup = blade_on_a_hub();
  const auto free = [&](const std::vector<Path>& operations) { return free_height(plan, setup, operations, 1.0); };
  EXPECT_NEAR(free({layers_at({6.0, 3.0, 0.5})}), 8.5, 1e-6) << "one operation: the whole side";
  EXPECT_NEAR(free({layers_at({6.0}), layers_at({3.0}), layers_at({0.5})}), 3.0, 1e-6);
  EXPECT_NEAR(free({layers_at({6.0}), layers_at({3.0, 0.5})}), 5.5, 1e-6);
  EXPECT_NEAR(free({layers_at({0.5}), layers_at({3.0})}), 8.5, 1e-6) << "an operation in the air frees nothing";
  plan.steps.pop_back();
  EXPECT_EQ(free({layers_at({0.5})}), 0.0) << "no side is known";
}

TEST(RoughLeft, IsWhatLiesBetweenTheSurfaceAndThePath) {
  flank::internal::Setup setup = blade_on_a_hub();
  setup.targets = {0};
  setup.part.box.add(Vec3(0.0, 0.0, 0.0)), setup.part.box.add(Vec3(40.0, 9.0, 20.0));
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, 12.0, Eigen::VectorXd::Constant(1, 1.0));
  // Passes half a millimetre apart, whose spheres leave 0.4 mm and a scallop of 0.032; over 30 % of the hub alone, or all of it.
  for (const double to : {6.0, 20.0}) {
    Path path;
    for (double z = 0.0; z <= to; z += 0.5)
      path.strips.push_back(
          {1, "rough", "F1", {{Vec3(0.0, 1.4, z), Vec3::UnitY()}, {Vec3(40.0, 1.4, z), Vec3::UnitY()}}});
    const RoughLeft left = left_by_roughing(setup, tool, path, 0.25);
    if (to == 20.0) {
      // Below a pass, and half way to the next one.
      EXPECT_GE(left.median_mm, 0.4 - 1e-9);
      EXPECT_LE(left.median_mm, left.nine_tenths_mm);
      EXPECT_LE(left.nine_tenths_mm, 1.4 - std::sqrt(1.0 - 0.25 * 0.25) + 1e-9);
      continue;
    }
    // From the last pass to the middle of what is open, and to nine tenths of all: 4 mm and 12 mm on, to a row of samples.
    const double apart = 0.01 * setup.part.box.diagonal();
    EXPECT_NEAR(left.median_mm, std::hypot(1.4, 4.0) - 1.0, apart);
    EXPECT_NEAR(left.nine_tenths_mm, std::hypot(1.4, 12.0) - 1.0, apart);
  }
}

TEST(JudgedRoughing, ABladeThatStandsFreeTooFarIsAReason) {
  JudgedRoughing roughing;
  roughing.tool.radial = RadialFunction(ToolFamily::kCylinder, 12.0, Eigen::VectorXd::Constant(1, 2.0));
  roughing.cuts.verdict = Verdict::kPass, roughing.cuts.tolerance_mm = 0.05;
  roughing.free_mm = 4.0;
  for (const double most : {0.0, 3.0, 5.0}) {
    roughing.most_free_mm = most;
    Acceptance acceptance;
    accept_steps({}, roughing, acceptance);
    EXPECT_EQ(acceptance.pass(), most != 3.0) << most;
    if (acceptance.pass()) continue;
    EXPECT_NE(acceptance.reasons.front().text.find("stands free on one side by 4.00 mm > 3.00"), std::string::npos);
  }
}

TEST(OperationFolders, EachHasAllOfItsCopiesInARow) {
  const auto program = [](int copy, int copies) {
    NcProgram one;
    one.header.operation = NcOperation{.copy = copy, .copies = copies};
    return one;
  };
  const std::vector<NcProgram> all{program(1, 2), program(2, 2), program(1, 1)};
  EXPECT_EQ(folders_of("p.nc", all, 2), (std::vector<std::size_t>{0, 0, 1}));
  EXPECT_THROW((void)folders_of("p.nc", all, 3), InputError);
  EXPECT_THROW((void)folders_of("p.nc", {program(1, 2), program(1, 1)}, 2), InputError);
  EXPECT_THROW((void)folders_of("p.nc", {program(1, 2)}, 1), InputError);
}

}  // namespace
}  // namespace flank::internal
