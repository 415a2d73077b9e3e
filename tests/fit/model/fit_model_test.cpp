// The least-squares model: its gradient and rows against finite differences, its solver against a dense one.
#include "flank/fit/model/fit_model.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <numeric>

#include "flank/base/random.h"
#include "flank/example.h"
#include "flank/example/example_perturb.h"
#include "obstacle/obstacle_scene.h"

namespace flank::internal {
namespace {

/// A small model of an exact envelope, started off it.
class FitModelTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const Example example = make_example("envelope-barrel-1", {.relative_accuracy = 1e-7});
    target_ = make_target(std::vector<Face>{example.faces.front()});
    Random random(3);
    const RuledMotion start = perturb(example.truth->motions.front(), 5e-3, example.diagonal_mm, random);
    stage_.samples_t = 12;
    stage_.samples_s = 7;
    stage_.control_points = 8;
    stage_.radius_pin = 1e-2;
    stage_.axial_pin = 1e-2;
    std::vector<Pose> poses;
    std::vector<double> times;
    for (int i = 0; i <= 40; ++i) {
      times.push_back(i / 40.0);
      poses.push_back(start.pose(times.back()));
    }
    state_.motions.push_back(fit_motion(poses, times, start.axis_length, stage_.control_points));
    Eigen::VectorXd radii(6);
    for (int k = 0; k < 6; ++k) radii[k] = 6.0 + 0.2 * k * (5 - k) / 5.0;
    state_.tool = RadialFunction::spline(start.axis_length, radii);
  }

  FitModel make_model(const FitStage& stage) const {
    std::vector<int> all(static_cast<std::size_t>(state_.tool.parameter_count()));
    std::iota(all.begin(), all.end(), 0);
    return {{target_.get()}, state_, all, {6.1, 6.3, 0.02}, stage};
  }

  Eigen::VectorXd random_step(int size, double length) const {
    Random random(11);
    Eigen::VectorXd step(size);
    for (double& x : step) x = length * random.normal();
    return step;
  }

  /// The gradient of the cost against central differences.
  void expect_gradient(const FitModel& model) const {
    FitState state = state_;
    model.locate(state);
    const auto weights = model.sample_weights(state);
    ArrowSystem system = model.make_system();
    model.assemble(state, weights, system);
    const Eigen::VectorXd direction = random_step(system.size(), 1.0);
    const double h = 1e-6;
    FitState plus = model.moved(state, h * direction), minus = model.moved(state, -h * direction);
    model.locate(plus);
    model.locate(minus);
    const double numeric = (model.cost(plus, weights) - model.cost(minus, weights)) / (2.0 * h);
    EXPECT_NEAR(2.0 * system.gradient.dot(direction), numeric, 1e-5 * std::abs(numeric));
  }

  std::unique_ptr<Target> target_;
  FitStage stage_;
  FitState state_;
};

TEST_F(FitModelTest, GradientIsHalfTheDerivativeOfTheCost) {
  stage_.dead_zone_mm = 0.002;
  expect_gradient(make_model(stage_));
}

TEST_F(FitModelTest, GradientHoldsForToolsThatAreHardlyLegitimate) {
  Eigen::VectorXd radii = state_.tool.parameters();
  radii.array() += 34.0;
  radii[2] -= 30.0;  // r'' so large that the spheres are not inscribed
  state_.tool = state_.tool.with_parameters(radii);
  bool bent = false;
  for (int j = 0; j < stage_.samples_s; ++j) {
    const RadialJet jet = state_.tool.at(state_.motions.front().axis_length * j / (stage_.samples_s - 1));
    bent = bent || 1.0 - jet.d1 * jet.d1 - jet.r * jet.d2 < 0.0;
  }
  ASSERT_TRUE(bent);
  expect_gradient(make_model(stage_));
}

TEST_F(FitModelTest, GradientHoldsBesideCheckFaces) {
  // A wall across the tip of the axis, so that many balls enter it.
  const Pose pose = state_.motions.front().pose(0.5);
  const Vec3 x = pose.axis.unitOrthogonal(), y = pose.axis.cross(x), tip = pose.at(3.0);
  const Face wall =
      testing::quad(tip - 90 * x - 90 * y, tip + 90 * x - 90 * y, tip - 90 * x + 90 * y, tip + 90 * x + 90 * y, "F2");
  const ObstacleField obstacles(testing::only({make_target({wall}), true}), *target_, 2.0, 0.01);
  ASSERT_EQ(obstacles.sign(0), +1);
  std::vector<int> all(static_cast<std::size_t>(state_.tool.parameter_count()));
  std::iota(all.begin(), all.end(), 0);
  const FitModel model({target_.get()}, state_, all, {6.1, 6.3, 0.02}, stage_, {&obstacles});
  const FitModel without({target_.get()}, state_, all, {6.1, 6.3, 0.02}, stage_);
  FitState state = state_;
  model.locate(state);
  ASSERT_GT(model.regulariser_cost(state), without.regulariser_cost(state) + 1.0);
  expect_gradient(model);
}

TEST_F(FitModelTest, ArrowSolveIsTheDenseSolve) {
  const FitModel model = make_model(stage_);
  FitState state = state_;
  model.locate(state);
  ArrowSystem system = model.make_system();
  model.assemble(state, model.sample_weights(state), system);
  system.add_damping(1e-3);
  const int n = system.size();
  Eigen::MatrixXd dense(n, n);
  for (int k = 0; k < n; ++k) dense.col(k) = system.multiply(Eigen::VectorXd::Unit(n, k));
  EXPECT_LT((dense - dense.transpose()).norm(), 1e-12 * dense.norm());
  Eigen::VectorXd step;
  ASSERT_TRUE(system.solve(0.0, step));
  const Eigen::VectorXd expected = -dense.ldlt().solve(system.gradient);
  EXPECT_LT((step - expected).norm(), 1e-8 * expected.norm());
}

}  // namespace
}  // namespace flank::internal
