// The model on the swept distance: its rows against finite differences, its contacts against brute force, the
// constrained step on a face that the tool does not fit.
#include "flank/fit/model/swept_model.h"
#include "flank/fit/coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "flank/base/random.h"
#include "flank/example.h"
#include "flank/example/example_perturb.h"
#include "flank/fit.h"
#include "flank/fit/model/levenberg_marquardt.h"
#include "flank/fit/swept_polish.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

class SweptModelTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const Example example = make_example("envelope-barrel-2", {.relative_accuracy = 1e-7});
    diagonal_ = example.diagonal_mm;
    target_ = make_target(std::vector<Face>{example.faces.front()});
    Random random(3);
    draft_.targets = {target_.get()};
    draft_.motions = {perturb(example.truth->motions.front(), 5e-3, diagonal_, random)};
    draft_.tool = RadialFunction::spline(draft_.motions.front().axis_length, Eigen::VectorXd::Constant(6, 5.0));
    draft_.free_tool = true;
    stage_.samples_t = 20;
    stage_.samples_s = 8;
    stage_.control_points = 10;
    stage_.tool_coefficients = 8;
  }

  SweptModel make_model(int per_side, FitState& start) const {
    FitDraft next;
    start = start_state(draft_, stage_, next);
    return {target_points(draft_, per_side), draft_.targets, start, next.free_parameters, bounds_, stage_};
  }

  std::unique_ptr<Target> target_;
  double diagonal_ = 0.0;
  FitDraft draft_;
  FitStage stage_;
  RadiusBounds bounds_{1.0, 20.0, 0.9};
};

TEST_F(SweptModelTest, ContactsAreTheLeastOfBruteForce) {
  FitState state;
  const SweptModel model = make_model(12, state);
  model.locate(state);
  const RuledMotion& motion = state.motions.front();
  for (std::size_t k = 0; k < model.points().size(); k += kSanitized ? 70 : 7) {
    double least = 1e300;
    for (int i = 0; i <= 2000; ++i) {
      const Pose pose = motion.pose(i / 2000.0);
      for (int j = 0; j <= 200; ++j) {
        const double s = motion.axis_length * j / 200.0;
        least = std::min(least, (model.points()[k].point - pose.at(s)).norm() - state.tool.at(s).r);
      }
    }
    EXPECT_LE(state.contacts[k].f, least + 1e-9) << k;
    EXPECT_GT(state.contacts[k].f, least - 5e-3) << k;  // the grid is coarse, never deeper
  }
}

TEST_F(SweptModelTest, RowsAreTheDerivativesOfTheSweptDistance) {
  FitState state;
  const SweptModel model = make_model(12, state);
  model.locate(state);
  Random random(11);
  Eigen::VectorXd direction(model.make_system().size());
  for (double& x : direction) x = random.normal();
  const double h = 1e-5;
  FitState plus = model.moved(state, h * direction), minus = model.moved(state, -h * direction);
  model.locate(plus);
  model.locate(minus);
  const ArrowSystem system = model.make_system();
  int compared = 0;
  for (std::size_t k = 0; k < model.points().size(); ++k) {
    // Where another place of the motion takes over, f has a kink and no derivative.
    if (std::abs(plus.contacts[k].t - minus.contacts[k].t) > 1e-3) continue;
    const double numeric = (plus.contacts[k].f - minus.contacts[k].f) / (2.0 * h);
    EXPECT_NEAR(system.product(model.row(state, k), direction), numeric, 1e-4 * std::max(1.0, std::abs(numeric))) << k;
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

TEST_F(SweptModelTest, CheckPointsActFromOneSideOnly) {
  FitState state;
  FitDraft next;
  state = start_state(draft_, stage_, next);
  std::vector<FacePoint> points = target_points(draft_, 12);
  const SweptModel target_only(points, draft_.targets, state, next.free_parameters, bounds_, stage_);
  FacePoint far = points.front();
  far.point += Vec3(0.0, 0.0, 500.0);
  far.role = FacePoint::Role::kAvoid;
  far.share = 1.0;
  points.push_back(far);
  const SweptModel with_far(points, draft_.targets, state, next.free_parameters, bounds_, stage_);
  FitState a = state, b = state;
  target_only.locate(a);
  with_far.locate(b);
  EXPECT_DOUBLE_EQ(target_only.cost(a, target_only.sample_weights(a)), with_far.cost(b, with_far.sample_weights(b)));
}

TEST_F(SweptModelTest, FitsTheEnvelopeFromTheFace) {
  stage_.control_points = 16;
  stage_.tool_coefficients = 12;
  stage_.iterations = 25;
  stage_.transversal_anchor = 1e-7;
  stage_.axial_pin = 1e-8;
  stage_.fairness = 1e-9;
  FitState start;
  const SweptModel model = make_model(24, start);
  const MinimiseResult result = levenberg_marquardt(model, start);
  EXPECT_GT(result.trace.front().rms_mm / diagonal_, 5e-4);
  EXPECT_LT(result.trace.back().rms_mm / diagonal_, 2e-5);
}

TEST_F(SweptModelTest, AToolThatIsNoneStillHasContacts) {
  FitState state;
  const SweptModel model = make_model(12, state);
  Eigen::VectorXd radii(12);
  for (int k = 0; k < 12; ++k) radii[k] = k % 2 == 0 ? 5.0 : 25.0;
  state.tool = RadialFunction::spline(state.motions.front().axis_length, radii);
  model.locate(state);
  for (std::size_t k = 0; k < model.points().size(); ++k) {
    ASSERT_EQ(state.contacts[k].motion, 0) << k;
    EXPECT_TRUE(std::isfinite(state.contacts[k].f));
  }
}

TEST_F(SweptModelTest, AStateWithoutValuesHasNoCostAndIsNoStep) {
  FitState state;
  const SweptModel model = make_model(12, state);
  FitState lost = state;
  lost.motions.front().direction.poles.setConstant(std::numeric_limits<double>::quiet_NaN());
  model.locate(lost);
  EXPECT_TRUE(std::isnan(model.cost(lost, std::vector<double>(model.points().size(), 1.0))));
  const MinimiseResult result = levenberg_marquardt(model, lost);
  EXPECT_EQ(result.status, MinimiseStatus::kStalled);
}

TEST(ConstrainedSwept, TakesTheOvercutOutOfAGivenTool) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "minutes under a sanitizer";
#endif
  const Example example = make_example("ruled-blade");
  const std::unique_ptr<Target> target = make_target(std::vector<Face>{example.faces.front()});
  FlankFitOptions options;
  options.tolerance_mm = 0.1;
  ToolModel cylinder;
  cylinder.make = [](double length, double) {
    return RadialFunction(ToolFamily::kCylinder, length, Eigen::VectorXd::Constant(1, 4.0));
  };
  cylinder.radius = 4.0;
  const FlankFitResult fit = fit_automatic(*target, cylinder, options, {});
  const CoverageEstimate dense = estimate_coverage(target->samples(0.3), fit.motions, fit.tool, 0.1, 400);
  EXPECT_LT(dense.overcut_mm / example.diagonal_mm, 2e-5);
  EXPECT_GT(dense.at_tolerance, 0.99);
}

}  // namespace
}  // namespace flank::internal
