// A shank that nobody has given: when one is chosen, and how thick it may be.
#include "flank/pipeline/auto_shank.h"

#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "flank/error.h"

namespace flank::internal {
namespace {

TEST(DefaultShank, IsChosenWhereNothingSaysWhatStandsAboveTheFlank) {
  ObstacleRequest request;
  EXPECT_EQ(default_shank(request, false), "auto");
  EXPECT_EQ(default_shank(request, true), "given") << "the tool brings its own";
  request.shank = "none";
  EXPECT_EQ(default_shank(request, false), "none");
  request = {};
  request.shank_length_mm = 20.0;
  EXPECT_EQ(default_shank(request, false), "given");
  request = {};
  request.holder = "0:10,30:10";
  EXPECT_EQ(default_shank(request, false), "given") << "the holder stands on the flank";
}

/// A flank of radius 5 up to z = 20, upright, along a wall that begins at z = 22 and stands `away` from its axis.
class ChosenClearShank : public ::testing::Test {
 protected:
  static ClearanceScene scene(double away) {
    ClearanceScene scene;
    Obstacle wall{.name = "F1", .mesh = {}};
    wall.mesh.vertices = {{-20, away, 22}, {60, away, 22}, {60, away, 80}, {-20, away, 80}};
    wall.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.obstacles = {wall};
    scene.options.tolerance_mm = 0.05;
    scene.has_body = true;
    return scene;
  }
  static ObstacleRequest chosen(double away, double slenderest, ObstacleRequest request = {}) {
    Box3 part;
    part.add(Vec3(0, 0, 0));
    part.add(Vec3(40, 30, 40));
    choose_clear_shank(scene(away), way(), part, slenderest, flank(), request);
    return request;
  }
  static Tool flank() {
    Tool flank;
    flank.radial = RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 5.0));
    return flank;
  }
  static Path way() {
    Path path;
    path.strips.push_back({});
    path.strips[0].poses = {{Vec3(0, 0, 0), Vec3::UnitZ()}, {Vec3(40, 0, 0), Vec3::UnitZ()}};
    return path;
  }
};

TEST_F(ChosenClearShank, IsAsThickAsTheFlankWhereThatIsClear) {
  EXPECT_EQ(chosen(7.0, 8.0).shank_radius_mm, 5.0);
  EXPECT_EQ(chosen(7.0, 8.0).shank, "given");
}

TEST_F(ChosenClearShank, IsTheThickestThatIsClear) {
  const ObstacleRequest found = chosen(3.5, 8.0);
  ASSERT_TRUE(found.shank_radius_mm);
  EXPECT_LE(*found.shank_radius_mm, 3.5);
  EXPECT_GE(*found.shank_radius_mm, 3.5 - 0.03);
}

TEST_F(ChosenClearShank, StaysAsThickAsTheFlankWhereAThinnerOneWouldBendTooMuch) {
  EXPECT_EQ(chosen(1.0, 4.0).shank_radius_mm, 5.0);
}

TEST_F(ChosenClearShank, IsAsLongAsItsHolderNeeds) {
  Box3 part;
  part.add(Vec3(-20, 0, 0));
  part.add(Vec3(60, 30, 80));
  for (const auto& [away, least] : {std::pair(30.0, 20.0), {7.0, 60.0}}) {
    ObstacleRequest obstacles;
    obstacles.shank = "given", obstacles.shank_length_mm = 20.0, obstacles.shank_radius_mm = 5.0;
    Tool tool = flank();
    lengthen_for_holder(scene(away), way(), part, {{0.0, 10.0}, {30.0, 12.0}}, obstacles, tool);
    // Beside the wall the holder stands above its end, at 80.
    EXPECT_GE(obstacles.shank_length_mm.value(), least);
    EXPECT_LE(obstacles.shank_length_mm.value(), least + 1.0);
    ASSERT_EQ(tool.holder.size(), 2U);
    EXPECT_EQ(tool.holder.front(), Vec2(20.0 + *obstacles.shank_length_mm, 10.0));
    EXPECT_EQ(tool.holder.back(), Vec2(50.0 + *obstacles.shank_length_mm, 12.0));
  }
}

/// Plans whose first comes too near with the shank that it has chosen, and whose second ends as `second` does.
Result found_beside(const std::function<Result(Result first)>& second) {
  Result first;
  first.complete = true;
  first.tool.radial = RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 5.0));
  FitJob chosen;
  chosen.obstacles.shank_length_mm = 30.0;
  first.job = chosen;
  first.chord_bound_mm = 0.125;
  first.verify.clearance.figures.resize(1);
  first.verify.clearance.figures[0].kept = false;
  const ShankPlan<FitJob> plan = [&](const FitJob&, KnownShank known, const Progress&) {
    return known == KnownShank::kInTheWay ? second(first) : first;
  };
  return with_room_for_shank<FitJob>(FitJob{}, false, kAnySlenderness, plan, {});
}

TEST(RoomForShank, AStopOfTheSecondPlanKeepsWhatTheFirstFound) {
  const auto stopped = [](Result) -> Result { throw Stopped(); };
  const auto incomplete = [](Result first) {
    first.complete = false;
    first.chord_bound_mm = 0.0;
    return first;
  };
  for (const Result& found : {found_beside(stopped), found_beside(incomplete)}) {
    EXPECT_EQ(found.chord_bound_mm, 0.125);
    EXPECT_FALSE(found.complete);
    EXPECT_TRUE(found.journal) << "it can be gone on with";
  }
}

/// A plan without a fault whose tool has this radius and a shank of this length.
Result sound_plan(double radius, double shank_mm) {
  Result result;
  result.complete = true;
  result.tool.radial = RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, radius));
  result.tool.shank = {{20.0, radius}, {20.0 + shank_mm, radius}};
  result.verify.verdict = Verdict::kPass;
  result.verify.coverage = result.verify.coverage_reachable = result.verify.reachable_share = 1.0;
  result.verify.coverage_bound = result.verify.coverage_reachable_bound = 1.0;
  FitJob job;
  job.obstacles.shank_length_mm = shank_mm;
  result.job = job;
  return result;
}

TEST(RoomForShank, ATooSlenderToolIsPlannedAgainWithTheLengthOfItsShank) {
  ASSERT_TRUE(sound_plan(1.0, 40.0).acceptance().reasons.empty());
  std::vector<double> lengths;
  const ShankPlan<FitJob> plan = [&](const FitJob& job, KnownShank known, const Progress&) {
    if (known == KnownShank::kNothing) return sound_plan(1.0, 40.0);
    EXPECT_EQ(known, KnownShank::kLength);
    EXPECT_FALSE(job.obstacles.shank_radius_mm) << "it is chosen anew";
    lengths.push_back(*job.obstacles.shank_length_mm);
    // Its axis leans otherwise, and has a longer way out of the part.
    return lengths.size() == 1 ? sound_plan(4.0, 60.0) : sound_plan(5.5, 62.0);
  };
  const Result found = with_room_for_shank<FitJob>(FitJob{}, false, 8.0, plan, {});
  EXPECT_EQ(lengths, (std::vector<double>{40.0, 60.0}));
  EXPECT_LE(stiffness(found.tool).slenderness, 8.0);
  lengths.clear();
  EXPECT_EQ(with_room_for_shank<FitJob>(FitJob{}, false, kAnySlenderness, plan, {}).tool.radial.at(0.0).r, 1.0);
  EXPECT_TRUE(lengths.empty()) << "nobody has bound the stiffness of a given tool";
}

TEST(RoomForShank, ASecondPlanThatIsNoStifferOrHasAFaultIsNotTaken) {
  Result faulty = sound_plan(6.0, 40.0);
  faulty.verify.coverage_reachable = 0.5;
  for (const Result& second : {sound_plan(0.9, 40.0), faulty}) {
    const ShankPlan<FitJob> plan = [&](const FitJob&, KnownShank known, const Progress&) {
      return known == KnownShank::kNothing ? sound_plan(1.0, 40.0) : second;
    };
    EXPECT_EQ(with_room_for_shank<FitJob>(FitJob{}, false, 8.0, plan, {}).tool.radial.at(0.0).r, 1.0);
  }
}

TEST_F(ChosenClearShank, IsAsThickAsWasAsked) {
  ObstacleRequest request;
  request.shank_radius_mm = 4.0;
  EXPECT_EQ(chosen(3.5, 8.0, request).shank_radius_mm, 4.0);
}

}  // namespace
}  // namespace flank::internal
