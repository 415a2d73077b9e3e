// The ladder of slendernesses on a flat blade, which any upright cylinder cuts exactly.
#include "flank/pipeline/search/stiff_fit.h"

#include <gtest/gtest.h>

#include "fit/flat_scene.h"
#include "flank/fit/rejected.h"
#include "flank/threads.h"

namespace flank::internal {
namespace {

using testing::standing_blade;
using testing::Upright;
using testing::upright_motion;

class Ladder : public ::testing::Test {
 protected:
  Ladder() {
    options_.tolerance_mm = 0.02;
    options_.bounds = {1.5, 9.0, 0.5};
    options_.bounds.slenderest = 8.0;
    options_.sample_share = 1.0 / 15.0;
  }
  /// From a cylinder of 5 mm on 42 mm, slenderness 4.2.
  [[nodiscard]] std::vector<FlankFitResult> fit_ladder_side(const Progress& progress = {}) const {
    FlankFitResult found;
    found.tool = RadialFunction::spline(42.0, Eigen::VectorXd::Constant(6, 5.0));
    found.motions = {upright_motion({.y = 5.0, .z = -1.0, .x_first = -3.0, .x_last = 63.0, .length = 42.0})};
    found.after.at_tolerance = 1.0;
    return stiffness_ladder({{blade_.get(), found.motions.front(), nullptr}}, found, {}, options_, progress);
  }

  std::unique_ptr<Target> blade_ = standing_blade(0.0);
  FlankFitOptions options_;
};

TEST_F(Ladder, HasARungForEverySlendernessThatTheBoundsAllow) {
  const std::vector<FlankFitResult> rungs = fit_ladder_side();
  // 42 / (2 * 9) = 2.33 and 42 / (2 * 1.5) = 14 are the ends; 4 is the tool itself.
  const std::vector<double> bounds = {3.0, 2.5, 5.0, 6.0, 8.0, 12.0};
  ASSERT_EQ(rungs.size(), bounds.size());
  for (std::size_t k = 0; k < rungs.size(); ++k) {
    const double slenderness = slenderness_of(rungs[k].tool, options_.bounds);
    EXPECT_LT(slenderness, 1.02 * bounds[k]) << k;
    EXPECT_TRUE(k < 2 || slenderness > bounds[k] / 1.2) << k << ": " << slenderness;
    EXPECT_GT(rungs[k].after.at_tolerance, 0.99) << "any cylinder does it, " << k;
  }
}

TEST_F(Ladder, IsTheSameForOneAndThreeThreads) {
  set_thread_count(1);
  const std::vector<FlankFitResult> one = fit_ladder_side();
  set_thread_count(3);
  const std::vector<FlankFitResult> three = fit_ladder_side();
  set_thread_count(0);
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_EQ(one[k].tool.parameters(), three[k].tool.parameters());
}

TEST_F(Ladder, EndsWhenTheUserHasHadEnough) {
  Progress progress;
  progress.cancelled = [] { return true; };
  EXPECT_TRUE(fit_ladder_side(progress).empty());
}

/// What covers half of the face, stiff as it was asked to be.
FlankFitResult stiff_but_short() {
  FlankFitResult within;
  within.tool = RadialFunction::spline(42.0, Eigen::VectorXd::Constant(6, 5.0));
  within.motions = {upright_motion({.y = 5.0, .z = -1.0, .x_first = -3.0, .x_last = 27.0, .length = 42.0})};
  within.after.at_tolerance = 0.5;
  return within;
}

TEST_F(Ladder, ABoundThatGivesWayComesBackAsFarAsTheToolMayBeThick) {
  // No radius above 2 mm is allowed, so 10.25 is the least that there is on 41 mm.
  options_.axis_length_mm = 41.0;
  options_.bounds.smallest = 0.5;
  options_.bounds.largest = 2.0;
  const FlankFitResult result = relax_stiffness_bounds(*blade_, {}, options_, stiff_but_short(), {});
  const double slenderness = slenderness_of(result.tool, options_.bounds);
  EXPECT_GT(result.after.at_tolerance, 0.99);
  EXPECT_GT(slenderness, 10.0);
  EXPECT_LT(slenderness, 11.6) << "an eighth of the way from the first";
  ASSERT_FALSE(result.notes.empty());
  EXPECT_NE(result.notes.back().find("is the lowest found that meets the request"), std::string::npos)
      << result.notes.back();
}

TEST_F(Ladder, ABoundThatCostsNothingIsKept) {
  options_.bounds.smallest = 0.5;
  const FlankFitResult result = relax_stiffness_bounds(*blade_, {}, options_, stiff_but_short(), {});
  EXPECT_GT(result.after.at_tolerance, 0.99);
  EXPECT_LT(slenderness_of(result.tool, options_.bounds), 1.05 * options_.bounds.slenderest);
}

TEST(NoteSlenderness, SaysWhatATooSlenderToolBuys) {
  FlankFitOptions options;
  options.bounds.slenderest = 8.0;
  FlankFitResult fit;
  fit.motions.resize(1);
  fit.after.at_tolerance = 0.95;
  fit.tool = RadialFunction::spline(80.0, Eigen::VectorXd::Constant(6, 5.0));
  note_slenderness({}, options, fit);
  EXPECT_TRUE(fit.notes.empty()) << "as slender as it may be";
  fit.tool = RadialFunction::spline(84.0, Eigen::VectorXd::Constant(6, 5.0));
  fit.rejected.resize(2);
  fit.rejected[0].slenderness = 6.0;
  fit.rejected[0].estimate.at_tolerance = 0.6;
  fit.rejected[1].slenderness = 9.0;
  fit.rejected[1].estimate.at_tolerance = 0.8;
  note_slenderness({}, options, fit);
  ASSERT_EQ(fit.notes.size(), 1u);
  for (const char* figure : {"8.40", "8.0", "95.0", "60.0"})
    EXPECT_NE(fit.notes[0].find(figure), std::string::npos) << figure;
  // A given tool is the user's.
  ToolModel given;
  given.make = [](double length, double radius) { return testing::cylinder(radius, length); };
  note_slenderness(given, options, fit);
  EXPECT_EQ(fit.notes.size(), 1u);
}

TEST(RejectedTools, AreThoseThatWereNotChosenInTheirOrder) {
  FlankFitResult chosen, beaten, empty;
  beaten.tool = RadialFunction::spline(30.0, Eigen::VectorXd::Constant(6, 5.0));
  beaten.motions.resize(2);
  beaten.after.at_tolerance = 0.5;
  beaten.rejected.resize(1);
  beaten.rejected[0].slenderness = 7.0;
  RadiusBounds bounds;
  add_rejected(chosen, beaten, bounds);
  add_rejected(chosen, empty, bounds);
  ASSERT_EQ(chosen.rejected.size(), 2u);
  EXPECT_EQ(chosen.rejected[0].slenderness, 7.0);
  EXPECT_NEAR(chosen.rejected[1].slenderness, 3.0, 1e-6);
  EXPECT_EQ(chosen.rejected[1].strips, 2);
  // A shank of the flank's radius makes the cylinder longer.
  bounds.shank_length = 15.0;
  EXPECT_NEAR(slenderness_of(beaten.tool, bounds), 4.5, 1e-3);
}

}  // namespace
}  // namespace flank::internal
