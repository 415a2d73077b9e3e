// What is known of a tool before a strip is grown, and the order in which tools come.
#include "flank/tool_choice/tool_ranking.h"

#include <gtest/gtest.h>

#include <atomic>
#include <span>

#include "cover/cover_targets.h"
#include "flank/threads.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

Tool barrel(double arc, double radius, double length) {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kBarrel, length, Eigen::Vector3d(arc, radius, 0.5 * length));
  return tool;
}

TEST(ToolScreen, ACylinderIsOpenAllOverAPlane) {
  const auto target = testing::flat_target(0.0, 50.0, 0.0, 30.0);
  const ScreenPlaces places = screen_places(*target, 100);
  EXPECT_NEAR(places.width_mm, 27.0, 3.1) << "between the outermost cells' middles";
  const ToolScreen screen = screen_tool(places, testing::cylinder(4.0, 16.0), {}, {0.01});
  EXPECT_EQ(screen.reason, "");
  EXPECT_NEAR(screen.open, 1.0, 1e-12);
  EXPECT_NEAR(screen.mean_error_mm, 0.0, 1e-12);
}

TEST(ToolScreen, SaysThatABallTouchesNowhere) {
  const auto target = testing::flat_target(0.0, 20.0, 0.0, 20.0);
  const ToolScreen screen =
      screen_tool(screen_places(*target, 60), testing::cylinder(4.0, 10.0), testing::lid_at(1.0), {0.01});
  EXPECT_EQ(screen.reachable, 0.0);
  EXPECT_NE(screen.reason.find("4 mm, touches the face nowhere"), std::string::npos) << screen.reason;
}

TEST(ToolScreen, SaysThatTheToolStandsInTheWay) {
  // The ball of 2 mm fits below a lid at 5 mm; the shank of 4 mm does not, however the tool lies.
  const auto target = testing::flat_target(0.0, 20.0, 0.0, 20.0);
  Tool tool = testing::cylinder(2.0, 10.0);
  const ScreenPlaces places = screen_places(*target, 60);
  EXPECT_EQ(screen_tool(places, tool, testing::lid_at(5.0), {0.01}).reason, "");
  tool.shank = {{10.0, 4.0}, {40.0, 4.0}};
  const ToolScreen screen = screen_tool(places, tool, testing::lid_at(5.0), {0.01});
  EXPECT_NEAR(screen.reachable, 1.0, 1e-12);
  EXPECT_EQ(screen.open, 0.0);
  EXPECT_NE(screen.reason.find("(100 % of the face), flank, shank or holder would collide with the part"),
            std::string::npos)
      << screen.reason;
}

TEST(ToolScreen, SaysWhatTheHollowNeeds) {
  const auto hollow = make_target(make_example("elliptic-side").faces, -1);
  const ToolScreen screen = screen_tool(screen_places(*hollow, 60), testing::cylinder(80.0, 60.0), {}, {0.001});
  EXPECT_EQ(screen.fits, 0.0);
  EXPECT_NE(screen.reason.find("needs a tool radius below 4"), std::string::npos) << screen.reason;
  EXPECT_NE(screen.reason.find("the smallest of this tool is 80 mm"), std::string::npos) << screen.reason;
}

TEST(ToolScreen, SaysHowFarAMeridianIsOff) {
  const auto target = testing::flat_target(0.0, 50.0, 0.0, 30.0);
  const Tool tool = barrel(50.0, 5.0, 20.0);
  const ScreenOptions options{0.01};
  const ToolScreen screen = screen_tool(screen_places(*target, 60), tool, {}, options);
  // A plane has lambda = 0 everywhere: e = |r''| L^2 / 16, least at the outermost of the spheres.
  const double s = 0.5 / options.spheres * 20.0;
  EXPECT_NEAR(screen.least_error_mm, std::abs(tool.radial.at(s).d2) * 400.0 / 16.0, 1e-9);
  EXPECT_EQ(screen.accepted, 0.0);
  EXPECT_NE(screen.reason.find("along its 20 mm the error is at least 0.525 mm"), std::string::npos) << screen.reason;
}

/// A ranking in which strips are not grown: what a tool covers is read off its radius, in hundredths of a millimetre
/// over 1 mm; it needs as many strips as its axis has millimetres over 10, each 60 mm long.
class FakeRanking : public ::testing::Test {
 protected:
  FakeRanking() {
    options_.cover.tolerance_mm = 0.01;
    options_.cover_with = [this](const Target&, const Tool& tool, const Obstacles&, const CoverOptions& options,
                                 const Progress&) {
      ++(options.smooth ? full_ : options.seed_places == options_.quick_places ? quick_ : thorough_);
      CoverResult result;
      result.coverage = 100.0 * (tool.radial.at(0.0).r - 1.0);
      for (int k = 0; k < static_cast<int>(tool.radial.axis_length()) - 10; ++k)
        result.motions.push_back(testing::straight_motion(tool.radial.axis_length()));
      if (result.motions.empty()) result.message = "no strip of 0 mm";
      return result;
    };
  }
  /// Tool of a coverage and a number of strips.
  static Tool tool(double coverage, int strips) { return testing::cylinder(1.0 + 0.01 * coverage, 10.0 + strips); }
  std::vector<RankedTool> rank(const std::vector<Tool>& tools, const Progress& progress = {}) {
    const RankingTarget target = {target_.get(), &none_};
    return rank_tools(std::span(&target, 1), tools, options_, progress);
  }

  std::unique_ptr<Target> target_ = testing::flat_target(0.0, 50.0, 0.0, 30.0);
  Obstacles none_;
  RankingOptions options_;
  std::atomic<int> quick_{0}, thorough_{0}, full_{0};
};

TEST_F(FakeRanking, CoverageLessThePriceOfStripsThenTime) {
  options_.finalists = 10;
  // Worth 0.90 - 0.02, 0.92 - 0.05, 0.901 - 0.02 (the same step as the first, and the same time: as given), 0.88 - 0.005.
  const std::vector<RankedTool> ranked = rank({tool(0.90, 4), tool(0.92, 10), tool(0.901, 4), tool(0.885, 1)});
  std::vector<std::size_t> order;
  for (const RankedTool& r : ranked) order.push_back(r.tool);
  EXPECT_EQ(order, (std::vector<std::size_t>{3, 0, 2, 1}));
  EXPECT_EQ(ranked[0].stage, RankingStage::kFull);
  EXPECT_NEAR(ranked[1].coverage, 0.90, 1e-12);
  EXPECT_EQ(ranked[1].strips, 4);
}

TEST_F(FakeRanking, TimeIsStripsAtTheFeedAndLinksAtTheRapidRate) {
  EXPECT_NEAR(strip_length(testing::straight_motion(20.0)), 60.0, 1e-9);
  options_.rates = {600.0, 3000.0};
  const RankedTool ranked = rank({tool(0.9, 3)}).front();
  EXPECT_NEAR(ranked.strips_mm, 180.0, 1e-9);
  EXPECT_NEAR(ranked.links_mm, 120.0, 1e-9) << "each strip starts where the last one started";
  EXPECT_NEAR(ranked.minutes, 180.0 / 600.0 + 120.0 / 3000.0, 1e-12);
}

TEST_F(FakeRanking, TheBetterHalfGoesOn) {
  std::vector<Tool> tools;
  for (int k = 0; k < 20; ++k) tools.push_back(tool(0.5 + 0.02 * k, 2));
  const std::vector<RankedTool> ranked = rank(tools);
  EXPECT_EQ(quick_, 20);
  EXPECT_EQ(thorough_, 10);
  EXPECT_EQ(full_, 3);
  for (int k = 0; k < 20; ++k) EXPECT_EQ(ranked[k].tool, 19u - k);
  EXPECT_EQ(ranked[2].stage, RankingStage::kFull);
  EXPECT_EQ(ranked[3].stage, RankingStage::kThorough);
  EXPECT_EQ(ranked[10].stage, RankingStage::kQuick);
}

TEST_F(FakeRanking, ThoseThatCannotWorkAreLastAndNotTried) {
  const std::vector<RankedTool> ranked = rank({barrel(50.0, 5.0, 20.0), tool(0.9, 0), tool(0.3, 1)});
  EXPECT_EQ(ranked[0].tool, 2u);
  EXPECT_EQ(ranked[1].reason, "no strip of 0 mm");
  EXPECT_EQ(ranked[2].tool, 0u);
  EXPECT_EQ(ranked[2].stage, RankingStage::kScreened);
  EXPECT_NE(ranked[2].reason.find("profile curvature does not match"), std::string::npos) << ranked[2].reason;
  EXPECT_EQ(full_, 2);
}

TEST_F(FakeRanking, AnInterruptedRankingKeepsWhatItHas) {
  std::vector<Tool> tools;
  for (int k = 0; k < 12; ++k) tools.push_back(tool(0.5 + 0.02 * k, 2));
  Progress progress;
  progress.cancelled = [&] { return thorough_ > 0; };
  const std::vector<RankedTool> ranked = rank(tools, progress);
  ASSERT_EQ(ranked.size(), 12u);
  EXPECT_EQ(full_, 0);
  EXPECT_EQ(ranked[0].stage, RankingStage::kQuick);
  EXPECT_EQ(ranked[0].tool, 11u);
}

TEST(ToolRanking, SameForAnyNumberOfThreads) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer; its parts are tested there by themselves";
  const auto target = testing::flat_target(0.0, 25.0, 0.0, 15.0);
  const Obstacles none;
  const RankingTarget targets = {target.get(), &none};
  const std::vector<Tool> tools = {testing::cylinder(4.0, 16.0), testing::cylinder(3.0, 16.0), barrel(50.0, 5.0, 20.0)};
  RankingOptions options;
  options.finalists = 1;
  options.cover.seed_places = options.quick_places = 6;
  options.quick_directions = 4;
  std::vector<std::vector<RankedTool>> runs;
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    runs.push_back(rank_tools(std::span(&targets, 1), tools, options, {}));
  }
  set_thread_count(0);
  EXPECT_GE(runs[0].front().coverage, 0.97);
  EXPECT_EQ(runs[0].back().tool, 2u);
  for (std::size_t k = 0; k < tools.size(); ++k) {
    EXPECT_EQ(runs[0][k].tool, runs[1][k].tool);
    EXPECT_EQ(runs[0][k].coverage, runs[1][k].coverage);
    EXPECT_EQ(runs[0][k].minutes, runs[1][k].minutes);
  }
}

}  // namespace
}  // namespace flank::internal
