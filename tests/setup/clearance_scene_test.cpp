// What is kept clear of is read once: the scene does not look at the files again.
#include "flank/setup/clearance_scene.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "cover/cover_targets.h"
#include "flank/error.h"
#include "flank/setup/make_obstacles.h"
#include "flank/setup/tool_body.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

class Scene : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) / ("flank_scene_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    setup_.part.file = "plate.step";
    for (const double height : {0.0, -20.0, -40.0}) setup_.part.faces.push_back(flat(height));
    setup_.targets = {0};
    setup_.checks = {2};
    setup_.tolerance_mm = 0.05;
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] Face flat(double height) const {
    Face face = testing::flat_face(0.0, 60.0, 0.0, 40.0, height);
    face.id = "F" + std::to_string(setup_.part.faces.size() + 1);
    return face;
  }
  /// A triangle at this height, as a fixture.
  [[nodiscard]] std::string fixture(const std::string& name, double height) const {
    const std::string file = (folder_ / name).string(), z = std::to_string(height);
    std::ofstream(file) << "solid s\n facet normal 0 0 1\n  outer loop\n   vertex -50 -50 " << z
                        << "\n   vertex 150 -50 " << z << "\n   vertex 0 150 " << z
                        << "\n  endloop\n endfacet\nendsolid s\n";
    return file;
  }
  /// Lies along x, 6 mm above the target, with a shank.
  [[nodiscard]] static Tool tool() {
    Tool tool = testing::cylinder(4.0, 10.0);
    tool.shank = {{10.0, 4.0}, {30.0, 4.0}};
    return tool;
  }
  [[nodiscard]] static Path path() {
    Path path;
    path.strips.push_back({});
    for (double y : {10.0, 20.0}) path.strips[0].poses.push_back({Vec3(10.0, y, 6.0), Vec3::UnitX()});
    return path;
  }

  fs::path folder_;
  internal::Setup setup_;
};

TEST_F(Scene, HasTargetsCheckFacesAndFixtures) {
  setup_.fixtures = read_fixtures({fixture("vice.stl", 30.0)}, "mm");
  std::vector<std::string> notes;
  const ClearanceScene scene = make_clearance_scene(setup_, {}, true, notes);
  ASSERT_EQ(scene.obstacles.obstacles().size(), 3u) << "the face that is ignored is not there";
  EXPECT_EQ(scene.obstacles.obstacles()[0].role, ObstacleRole::kTarget);
  EXPECT_EQ(scene.obstacles.obstacles()[0].name, "F1");
  EXPECT_EQ(scene.obstacles.obstacles()[1].role, ObstacleRole::kPart);
  EXPECT_EQ(scene.obstacles.obstacles()[1].name, "F3");
  EXPECT_EQ(scene.obstacles.obstacles()[2].role, ObstacleRole::kFixture);
  EXPECT_EQ(scene.obstacles.obstacles()[2].name, "vice.stl F1");
}

TEST_F(Scene, DoesNotReadFixturesAgain) {
  ObstacleRequest request;
  setup_.fixtures = read_fixtures({fixture("vice.stl", 15.0)}, "mm");
  request.clearance_mm = 1.0;
  std::vector<std::string> notes;
  const ClearanceScene scene = make_clearance_scene(setup_, request, true, notes);
  fs::remove_all(folder_);
  const ClearanceReport first = measure_clearance(scene, tool(), path());
  const ClearanceReport second = measure_clearance(scene, tool(), path());
  ASSERT_EQ(first.figures.size(), second.figures.size());
  bool seen = false;
  for (std::size_t k = 0; k < first.figures.size(); ++k) {
    EXPECT_EQ(first.figures[k].clearance_mm, second.figures[k].clearance_mm);
    const ClearanceFigure& f = first.figures[k];
    if (f.body != ToolBody::kShank) continue;
    const double expected = f.role == ObstacleRole::kFixture ? 5.0 : f.role == ObstacleRole::kTarget ? 2.0 : 42.0;
    EXPECT_NEAR(f.clearance_mm, expected, 1e-3) << role_name(f.role);
    seen = seen || f.role == ObstacleRole::kFixture;
    if (f.role != ObstacleRole::kTarget) {
      EXPECT_EQ(f.required_mm, 1.0);
    }
  }
  EXPECT_TRUE(seen);
}

TEST_F(Scene, WithoutABodyOnlyWhatCouldHoldTheToolIsAsked) {
  std::vector<std::string> notes;
  const ClearanceScene scene = make_clearance_scene(setup_, {}, false, notes);
  EXPECT_TRUE(measure_clearance(scene, testing::cylinder(4.0, 10.0), path()).figures.empty());
  EXPECT_TRUE(notes.empty());
  VerifyReport report;
  measure_bodies(scene, testing::cylinder(4.0, 10.0), path(), report);
  EXPECT_TRUE(report.clearance.figures.empty());
  ASSERT_TRUE(report.hold);
  EXPECT_TRUE(report.hold->as_thick);
  // Of a part of which no face is judged nothing is asked.
  internal::Setup none = setup_;
  none.targets.clear();
  none.checks.clear();
  EXPECT_TRUE(make_clearance_scene(none, {}, false, notes).obstacles.obstacles().empty());
}

TEST_F(Scene, RefusesRequestsThatMakeNoSense) {
  const auto refusal = [](auto change, const Tool* given) -> std::string {
    ObstacleRequest request;
    change(request);
    try {
      check_obstacles(request, given);
    } catch (const UsageError& e) {
      return e.what();
    }
    return "accepted";
  };
  const Tool bare = testing::cylinder(4.0, 10.0), with_shank = tool();
  const auto clearance = [](ObstacleRequest& r) { r.clearance_mm = 1.0; };
  EXPECT_EQ(refusal(clearance, nullptr).rfind("clearance_mm: needs `shank_length_mm`", 0), 0u);
  EXPECT_NE(refusal(clearance, &bare), "accepted");
  EXPECT_EQ(refusal(clearance, &with_shank), "accepted");
  EXPECT_EQ(refusal([](ObstacleRequest& r) { r.shank_radius_mm = 4.0; }, nullptr).rfind("shank_radius_mm: ", 0), 0u);
  EXPECT_EQ(refusal([](ObstacleRequest& r) { r.holder = "30:10,20:10"; }, nullptr)
                .rfind("holder 30:10,20:10: z falls from 30 to 20", 0),
            0u);
  ObstacleRequest missing;
  missing.fixtures = {"/nowhere/vice.step"};
  EXPECT_THROW(check_obstacles(missing, nullptr), InputError);
}

TEST_F(Scene, ShankAndHolderStandOnTheFlank) {
  ObstacleRequest request;
  request.shank_length_mm = 30.0;
  request.holder = "30:10,70:12";
  Tool made = testing::cylinder(4.0, 10.0);
  EXPECT_FALSE(has_body(made));
  equip_tool(request, made);
  EXPECT_TRUE(has_body(made));
  ASSERT_EQ(made.shank.size(), 2u);
  EXPECT_EQ(made.shank[0], Vec2(10.0, 4.0)) << "as thick as the flank's upper end";
  EXPECT_EQ(made.shank[1], Vec2(40.0, 4.0));
  EXPECT_EQ(made.holder[0], Vec2(40.0, 10.0));
  EXPECT_EQ(made.holder[1], Vec2(80.0, 12.0));
  request.shank_radius_mm = 3.0;
  equip_tool(request, made);
  EXPECT_EQ(made.shank[0], Vec2(10.0, 3.0)) << "in the place of the tool's own";
}

}  // namespace
}  // namespace flank::internal
