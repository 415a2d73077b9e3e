// The fit under hard limits: a cylinder before a twisted blade, which it cannot touch everywhere, and single points
// that it must not come near.
#include "flank/fit/model/constrained.h"
#include "flank/fit/coverage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/flat_scene.h"
#include "flank/fit/swept_polish.h"

namespace flank::internal {
namespace {

using testing::bare_stage;
using testing::cylinder;
using testing::twisted_blade;
using testing::upright_motion;

constexpr double kRadius = 4.0;

class Constrained : public ::testing::Test {
 protected:
  void make_scene(double lift, double y) {
    target_ = twisted_blade(lift);
    RuledMotion motion = upright_motion({.y = y, .z = -1.0, .x_first = 0.0, .x_last = 60.0, .length = 42.0});
    // Along the rulings of the blade.
    motion.direction = testing::straight_rail(Vec3(0.0, 0.0, 1.0), Vec3(0.0, lift / 40.0, 1.0), 8);
    draft_.targets = {target_.get()};
    draft_.motions = {motion};
    draft_.tool = cylinder(kRadius, 42.0);
    stage_ = bare_stage();
    stage_.fairness = 1e-3;
    stage_.transversal_anchor = 1e-2;
    stage_.axial_pin = 1e-4;
  }
  ConstrainedProblem problem(int per_side = 10, int dense_per_side = 40) const {
    return {draft_.targets, {}, {}, {}, stage_, target_points(draft_, per_side), target_points(draft_, dense_per_side)};
  }
  FitState start() const {
    FitDraft next;
    return start_state(draft_, stage_, next);
  }
  /// What is cut and what is left on samples of its own.
  CoverageEstimate measured(const FitState& state) const {
    std::vector<SurfaceSample> samples = target_->samples(1.1);
    for (const Vec3& point : target_->border_points(1.1)) samples.push_back({point, Vec3::UnitY(), 1.0});
    return estimate_coverage(samples, state.motions, state.tool, 0.1, 400);
  }

  std::unique_ptr<Target> target_;
  FitDraft draft_;
  FitStage stage_;
};

TEST_F(Constrained, TakesOutTheOvercutThatLeastSquaresLeaves) {
  make_scene(14.0, kRadius);
  FitDraft free_fit = run_swept(draft_, {}, stage_, target_points(draft_, 15), nullptr);
  const double overcut = measured({free_fit.motions, free_fit.tool, {}, {}, {}}).overcut_mm;
  ASSERT_GT(overcut, 0.005) << "the blade is twisted too little to ask for anything";
  const ConstrainedResult result = minimise_constrained(problem(), start(), {});
  EXPECT_LE(result.violation_mm, 1e-5);
  EXPECT_GT(result.steps, 0);
  const CoverageEstimate now = measured(result.state);
  EXPECT_LT(now.overcut_mm, 0.02 * overcut);
  EXPECT_LT(now.undercut_mm, 6.0 * overcut) << "it is laid on the blade, not lifted off it";
}

TEST_F(Constrained, AnAllowanceIsUsedAndKept) {
  make_scene(14.0, kRadius);
  ConstrainedOptions strict, lenient;
  lenient.allowed_overcut_mm = 0.004;
  const ConstrainedResult hard = minimise_constrained(problem(), start(), strict);
  const ConstrainedResult soft = minimise_constrained(problem(), start(), lenient);
  EXPECT_LE(soft.violation_mm, 1e-5);
  const CoverageEstimate a = measured(hard.state), b = measured(soft.state);
  // The samples lie between the points that are held.
  EXPECT_NEAR(b.overcut_mm, 0.004, 5e-4) << "room that is given is used";
  EXPECT_LT(b.rms_mm, a.rms_mm);
}

TEST_F(Constrained, PointsThatAreBrokenBetweenTheFirstOnesJoin) {
  make_scene(14.0, kRadius);
  ConstrainedOptions once;
  once.exchanges = 0;
  const ConstrainedResult first = minimise_constrained(problem(3), start(), once);
  const ConstrainedResult all = minimise_constrained(problem(3), start(), {});
  EXPECT_GT(first.violation_mm, 1e-4) << "three points a side are too few to hold it";
  EXPECT_GT(all.exchanged, first.exchanged);
  EXPECT_LT(all.violation_mm, 0.1 * first.violation_mm);
}

TEST_F(Constrained, AStartThatBreaksNothingAndFitsStaysWhereItIs) {
  make_scene(0.0, kRadius + 1e-7);
  const ConstrainedResult result = minimise_constrained(problem(), start(), {});
  EXPECT_EQ(result.exchanged, 0);
  EXPECT_LE(result.violation_mm, 1e-5);
  for (const double t : {0.0, 0.5, 1.0}) EXPECT_NEAR(result.state.motions.front().pose(t).at(20.0).y(), kRadius, 1e-4);
}

TEST_F(Constrained, ASunkenToolIsLiftedOntoThePlane) {
  make_scene(0.0, kRadius - 0.3);
  const ConstrainedResult result = minimise_constrained(problem(), start(), {});
  EXPECT_LE(result.violation_mm, 1e-5);
  EXPECT_LT(measured(result.state).undercut_mm, 1e-3);
}

TEST_F(Constrained, PointsOfOtherFacesKeepTheirMargin) {
  make_scene(0.0, kRadius);
  ConstrainedProblem with_point = problem();
  FacePoint guard;
  guard.point = Vec3(30.0, -0.05, 20.0);  // f there is 0.05 while the tool lies on the blade
  guard.role = FacePoint::Role::kAvoid;
  guard.margin_mm = 0.2;
  with_point.points.push_back(guard);
  with_point.dense.push_back(guard);
  const ConstrainedResult result = minimise_constrained(with_point, start(), {});
  EXPECT_LE(result.violation_mm, 1e-5);
  const SurfaceSample there{guard.point, Vec3::UnitY(), 1.0};
  const CoverageEstimate at = estimate_coverage({there}, result.state.motions, result.state.tool, 1.0, 400);
  EXPECT_NEAR(at.undercut_mm, 0.2, 2e-3) << "as near as allowed, not nearer";
  EXPECT_LT(measured(result.state).overcut_mm, 1e-4);
}

}  // namespace
}  // namespace flank::internal
