// Contacts of lines with orbits against dense search, and the derivatives against differences.
#include "flank/fit/orbit/orbit_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sanitized.h"
#include "seed/screw_sheet.h"

namespace flank::internal {
namespace {

constexpr double kLength = 24.0;

OrbitTool free_tool() {
  OrbitTool tool;
  for (int k = 0; k < 8; ++k) tool.free_parameters.push_back(k);
  tool.bounds.smallest = 2.0;
  tool.bounds.largest = 5.2;  // the tool below is thicker somewhere: the bound pulls
  tool.bounds.slenderest = 2.4;
  tool.axis_length_mm = kLength;
  tool.reach_mm = 2.0 * kLength;
  return tool;
}

std::vector<OrbitPlace> places() {
  std::vector<OrbitPlace> places;
  for (int k = 0; k < 24; ++k) {
    const double u = (k + 0.5) / 24.0;
    places.push_back({testing::on_screw(u, 0.2 * u + 0.4), 1.0 / 24.0, k % 5 != 0});
  }
  return places;
}

/// Two lines, a few tenths of a millimetre off what they are to touch.
OrbitState state() {
  OrbitState state;
  const Vec3 low = testing::on_screw(0.05, 0.4), high = testing::on_screw(0.95, 0.6);
  const Vec3 u = (high - low).normalized(), away = u.cross(testing::screw_motion().velocity(low)).normalized();
  state.lines.push_back({low + 4.7 * away - 3.0 * u, u});
  state.lines.push_back({low + 5.4 * away + 6.0 * u, (u + 0.1 * away).normalized()});
  Eigen::VectorXd r(8);
  r << 3.8, 4.2, 4.6, 5.0, 5.3, 5.2, 4.8, 4.5;
  state.tool = RadialFunction::spline(kLength, r);
  return state;
}

TEST(OrbitModel, ContactsAreTheNearestOfADenseSearch) {
  const OrbitModel model(testing::screw_motion(), places(), free_tool(), nullptr, {0.0});
  OrbitState at = state();
  model.locate(at);
  const SelfMotion motion = testing::screw_motion();
  for (std::size_t k = 0; k < model.places().size(); k += kSanitized ? 10 : 1) {
    double least = 1e300;
    for (const Pose& line : at.lines)
      for (int m = 0; m <= 600; ++m) {
        const Vec3 p = motion.moved(model.places()[k].point, -0.6 + 0.002 * m);
        for (int j = 0; j <= 120; ++j) {
          const double s = kLength * j / 120.0;
          least = std::min(least, (line.at(s) - p).norm() - at.tool.at(s).r);
        }
      }
    EXPECT_NEAR(at.contacts[k].f, least, 2e-3) << k;
    EXPECT_LE(at.contacts[k].f, least + 1e-6) << k;
  }
}

TEST(OrbitModel, GradientIsThatOfTheCost) {
  const OrbitModel model(testing::screw_motion(), places(), free_tool(), nullptr, {0.0});
  OrbitState at = state();
  model.locate(at);
  for (const OrbitPass& pass : {OrbitPass{}, OrbitPass{2.0, 0.05, 4.0, 1}}) {
    const std::vector<double> weights = model.weights(at, pass);
    const OrbitModel::System system = model.assemble(at, pass, weights);
    const auto cost_at = [&](const Eigen::VectorXd& step) {
      OrbitState moved = model.moved(at, step);
      model.locate(moved);
      return model.cost(moved, pass, weights);
    };
    for (Eigen::Index j = 0; j < system.gradient.size(); ++j) {
      constexpr double kStep = 1e-4;
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(system.gradient.size(), j);
      const double slope = (cost_at(step) - cost_at(-step)) / (4.0 * kStep);
      EXPECT_NEAR(system.gradient[j], slope, 1e-4 * system.gradient.cwiseAbs().maxCoeff()) << j;
    }
  }
}

TEST(OrbitModel, APassLowersTheCost) {
  const OrbitModel model(testing::screw_motion(), places(), free_tool(), nullptr, {0.0});
  OrbitState before = state();
  model.locate(before);
  const OrbitPass pass{2.0, 0.0, 1.0, 20};
  const OrbitState after = minimised(model, before, pass);
  EXPECT_LT(model.cost(after, pass, model.weights(after, pass)),
            0.5 * model.cost(before, pass, model.weights(before, pass)));
}

}  // namespace
}  // namespace flank::internal
