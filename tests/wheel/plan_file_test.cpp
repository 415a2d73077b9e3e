// plan.json says which operations are done, so that they are not done again.
#include "flank/wheel/plan_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "flank/base/atomic_file.h"
#include "flank/wheel/judge_whole.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

class PlanFile : public TemporaryFolder {
 protected:
  PlanFile() : TemporaryFolder("plan_file") {}
  [[nodiscard]] std::string file() const { return (root_ / "plan.json").string(); }
};

WheelResult plan() {
  WheelResult result;
  result.copies = 9;
  WheelOperation side{.id = "20", .kind = "side", .folder = "ops/20-side", .faces = {"F1", "F3"}};
  side.seconds = 41.5, side.key = "abc", side.done = true, side.pass = true;
  WheelOperation rough{.id = "10", .kind = "rough", .folder = "ops/10-rough", .faces = {"F3", "F70"}};
  rough.problem = "no room";
  result.operations = {rough, side};
  return result;
}

TEST_F(PlanFile, OperationsThatAreDoneComeBack) {
  write_file(file(), plan_json(plan()));
  const auto known = finished_operations(file());
  ASSERT_EQ(known.size(), 1U);
  const WheelOperation& side = known.at("20");
  EXPECT_EQ(side.key, "abc");
  EXPECT_EQ(side.folder, "ops/20-side");
  EXPECT_EQ(side.faces, (std::vector<std::string>{"F1", "F3"}));
  EXPECT_TRUE(side.pass);
}

/// A run that was stopped and goes on ends with the same bytes as one that was not.
TEST_F(PlanFile, DoesNotTellHowLongAnythingTook) {
  WheelResult other = plan();
  for (WheelOperation& operation : other.operations) operation.seconds += 7.0, operation.kept = true;
  EXPECT_EQ(plan_json(other), plan_json(plan()));
}

TEST_F(PlanFile, ARunThatIsStoppedTwiceLosesNothing) {
  WheelResult first = plan();
  for (const char* id : {"30", "50"})
    first.operations.push_back({.id = id, .kind = "floor", .folder = "ops", .key = "abc", .done = true});
  write_file(file(), plan_json(first));
  {
    // The next run takes the first operation, and is stopped after it.
    WheelResult second = plan();
    second.operations.clear();
    PlanKeeper keeper(file(), second);
    keeper.add(first.operations[1]);
  }
  EXPECT_EQ(finished_operations(file()).size(), 3U);
  WheelResult third = plan();
  third.operations.clear();
  PlanKeeper keeper(file(), third);
  // What is done anew is not finished before it is done.
  keeper.begin("30");
  EXPECT_EQ(finished_operations(file()).count("30"), 0U);
  EXPECT_EQ(finished_operations(file()).count("50"), 1U);
  for (const WheelOperation& operation : first.operations)
    if (operation.id != "50") keeper.add(operation);
  // Of another request, and part of the plan no more.
  keeper.end();
  EXPECT_EQ(finished_operations(file()).count("50"), 0U);
  EXPECT_EQ(finished_operations(file()).count("30"), 1U);
}

TEST_F(PlanFile, ADamagedPlanFinishesNothing) {
  EXPECT_TRUE(finished_operations(file()).empty());
  write_file(file(), "{\"schema\":\"openflank/plan/1\",\"operations\":[{\"id\":7}]}");
  EXPECT_TRUE(finished_operations(file()).empty());
  write_file(file(), plan_json(plan()).substr(0, 100));
  EXPECT_TRUE(finished_operations(file()).empty());
}

TEST(WheelVerdict, AnOperationThatIsNotThereIsAReason) {
  const Acceptance acceptance = plan().acceptance();
  EXPECT_FALSE(acceptance.pass());
  ASSERT_FALSE(acceptance.reasons.empty());
  EXPECT_NE(acceptance.reasons.front().text.find("operation 10 (rough)"), std::string::npos);
  EXPECT_NE(wheel_text(plan()).find("does NOT meet"), std::string::npos);
}

TEST(WheelVerdict, FiguresAreSummedByTheRolesOfFaces) {
  WheelRoles roles;
  roles.hub = {"F9"};
  WheelBlade blade;
  blade.ahead = {"F1"}, blade.behind = {"F2"}, blade.edges = {"F3"};
  roles.blades = {blade};
  VerifyReport report;
  const auto add = [&](const std::string& face, double area, double open, double within, double cut) {
    FaceVerdict verdict;
    verdict.face = face, verdict.target = true, verdict.area_mm2 = area, verdict.reachable_share = open;
    verdict.coverage_reachable = within, verdict.overcut_mm = cut;
    report.faces.push_back(verdict);
  };
  add("F1", 100.0, 0.5, 1.0, 0.01);
  // Pieces of a face that is folded.
  add("F2a", 60.0, 0.5, 0.0, 0.03);
  add("F2b", 40.0, 0.5, 0.0, 0.02);
  add("F9", 10.0, 1.0, 0.9, 0.0);
  const std::vector<RoleFigures> figures = role_figures(roles, report);
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_EQ(figures[0].role, "side");
  EXPECT_DOUBLE_EQ(figures[0].open_mm2, 100.0);
  EXPECT_DOUBLE_EQ(figures[0].within_mm2, 50.0);
  EXPECT_DOUBLE_EQ(figures[0].cut_mm, 0.03);
  EXPECT_EQ(figures[1].role, "hub");
  EXPECT_DOUBLE_EQ(figures[1].within_mm2, 9.0);
}

}  // namespace
}  // namespace flank::internal
