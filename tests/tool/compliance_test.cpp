#include "flank/tool/compliance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

RadialFunction cylinder(double radius, double length) {
  return {ToolFamily::kCylinder, length, Eigen::VectorXd::Constant(1, radius)};
}

RadialFunction cone(double radius, double angle, double length) {
  return {ToolFamily::kCone, length, Eigen::Vector2d(radius, angle)};
}

TEST(Compliance, OfACylinderIsThatOfTheText) {
  EXPECT_NEAR(compliance(cylinder(2.0, 30.0)), 30.0 * 30.0 * 30.0 / (3.0 * 16.0), 1e-9);
  EXPECT_NEAR(slenderness(30.0, compliance(cylinder(2.0, 30.0))), 7.5, 1e-12);
}

TEST(Compliance, OfAConeHasItsClosedForm) {
  // With r = a + b s the integral of s^2 / r^4 is s^3 / (3 a r^3).
  const double a = 1.5, b = std::sin(0.1), length = 40.0, top = a + b * length;
  EXPECT_NEAR(compliance(cone(a, 0.1, length)), std::pow(length, 3) / (3.0 * a * std::pow(top, 3)), 1e-10 * 40.0);
}

TEST(Compliance, InfluenceOfACylinderIsThatOfTheText) {
  const double radius = 3.0, length = 40.0, inertia = std::numbers::pi * std::pow(radius, 4) / 4.0;
  const Tool tool{cylinder(radius, length), "end mill", {}, {}};
  EXPECT_EQ(clamped_at(tool), length);
  for (const double force : {0.0, 7.0, 25.0, 39.0})
    for (const double moved : {0.0, 11.0, 25.0, 33.0}) {
      // A cantilever: a from the clamp to the force, x to where it is looked at.
      const double a = length - std::min(force, moved), x = length - std::max(force, moved);
      const double closed = x * x * (3.0 * a - x) / (6.0 * kCarbideModulus * inertia);
      EXPECT_NEAR(influence_mm(tool, force, moved), closed, 1e-9 * closed) << force << " " << moved;
      EXPECT_NEAR(influence_mm(tool, moved, force), closed, 1e-9 * closed);
    }
}

TEST(Compliance, InfluenceOnItselfAtTheTipIsTheStiffness) {
  const Tool tool{cone(2.0, 0.08, 30.0),
                  "cone",
                  {{30.0, 5.0}, {45.0, 5.0}, {50.0, 6.0}, {70.0, 6.0}},
                  {{62.0, 20.0}, {90.0, 20.0}}};
  EXPECT_EQ(clamped_at(tool), 62.0);
  EXPECT_NEAR(1e3 * kStiffnessForce * influence_mm(tool, 0.0, 0.0), stiffness(tool).deflection_um,
              1e-6 * stiffness(tool).deflection_um);
  EXPECT_EQ(influence_mm(tool, 65.0, 10.0), 0.0);
}

TEST(Compliance, SlendernessDoesNotChangeWithSize) {
  EXPECT_NEAR(slenderness(40.0, compliance(cone(1.5, 0.1, 40.0))), slenderness(80.0, compliance(cone(3.0, 0.1, 80.0))),
              1e-12);
}

TEST(Compliance, ANeckCountsMoreTheFartherItIsFromTheTip) {
  const auto necked = [](int k) {
    Eigen::VectorXd r = Eigen::VectorXd::Constant(12, 4.0);
    r[k] = 1.5;
    return compliance(RadialFunction::spline(50.0, r));
  };
  EXPECT_GT(necked(9), necked(6));
  EXPECT_GT(necked(6), necked(3));
  EXPECT_GT(necked(3), compliance(cylinder(4.0, 50.0)));
}

TEST(Compliance, GradientIsThatOfDifferences) {
  const Eigen::VectorXd r = (Eigen::VectorXd(8) << 3.0, 3.4, 2.7, 2.2, 2.9, 3.3, 4.1, 4.0).finished();
  const std::vector<RadialFunction> tools = {RadialFunction::spline(37.0, r),
                                             cone(1.5, 0.1, 40.0),
                                             {ToolFamily::kBarrel, 30.0, Eigen::Vector3d(85.0, 5.0, 12.0)}};
  for (const RadialFunction& tool : tools) {
    Eigen::VectorXd gradient;
    EXPECT_EQ(compliance(tool, gradient), compliance(tool));
    for (int k = 0; k < tool.parameter_count(); ++k) {
      const double h = 1e-5 * std::max(1.0, std::abs(tool.parameters()[k]));
      Eigen::VectorXd up = tool.parameters(), down = tool.parameters();
      up[k] += h, down[k] -= h;
      const double slope = (compliance(tool.with_parameters(up)) - compliance(tool.with_parameters(down))) / (2.0 * h);
      EXPECT_NEAR(gradient[k], slope, 1e-6 * gradient.norm()) << family_name(tool.family()) << " parameter " << k;
    }
  }
}

TEST(Compliance, OfNoToolIsInfinite) {
  Eigen::VectorXd r = Eigen::VectorXd::Constant(8, 2.0);
  r[4] = -3.0;
  EXPECT_TRUE(std::isinf(compliance(RadialFunction::spline(30.0, r))));
}

TEST(Stiffness, AShankOfTheSameRadiusIsALongerTool) {
  Tool tool;
  tool.radial = cylinder(4.0, 30.0);
  EXPECT_NEAR(stiffness(tool).slenderness, 3.75, 1e-12);
  tool.shank = {{30.0, 4.0}, {70.0, 4.0}};
  EXPECT_NEAR(stiffness(tool).slenderness, 8.75, 1e-9);
  EXPECT_NEAR(stiffness(tool).length_mm, 70.0, 1e-12);
  EXPECT_NEAR(stiffness(tool).equivalent_diameter_mm, 8.0, 1e-9);
}

TEST(Stiffness, AHolderClampsTheShankWhereItBegins) {
  Tool tool;
  tool.radial = cylinder(4.0, 30.0);
  tool.shank = {{30.0, 4.0}, {70.0, 4.0}};
  tool.holder = {{50.0, 10.0}, {90.0, 10.0}};
  EXPECT_NEAR(stiffness(tool).slenderness, 6.25, 1e-9);
}

TEST(Stiffness, DeflectionIsThatOfACantilever) {
  // F L^3 / (3 E I), I = pi d^4 / 64: 100 N on a carbide cylinder of 10 mm, 60 mm long.
  Tool tool;
  tool.radial = cylinder(5.0, 60.0);
  const double inertia = std::numbers::pi * std::pow(10.0, 4) / 64.0;
  EXPECT_NEAR(stiffness(tool).deflection_um, 1e3 * 100.0 * std::pow(60.0, 3) / (3.0 * 6e5 * inertia), 1e-8);
}

}  // namespace
}  // namespace flank::internal
