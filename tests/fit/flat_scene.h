/// Small scenes whose fits have closed forms: a flat or twisted blade and a tool that stands upright before it; and the
/// derivative of a cost by every unknown.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "flank/fit/stages.h"
#include "obstacle/obstacle_scene.h"

namespace flank::internal::testing {

/// The blade of standing_blade(0), 60 mm along x and 40 mm high, with its corner at x = 60, z = 40 moved by `lift`
/// along y: a patch of a hyperbolic paraboloid.
inline std::unique_ptr<Target> twisted_blade(double lift) {
  return make_target({quad(Vec3(60, 0, 0), Vec3(0, 0, 0), Vec3(60, lift, 40), Vec3(0, 0, 40), "F1")});
}

/// Poles of a clamped cubic rail that runs at constant speed from a to b.
inline BSplineCurve3 straight_rail(const Vec3& a, const Vec3& b, int count) {
  BSplineCurve3 rail;
  rail.knots = uniform_knots(3, count);
  rail.poles.resize(3, count);
  for (int k = 0; k < count; ++k) {
    const std::size_t first = static_cast<std::size_t>(k) + 1;
    const double t = (rail.knots[first] + rail.knots[first + 1] + rail.knots[first + 2]) / 3.0;
    rail.poles.col(k) = a + t * (b - a);
  }
  return rail;
}

/// An axis along z at constant y that travels along x; its tip at height z.
struct Upright {
  double y = 5.0, z = 2.0, x_first = 4.0, x_last = 56.0, length = 30.0;
  int control_points = 8;
};
inline RuledMotion upright_motion(const Upright& at = {}) {
  RuledMotion motion;
  motion.axis_length = at.length;
  motion.tip = straight_rail(Vec3(at.x_first, at.y, at.z), Vec3(at.x_last, at.y, at.z), at.control_points);
  motion.direction = straight_rail(Vec3::UnitZ(), Vec3::UnitZ(), at.control_points);
  return motion;
}

inline RadialFunction cylinder(double radius, double length = 30.0) {
  return RadialFunction(ToolFamily::kCylinder, length, Eigen::VectorXd::Constant(1, radius));
}

inline std::vector<int> all_parameters(const RadialFunction& tool) {
  std::vector<int> all(static_cast<std::size_t>(tool.parameter_count()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

inline FitState state_of(std::vector<RuledMotion> motions, RadialFunction tool) {
  FitState state;
  state.motions = std::move(motions);
  state.tool = std::move(tool);
  return state;
}

/// A stage without any term but the samples: each test switches on what it is about.
inline FitStage bare_stage(int control_points = 8) {
  FitStage stage;
  stage.samples_t = 21;
  stage.samples_s = 11;
  stage.control_points = control_points;
  stage.fairness = stage.tool_fairness = stage.transversal_anchor = stage.axial_pin = stage.radius_pin = 0.0;
  return stage;
}

/// The gradient of the terms that do not look at the target against central differences, unknown by unknown, to
/// `accuracy` of the gradient's length.
inline void expect_regulariser_gradient(const FitModel& model, const FitState& state, double accuracy) {
  FitState at = state;
  model.locate_obstacles(at);
  ArrowSystem system = model.make_system();
  model.assemble_regularisers(at, system);
  const double h = 1e-4;
  Eigen::VectorXd numeric(system.size());
  for (int k = 0; k < system.size(); ++k) {
    FitState plus = model.moved(at, h * Eigen::VectorXd::Unit(system.size(), k));
    FitState minus = model.moved(at, -h * Eigen::VectorXd::Unit(system.size(), k));
    model.locate_obstacles(plus);
    model.locate_obstacles(minus);
    numeric[k] = (model.regulariser_cost(plus) - model.regulariser_cost(minus)) / (4.0 * h);
  }
  ASSERT_GT(numeric.norm(), 0.0);
  EXPECT_LT((system.gradient - numeric).norm(), accuracy * numeric.norm())
      << "assembled " << system.gradient.transpose() << "\nnumeric " << numeric.transpose();
}

}  // namespace flank::internal::testing
