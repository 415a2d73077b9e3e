// The terms that keep the flank out of obstacles: a blade on a flat hub, where depths are known.
#include <gtest/gtest.h>

#include <cmath>

#include "fit/flat_scene.h"
#include "flank/fit/model/fit_model.h"
#include "flank/fit/model/shank_balls.h"
#include "flank/threads.h"

namespace flank::internal {
namespace {

using testing::all_parameters;
using testing::bare_stage;
using testing::cylinder;
using testing::hub;
using testing::only;
using testing::quad;
using testing::state_of;
using testing::upright_motion;

constexpr double kRadius = 5.0, kLength = 30.0;

class FitObstacleTerms : public ::testing::Test {
 protected:
  /// Samples a millimetre apart along the axis.
  static FitStage stage() {
    FitStage stage = bare_stage();
    stage.samples_s = 31;
    stage.clear_weight = 7.0;
    return stage;
  }
  FitModel model_of(const FitState& start, const FitStage& stage, const ObstacleField* obstacles,
                    const RadiusBounds& bounds = {}) const {
    const std::size_t count = start.motions.size();
    std::vector<const ObstacleField*> all(count, nullptr);
    all.front() = obstacles;
    return {std::vector<const Target*>(count, blade_.get()), start, all_parameters(start.tool), bounds, stage, all};
  }
  static double cost_of(const FitModel& model, FitState state) {
    model.locate_obstacles(state);
    return model.regulariser_cost(state);
  }
  /// The mean square over the samples of a cylinder upright at height z, by how much its balls enter the hub z = 0.
  static double expected(double z, double allowance) {
    double sum = 0.0;
    for (int s = 0; s <= 30; ++s) sum += std::pow(std::max(0.0, kRadius - allowance - (z + s)), 2);
    return 7.0 * sum / 31.0;
  }

  std::unique_ptr<Target> blade_ = testing::standing_blade(0.0);
};

TEST_F(FitObstacleTerms, CostIsTheMeanSquareOfTheDepthBeyondTheAllowance) {
  for (const double allowance : {0.0, 0.5}) {
    const ObstacleField obstacles(only(hub(true)), *blade_, 2.0, allowance);
    for (const double z : {7.0, 4.8, 3.0, 0.5, -2.0}) {
      const FitState state = state_of({upright_motion({.z = z})}, cylinder(kRadius));
      EXPECT_NEAR(cost_of(model_of(state, stage(), &obstacles), state), expected(z, allowance), 1e-9) << z;
    }
  }
}

TEST_F(FitObstacleTerms, OnlyMotionsThatHaveChecksPay) {
  const ObstacleField obstacles(only(hub(true)), *blade_, 2.0, 0.0);
  const FitState state = state_of({upright_motion({.z = 2.0}), upright_motion({.z = -9.0})}, cylinder(kRadius));
  EXPECT_NEAR(cost_of(model_of(state, stage(), &obstacles), state), 0.5 * expected(2.0, 0.0), 1e-9);
  EXPECT_NEAR(cost_of(model_of(state, stage(), nullptr), state), 0.0, 1e-18);
}

TEST_F(FitObstacleTerms, AFlankThatIsClearPullsNowhere) {
  const ObstacleField obstacles(only(hub(true)), *blade_, 2.0, 0.0);
  FitState state = state_of({upright_motion({.z = 5.5})}, cylinder(kRadius));
  const FitModel model = model_of(state, stage(), &obstacles);
  model.locate_obstacles(state);
  ArrowSystem system = model.make_system();
  model.assemble_regularisers(state, system);
  EXPECT_NEAR(system.gradient.norm(), 0.0, 1e-12);
}

TEST_F(FitObstacleTerms, ThePullIsUpAndTowardsALesserRadius) {
  const ObstacleField obstacles(only(hub(true)), *blade_, 2.0, 0.0);
  FitState state = state_of({upright_motion({.z = 3.0})}, cylinder(kRadius));
  const FitModel model = model_of(state, stage(), &obstacles);
  model.locate_obstacles(state);
  ArrowSystem system = model.make_system();
  model.assemble_regularisers(state, system);
  // Half the derivative of 7/31 (sum of (r - z - s)^2 over the depths 2 and 1): by r it is 7/31 (2 + 1), by z the
  // opposite, spread over the control points.
  EXPECT_NEAR(system.gradient[system.tool_offset()], 21.0 / 31.0, 1e-9);
  Vec3 tip = Vec3::Zero();
  for (int k = 0; k < 8; ++k) tip += system.gradient.segment<3>(6 * k);
  EXPECT_NEAR((tip - Vec3(0.0, 0.0, -21.0 / 31.0)).norm(), 0.0, 1e-9);
}

/// A hub and a wall beside the blade, so that balls enter either.
Obstacles hub_and_wall() {
  Obstacles obstacles = only(hub(true));
  obstacles.faces.push_back(
      {make_target({quad(Vec3(0, 12, -5), Vec3(60, 12, -5), Vec3(0, 8, 45), Vec3(60, 8, 45), "F3")}), true});
  return obstacles;
}

TEST_F(FitObstacleTerms, GradientAgreesWithDifferencesBesideTwoFaces) {
  const ObstacleField obstacles(hub_and_wall(), *blade_, 2.0, 0.0);
  FitState state = state_of({upright_motion({.z = 2.3})},
                            RadialFunction(ToolFamily::kBarrel, kLength, Eigen::Vector3d(120.0, 6.0, 14.0)));
  state.motions.front().direction.poles.colwise() += Vec3(0.03, 0.05, 0.0);
  const FitModel model = model_of(state, stage(), &obstacles);
  ASSERT_GT(cost_of(model, state), 0.1);
  testing::expect_regulariser_gradient(model, state, 1e-4);
}

/// With its upper end towards the hub, 10 mm above it.
RuledMotion hanging() {
  RuledMotion motion = upright_motion({.z = 40.0});
  motion.direction.poles.colwise() = -Vec3::UnitZ();
  return motion;
}

TEST_F(FitObstacleTerms, AShankPaysForWhatItEntersAsMuchAsBallsOfTheFlank) {
  const ObstacleField obstacles(only(hub(true)), *blade_, 2.0, 0.0);
  const FitState state = state_of({hanging()}, cylinder(kRadius));
  EXPECT_NEAR(cost_of(model_of(state, stage(), &obstacles), state), 0.0, 1e-18) << "without a shank nothing is entered";
  RadiusBounds bounds;
  bounds.shank_in_the_way = true;
  bounds.shank_length = 20.0;
  for (const double radius : {0.0, 3.0}) {
    bounds.shank_radius = radius;
    double sum = 0.0;
    for (const double s : shank_places(state.tool, bounds))
      sum += std::pow(std::max(0.0, kShankGrown * (radius > 0.0 ? radius : kRadius) - (40.0 - s)), 2);
    EXPECT_GT(sum, 100.0);
    EXPECT_NEAR(cost_of(model_of(state, stage(), &obstacles, bounds), state), 7.0 * sum / 31.0, 1e-9) << radius;
  }
}

TEST_F(FitObstacleTerms, GradientAgreesWithDifferencesWhereAShankEnters) {
  const ObstacleField obstacles(hub_and_wall(), *blade_, 2.0, 0.0);
  FitState state =
      state_of({hanging()}, RadialFunction(ToolFamily::kBarrel, kLength, Eigen::Vector3d(120.0, 6.0, 14.0)));
  state.motions.front().direction.poles.colwise() += Vec3(0.03, 0.05, 0.0);
  RadiusBounds bounds;
  bounds.shank_in_the_way = true;
  bounds.shank_length = 11.0;
  for (const double radius : {0.0, 4.0}) {
    bounds.shank_radius = radius;
    const FitModel model = model_of(state, stage(), &obstacles, bounds);
    ASSERT_GT(cost_of(model, state), 0.1) << radius;
    testing::expect_regulariser_gradient(model, state, 1e-4);
  }
}

TEST(ShankBalls, HoldTheCylinderOfTheShank) {
  RadiusBounds bounds;
  bounds.shank_in_the_way = true;
  bounds.shank_length = 17.0;
  for (const double radius : {0.0, 1.0, 7.0}) {
    bounds.shank_radius = radius;
    const RadialFunction flank = cylinder(kRadius);
    const std::vector<double> places = shank_places(flank, bounds);
    const double ball = shank_ball(flank, bounds), thick = radius > 0.0 ? radius : kRadius;
    ASSERT_FALSE(places.empty());
    EXPECT_DOUBLE_EQ(places.back(), kLength + 17.0);
    double below = kLength;
    for (const double s : places) {
      EXPECT_GE(std::sqrt(ball * ball - 0.25 * (s - below) * (s - below)), thick - 1e-12) << "half way to the next";
      below = s;
    }
  }
  EXPECT_TRUE(shank_places(cylinder(kRadius), {}).empty());
}

TEST_F(FitObstacleTerms, DistancesKeptFromAPlaceNearByCostTheSame) {
  const ObstacleField obstacles(hub_and_wall(), *blade_, 2.0, 0.0);
  FitState state = state_of({upright_motion({.z = 9.0})}, cylinder(kRadius));
  const FitModel model = model_of(state, stage(), &obstacles);
  model.locate_obstacles(state);
  // Down to the hub and up again in steps that are short and long against what is remembered.
  for (const double by : {-0.3, -0.3, -2.35, -1.5, -0.4, -2.0, 0.2, -3.0, 1.5, 6.0}) {
    state.motions.front().tip.poles.row(2).array() += by;
    FitState fresh = state;
    fresh.obstacles.clear();
    model.locate_obstacles(state);
    model.locate_obstacles(fresh);
    EXPECT_DOUBLE_EQ(model.regulariser_cost(state), model.regulariser_cost(fresh)) << by;
  }
}

TEST_F(FitObstacleTerms, EstimatedDistancesCostNearlyTheSame) {
  const ObstacleField obstacles(only(hub(true)), *blade_, 2.0, 0.0);
  FitStage rough = stage();
  rough.clear_estimated = true;
  const FitState state = state_of({upright_motion({.z = 1.0})}, cylinder(kRadius));
  const double exact = cost_of(model_of(state, stage(), &obstacles), state);
  EXPECT_NEAR(cost_of(model_of(state, rough, &obstacles), state), exact, 0.01 * exact);
}

TEST_F(FitObstacleTerms, ThreadsChangeNothing) {
  const ObstacleField obstacles(hub_and_wall(), *blade_, 2.0, 0.0);
  const FitState state = state_of({upright_motion({.z = 2.3})}, cylinder(kRadius));
  const FitModel model = model_of(state, stage(), &obstacles);
  set_thread_count(1);
  const double one = cost_of(model, state);
  set_thread_count(3);
  const double three = cost_of(model, state);
  set_thread_count(0);
  EXPECT_EQ(one, three);
}

}  // namespace
}  // namespace flank::internal
