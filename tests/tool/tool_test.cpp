// Meridian points from radial functions.
#include "flank/tool.h"

#include <gtest/gtest.h>

#include <cmath>

namespace flank::internal {
namespace {

const RadialFunction& spline() {
  static const RadialFunction f =
      RadialFunction::spline(20.0, (Eigen::VectorXd(8) << 3.0, 3.3, 3.9, 4.2, 4.4, 4.1, 4.6, 5.0).finished());
  return f;
}

TEST(Tool, MeridianOfACylinderIsALineAtItsRadius) {
  const RadialFunction f(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 4.0));
  const std::vector<Vec2> profile = meridian(f, 5);
  ASSERT_EQ(profile.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(profile[static_cast<std::size_t>(i)], Vec2(5.0 * i, 4.0));
}

TEST(Tool, MeridianPolylineTakesEqualStepsFromTipToHolder) {
  const std::vector<Vec2> profile = meridian(spline(), 11);
  ASSERT_EQ(profile.size(), 11u);
  for (int i = 0; i <= 10; ++i) EXPECT_EQ(profile[static_cast<std::size_t>(i)], meridian_point(spline(), 2.0 * i));
  ASSERT_EQ(meridian(spline(), 1).size(), 1u);
  EXPECT_EQ(meridian(spline(), 1)[0], meridian_point(spline(), 0.0));
  EXPECT_TRUE(meridian(spline(), 0).empty());
}

/// The profile's tangent is across the radius of the sphere that touches there.
TEST(Tool, TheSphereOfSTouchesTheMeridianAtItsPoint) {
  constexpr double h = 1e-5;
  for (double s = 0.5; s < 20.0; s += 0.7) {
    const Vec2 tangent = (meridian_point(spline(), s + h) - meridian_point(spline(), s - h)) / (2.0 * h);
    const Vec2 radius = meridian_point(spline(), s) - Vec2(s, 0.0);
    EXPECT_NEAR(radius.norm(), spline().at(s).r, 1e-13);
    EXPECT_NEAR(tangent.normalized().dot(radius.normalized()), 0.0, 1e-8) << s;
    EXPECT_GT(radius.y(), 0.0);
  }
}

TEST(Tool, OnAConeTheMeridianPointLiesTowardsTheThinEnd) {
  const RadialFunction cone(ToolFamily::kCone, 20.0, Eigen::Vector2d(4.0, 0.3));
  const Vec2 p = meridian_point(cone, 5.0);
  const double r = 4.0 + 5.0 * std::sin(0.3);
  EXPECT_NEAR(p.x(), 5.0 - r * std::sin(0.3), 1e-14);
  EXPECT_NEAR(p.y(), r * std::cos(0.3), 1e-14);
}

TEST(Tool, SlopesOfOneAndMoreHaveNoMeridian) {
  const RadialFunction steep(ToolFamily::kHyperbolic, 20.0, Eigen::Vector3d(30.0, 1.5, 0.0));
  EXPECT_TRUE(std::isnan(meridian_point(steep, 10.0).y()));
}

}  // namespace
}  // namespace flank::internal
