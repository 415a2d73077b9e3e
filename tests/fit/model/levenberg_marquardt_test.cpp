// The minimiser on small models whose unknowns are the coefficients of a spline: least squares with a known answer.
#include "flank/fit/model/levenberg_marquardt.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <functional>
#include <limits>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

/// Residuals of four unknowns and their Jacobian, row by row.
struct Residuals {
  Eigen::VectorXd values;
  Eigen::MatrixXd jacobian;
};

/// What levenberg_marquardt asks of a model, over x = the four coefficients of the state's tool. The system's one
/// motion rests: its matrix is the identity, and nothing pulls at it.
class SmallModel {
 public:
  using Function = std::function<Residuals(const Eigen::VectorXd&)>;
  SmallModel(Function function, const FitStage& stage) : function_(std::move(function)), stage_(stage) {}

  static ArrowSystem make_system() { return ArrowSystem({4}, 4); }
  void locate(FitState&) const { ++locates; }
  [[nodiscard]] const FitStage& stage() const { return stage_; }
  [[nodiscard]] Residuals residuals(const FitState& state) const { return function_(state.tool.parameters()); }
  [[nodiscard]] std::vector<double> sample_weights(const FitState& state) const {
    const Residuals at = residuals(state);
    std::vector<double> weights;
    const double scale = stage_.robust_scale_mm;
    for (const double e : at.values)
      weights.push_back(scale > 0.0 ? 1.0 / std::pow(1.0 + e * e / (scale * scale), 2) : 1.0);
    return weights;
  }
  [[nodiscard]] double cost(const FitState& state, const std::vector<double>& weights) const {
    const Residuals at = residuals(state);
    double sum = 0.0;
    for (Eigen::Index k = 0; k < at.values.size(); ++k)
      sum += weights[static_cast<std::size_t>(k)] * at.values[k] * at.values[k];
    return sum;
  }
  void assemble(const FitState& state, const std::vector<double>& weights, ArrowSystem& system) const {
    system.clear();
    PoseTerms rest;
    rest.matrix = Mat6::Identity();
    for (int k = 0; k < 4; ++k) {
      std::array<double, 4> basis{};
      basis[static_cast<std::size_t>(k)] = 1.0;
      system.add_pose(0, 0, basis.data(), rest, false);
    }
    const Residuals at = residuals(state);
    for (Eigen::Index k = 0; k < at.values.size(); ++k) {
      const double w = weights[static_cast<std::size_t>(k)];
      const Eigen::VectorXd j = at.jacobian.row(k);
      system.tool_matrix += w * j * j.transpose();
      system.gradient.tail(4) += w * at.values[k] * j;
    }
  }
  [[nodiscard]] FitState moved(const FitState& state, const Eigen::VectorXd& step) const {
    FitState next = state;
    next.tool = state.tool.with_parameters(state.tool.parameters() + step.tail(4));
    return next;
  }

  mutable int locates = 0;  ///< states at which contacts were asked for

 private:
  Function function_;
  FitStage stage_;
};

ResidualSummary summarise_residuals(const SmallModel& model, const FitState& state) {
  ResidualSummary summary;
  const Eigen::VectorXd values = model.residuals(state).values;
  summary.rms_mm = std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
  summary.largest_mm = values.cwiseAbs().maxCoeff();
  return summary;
}

FitState at(const Eigen::Vector4d& x) {
  FitState state;
  state.motions.resize(1);
  state.motions.front().axis_length = 1.0;
  state.tool = RadialFunction::spline(1.0, x);
  return state;
}

FitStage stage_of(int iterations, double step_tolerance = 1e-12) {
  FitStage stage;
  stage.iterations = iterations;
  stage.step_tolerance = step_tolerance;
  return stage;
}

/// Two valleys of Rosenbrock, the least of all at (1, 1, 1, 1).
Residuals rosenbrock(const Eigen::VectorXd& x) {
  Residuals out{Eigen::VectorXd(4), Eigen::MatrixXd::Zero(4, 4)};
  for (int k = 0; k < 4; k += 2) {
    out.values[k] = 10.0 * (x[k + 1] - x[k] * x[k]);
    out.values[k + 1] = 1.0 - x[k];
    out.jacobian(k, k) = -20.0 * x[k];
    out.jacobian(k, k + 1) = 10.0;
    out.jacobian(k + 1, k) = -1.0;
  }
  return out;
}

struct Linear {
  Eigen::MatrixXd matrix{30, 4};
  Eigen::VectorXd values{30};
};
Linear random_linear() {
  Random random(3);
  Linear out;
  for (double& x : out.matrix.reshaped()) x = random.normal();
  for (double& x : out.values) x = random.normal();
  return out;
}
SmallModel linear_model(const Linear& linear, const FitStage& stage) {
  return {[linear](const Eigen::VectorXd& x) {
            return Residuals{linear.matrix * x - linear.values, linear.matrix};
          },
          stage};
}

TEST(LevenbergMarquardt, LinearLeastSquaresIsWhatQrSays) {
  const Linear linear = random_linear();
  const MinimiseResult result = levenberg_marquardt(linear_model(linear, stage_of(30)), at({5.0, -3.0, 2.0, 9.0}));
  const Eigen::VectorXd expected = linear.matrix.colPivHouseholderQr().solve(linear.values);
  EXPECT_LT((result.state.tool.parameters() - expected).norm(), 1e-7 * expected.norm());
  // One step goes there; what follows changes only round-off.
  ASSERT_GE(result.trace.size(), 2u);
  EXPECT_NEAR(result.trace[1].cost, (linear.matrix * expected - linear.values).squaredNorm(), 1e-9);
}

TEST(LevenbergMarquardt, AConsistentSystemEndsAtZeroCost) {
  Linear linear = random_linear();
  const Eigen::Vector4d truth(0.5, -1.0, 2.0, 3.0);
  linear.values = linear.matrix * truth;
  const MinimiseResult result = levenberg_marquardt(linear_model(linear, stage_of(30)), at({9.0, 9.0, 9.0, 9.0}));
  EXPECT_LT((result.state.tool.parameters() - truth).norm(), 1e-12);
  EXPECT_LT(result.trace.back().cost, 1e-24);
}

TEST(LevenbergMarquardt, FollowsTheBentValleyOfRosenbrock) {
  const SmallModel model(rosenbrock, stage_of(200));
  const MinimiseResult result = levenberg_marquardt(model, at({-1.2, 1.0, 2.5, -1.5}));
  EXPECT_LT((result.state.tool.parameters() - Eigen::Vector4d::Ones()).norm(), 1e-9);
}

TEST(LevenbergMarquardt, TheTraceRunsFromTheStartToTheResultAndFalls) {
  const SmallModel model(rosenbrock, stage_of(200));
  const FitState start = at({-1.2, 1.0, 2.5, -1.5});
  const MinimiseResult result = levenberg_marquardt(model, start);
  EXPECT_NEAR(result.trace.front().cost, rosenbrock(start.tool.parameters()).values.squaredNorm(), 1e-12);
  const Eigen::VectorXd last = rosenbrock(result.state.tool.parameters()).values;
  EXPECT_DOUBLE_EQ(result.trace.back().cost, last.squaredNorm());
  EXPECT_DOUBLE_EQ(result.trace.back().rms_mm, std::sqrt(last.squaredNorm() / 4.0));
  EXPECT_DOUBLE_EQ(result.trace.back().largest_mm, last.cwiseAbs().maxCoeff());
  for (std::size_t k = 1; k < result.trace.size(); ++k) EXPECT_LT(result.trace[k].cost, result.trace[k - 1].cost) << k;
}

TEST(LevenbergMarquardt, StopsAfterTheStagesIterations) {
  const SmallModel model(rosenbrock, stage_of(3));
  const MinimiseResult result = levenberg_marquardt(model, at({-1.2, 1.0, 2.5, -1.5}));
  EXPECT_EQ(result.status, MinimiseStatus::kIterationLimit);
  EXPECT_EQ(result.trace.size(), 4u);
  const MinimiseResult none = levenberg_marquardt(SmallModel(rosenbrock, stage_of(0)), at({-1.2, 1.0, 2.5, -1.5}));
  EXPECT_EQ(none.status, MinimiseStatus::kIterationLimit);
  EXPECT_EQ(none.trace.size(), 1u);
  EXPECT_DOUBLE_EQ(none.state.tool.parameters()[0], -1.2);
}

TEST(LevenbergMarquardt, ConvergesWhenTwoStepsInARowChangeLittle) {
  // Gauss-Newton gains half of x per step on x^2: every step lowers the cost by 15/16, never less.
  const auto flat = [](const Eigen::VectorXd& x) {
    Residuals out{x.cwiseProduct(x), Eigen::MatrixXd((2.0 * x).asDiagonal())};
    return out;
  };
  const FitState start = at({1.0, 2.0, 3.0, 4.0});
  const MinimiseResult strict = levenberg_marquardt(SmallModel(flat, stage_of(20, 0.5)), start);
  EXPECT_EQ(strict.status, MinimiseStatus::kIterationLimit);
  EXPECT_EQ(strict.trace.size(), 21u);
  const MinimiseResult content = levenberg_marquardt(SmallModel(flat, stage_of(20, 0.99)), start);
  EXPECT_EQ(content.status, MinimiseStatus::kConverged);
  EXPECT_EQ(content.trace.size(), 3u);
  EXPECT_NEAR(content.trace[1].cost / content.trace[0].cost, 1.0 / 16.0, 1e-6);
}

TEST(LevenbergMarquardt, AtTheMinimumItStallsAndStays) {
  const Linear linear = random_linear();
  const Eigen::Vector4d best = linear.matrix.colPivHouseholderQr().solve(linear.values);
  const MinimiseResult result = levenberg_marquardt(linear_model(linear, stage_of(30)), at(best));
  EXPECT_NE(result.status, MinimiseStatus::kIterationLimit);
  EXPECT_LT((result.state.tool.parameters() - best).norm(), 1e-12);
}

TEST(LevenbergMarquardt, AGradientThatPointsUphillStallsAtTheStart) {
  const auto wrong = [](const Eigen::VectorXd& x) {
    Residuals out = rosenbrock(x);
    out.jacobian *= -1.0;
    return out;
  };
  const FitState start = at({-1.2, 1.0, 2.5, -1.5});
  const MinimiseResult result = levenberg_marquardt(SmallModel(wrong, stage_of(30)), start);
  EXPECT_EQ(result.status, MinimiseStatus::kStalled);
  EXPECT_EQ(result.state.tool.parameters(), start.tool.parameters());
  EXPECT_EQ(result.trace.size(), 1u);
}

TEST(LevenbergMarquardt, AStartWithoutACostIsHandedBack) {
  const FitState start = at({std::numeric_limits<double>::quiet_NaN(), 1.0, 1.0, 1.0});
  const MinimiseResult result = levenberg_marquardt(SmallModel(rosenbrock, stage_of(30)), start);
  EXPECT_EQ(result.status, MinimiseStatus::kStalled);
  EXPECT_EQ(result.trace.size(), 1u);
  ASSERT_EQ(result.state.motions.size(), 1u);
  EXPECT_TRUE(std::isnan(result.state.tool.parameters()[0]));
}

TEST(LevenbergMarquardt, AStepToWhereNothingIsDefinedIsShortened) {
  // log(x / 3) from 20: the full step is -38 and leaves the positive numbers.
  const auto logarithm = [](const Eigen::VectorXd& x) {
    Residuals out{Eigen::VectorXd(4), Eigen::MatrixXd::Zero(4, 4)};
    for (int k = 0; k < 4; ++k) {
      out.values[k] = std::log(x[k] / 3.0);
      out.jacobian(k, k) = 1.0 / x[k];
    }
    return out;
  };
  const MinimiseResult result = levenberg_marquardt(SmallModel(logarithm, stage_of(60)), at({20.0, 20.0, 1.0, 3.0}));
  EXPECT_LT((result.state.tool.parameters() - Eigen::Vector4d::Constant(3.0)).norm(), 1e-9);
  EXPECT_GT(result.trace[1].damping, 1e-9);
}

TEST(LevenbergMarquardt, FewStepsAreRefused) {
  const SmallModel model(rosenbrock, stage_of(200));
  const MinimiseResult result = levenberg_marquardt(model, at({-1.2, 1.0, 2.5, -1.5}));
  // Contacts are what a fit spends its time on: asked once for the start and once for every step that is tried.
  EXPECT_LT(model.locates, 1.7 * static_cast<double>(result.trace.size()));
}

/// Every control point is drawn to a place 5 axis lengths away, and no state was asked for that is farther than a step may go.
class FarModel : public SmallModel {
 public:
  using SmallModel::SmallModel;
  void assemble(const FitState& state, const std::vector<double>& weights, ArrowSystem& system) const {
    SmallModel::assemble(state, weights, system);
    system.gradient.head(24).setConstant(5.0);
  }
  [[nodiscard]] FitState moved(const FitState& state, const Eigen::VectorXd& step) const {
    farthest = std::max(farthest, step.head(24).cwiseAbs().maxCoeff());
    return SmallModel::moved(state, step);
  }
  mutable double farthest = 0.0;
};

TEST(LevenbergMarquardt, AStepFartherThanTheModelHoldsIsNotTried) {
  const FarModel model(rosenbrock, stage_of(3));
  const MinimiseResult result = levenberg_marquardt(model, at({-1.2, 1.0, 2.5, -1.5}));
  EXPECT_EQ(result.trace.size(), 4u);  // shortened, not given up
  EXPECT_GT(model.farthest, 0.01);
  EXPECT_LT(model.farthest, 0.5);  // of the axis length, 1
}

TEST(LevenbergMarquardt, RobustWeightsAreThoseOfTheResultAndLeaveAnOutlierAlone) {
  // The mean of x[0] over 0.9, 1.0, 1.1 and 50 is 13; robust it is 1.
  const auto data = [](const Eigen::VectorXd& x) {
    Residuals out{Eigen::VectorXd(7), Eigen::MatrixXd::Zero(7, 4)};
    out.values << x[0] - 0.9, x[0] - 1.0, x[0] - 1.1, x[0] - 50.0, x[1], x[2], x[3];
    out.jacobian.col(0).head(4).setOnes();
    out.jacobian.bottomRightCorner(3, 3).setIdentity();
    return out;
  };
  FitStage stage = stage_of(100);
  const MinimiseResult plain = levenberg_marquardt(SmallModel(data, stage), at({1.5, 0.0, 0.0, 0.0}));
  EXPECT_NEAR(plain.state.tool.parameters()[0], 13.25, 1e-9);
  stage.robust_scale_mm = 0.5;
  const SmallModel model(data, stage);
  const MinimiseResult robust = levenberg_marquardt(model, at({1.5, 0.0, 0.0, 0.0}));
  EXPECT_NEAR(robust.state.tool.parameters()[0], 1.0, 1e-4);
  // A fixed point of the reweighting: the weighted pulls at the result cancel.
  const std::vector<double> weights = model.sample_weights(robust.state);
  const Eigen::VectorXd e = model.residuals(robust.state).values;
  double pull = 0.0;
  for (int k = 0; k < 4; ++k) pull += weights[static_cast<std::size_t>(k)] * e[k];
  EXPECT_NEAR(pull, 0.0, 1e-8);
}

}  // namespace
}  // namespace flank::internal
