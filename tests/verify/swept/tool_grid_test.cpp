// The grids of ToolDistance: lower bounds that hold, and starts that are near enough.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/verify/swept/tool_distance.h"
#include "sanitized.h"
#include "verify/brute_force.h"

namespace flank::internal::verify {
namespace {

constexpr int kPoints = kSanitized ? 300 : 4000;

std::vector<RadialFunction> tools() {
  Random random(1);
  return {RadialFunction(ToolFamily::kCylinder, 30.0, Eigen::VectorXd::Constant(1, 4.0)),
          RadialFunction(ToolFamily::kCone, 30.0, Eigen::Vector2d(2.0, 0.2)),
          RadialFunction(ToolFamily::kBarrel, 30.0, Eigen::Vector3d(85.0, 5.0, 12.0)),
          RadialFunction(ToolFamily::kHyperbolic, 30.0, Eigen::Vector3d(3.0, 0.02, 0.004)),
          brute::random_tool(random, 30.0).radial,
          RadialFunction::spline(24.0, (Eigen::VectorXd(8) << 6.0, 5.0, 3.0, 1.6, 1.6, 3.0, 5.2, 6.3).finished())};
}

double by_brute_force(const RadialFunction& radial, double z, double rho) {
  return brute::least(0.0, radial.axis_length(), 400, 1.0,
                      [&](double s) { return std::hypot(z - s, rho) - radial.at(s).r; });
}

/// Near the flank, near the axis, beyond the ends, and up to thousands of millimetres away.
Vec2 place(Random& random, double length, int i) {
  const double away = i % 4 == 0 ? 3000.0 : i % 4 == 1 ? 100.0 : 12.0;
  const double z = i % 4 == 3 ? random.uniform(0.0, length) : random.uniform(-away, length + away);
  return {z, i % 8 == 0 ? 1e-3 * random.uniform() : random.uniform(0.0, away)};
}

TEST(ToolGrid, EstimatesAreLowerBoundsEverywhere) {
  for (const RadialFunction& radial : tools()) {
    SCOPED_TRACE(family_name(radial.family()));
    const ToolDistance tool(radial);
    Random random(2);
    for (int i = 0; i < kPoints; ++i) {
      const Vec2 x = place(random, radial.axis_length(), i);
      ASSERT_LE(tool.estimate(x.x(), x.y()).bound, by_brute_force(radial, x.x(), x.y()) + 1e-9) << x.transpose();
    }
  }
}

TEST(ToolGrid, BoundsFallShortByLittleNearTheFlank) {
  for (const RadialFunction& radial : tools()) {
    SCOPED_TRACE(family_name(radial.family()));
    const ToolDistance tool(radial);
    Random random(3);
    double worst = 0.0;
    for (int i = 0; i < kPoints; ++i) {
      const double z = random.uniform(0.0, radial.axis_length());
      const double rho = radial.at(z).r + random.uniform(-0.3, 3.0);
      worst = std::max(worst, (tool.search(z, rho).g - tool.estimate(z, rho).bound) / std::max(1.0, rho));
    }
    EXPECT_LT(worst, 0.01);
  }
}

TEST(ToolGrid, NearestAndSearchAreTheGlobalMinimum) {
  for (const RadialFunction& radial : tools()) {
    SCOPED_TRACE(family_name(radial.family()));
    const ToolDistance tool(radial);
    Random random(4);
    for (int i = 0; i < kPoints; ++i) {
      const Vec2 x = place(random, radial.axis_length(), i);
      const double wanted = by_brute_force(radial, x.x(), x.y());
      for (const NearestSphere& found : {tool.nearest(x.x(), x.y()), tool.search(x.x(), x.y())}) {
        ASSERT_NEAR(found.g, wanted, 1e-9) << x.transpose();
        ASSERT_NEAR(found.g, std::hypot(x.x() - found.s, x.y()) - radial.at(found.s).r, 1e-9);
        ASSERT_TRUE(found.s >= 0.0 && found.s <= radial.axis_length());
      }
    }
  }
}

TEST(ToolGrid, TheEstimatedSphereIsAsNearAsItSaysWellBeforeTheFocalCurve) {
  // What SweptSearch makes of an estimate: the value at about the minimiser, less its bend over the error of s.
  for (const RadialFunction& radial : tools()) {
    SCOPED_TRACE(family_name(radial.family()));
    const ToolDistance tool(radial);
    Random random(5);
    int looked = 0;
    for (int i = 0; i < kPoints; ++i) {
      const double z = random.uniform(0.0, radial.axis_length()), rho = random.uniform(0.5, 10.0);
      const Estimate estimate = tool.estimate(z, rho);
      if (rho * tool.focal_curvature() > 0.3 || estimate.near_end) continue;
      ++looked;
      const NearestSphere exact = tool.search(z, rho);
      const double distance = std::hypot(z - estimate.s, rho);
      const double bend = 1.0 / distance + tool.radial().largest_bend();
      const double value = distance - radial.at(estimate.s).r;
      ASSERT_LE(value - bend * estimate.s_error * estimate.s_error, exact.g + 1e-9) << z << ' ' << rho;
      ASSERT_NEAR(estimate.s, exact.s, estimate.s_error + 1e-6) << z << ' ' << rho;
    }
    EXPECT_GT(looked, kPoints / 20);
  }
}

TEST(ToolGrid, FocalCurvatureIsThatOfTheConcaveMeridian) {
  // A concave arc of radius 40: spheres that touch it from outside are alone up to its centre.
  const ToolDistance waist(RadialFunction(ToolFamily::kBarrel, 20.0, Eigen::Vector3d(-40.0, 4.0, 10.0)));
  const RadialFunction arc(ToolFamily::kBarrel, 20.0, Eigen::Vector3d(-40.0, 4.0, 10.0));
  double most = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const RadialJet j = arc.at(20.0 * i / 1000);
    most = std::max(most, j.d2 / std::pow(1.0 - j.d1 * j.d1, 1.5));
  }
  EXPECT_NEAR(waist.focal_curvature(), most, 1e-9);
  EXPECT_NEAR(waist.focal_curvature(), 1.0 / 44.0, 1e-3);
  EXPECT_EQ(ToolDistance(RadialFunction(ToolFamily::kBarrel, 20.0, Eigen::Vector3d(60.0, 4.0, 10.0))).focal_curvature(),
            0.0);
}

}  // namespace
}  // namespace flank::internal::verify
