// The solid tool: radius at a height, and the areas of its rings.
#include "flank/trochoid/stock/tool_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/tool.h"

namespace flank::internal {
namespace {

TEST(ToolProfile, IsTheMeridian) {
  const RadialFunction radial(ToolFamily::kBarrel, 30.0, Eigen::Vector3d(60.0, 6.0, 18.0));
  const ToolProfile profile(radial);
  for (int k = 0; k <= 40; ++k) {
    const Vec2 p = meridian_point(radial, 30.0 * k / 40.0);
    ToolProfile::Place place;
    ASSERT_TRUE(profile.at(p.x(), place)) << k;
    EXPECT_NEAR(place.radius, p.y(), 1e-9) << k;
    const double r1 = radial.at(30.0 * k / 40.0).d1;
    EXPECT_NEAR(place.slope, r1 / std::sqrt(1.0 - r1 * r1), 1e-6) << k;
  }
}

TEST(ToolProfile, EndsAreRound) {
  const RadialFunction radial(ToolFamily::kCylinder, 10.0, Eigen::VectorXd::Constant(1, 4.0));
  const ToolProfile profile(radial);
  ToolProfile::Place place;
  ASSERT_TRUE(profile.at(-2.0, place));
  EXPECT_NEAR(place.radius, std::sqrt(12.0), 1e-12);
  ASSERT_TRUE(profile.at(13.0, place));
  EXPECT_NEAR(place.radius, std::sqrt(7.0), 1e-12);
  EXPECT_FALSE(profile.at(-4.1, place));
  EXPECT_FALSE(profile.at(14.1, place));
}

TEST(ToolRings, AreasAddUpToTheToolsSurface) {
  const double pi = std::numbers::pi;
  const RadialFunction radial(ToolFamily::kCone, 20.0, Eigen::Vector2d(3.0, 0.1));
  double area = 0.0;
  for (const ToolRing& ring : tool_rings(radial, 9, 33)) area += 2.0 * pi * ring.area;
  // Envelope of the spheres of a cone, and what is left of the end spheres.
  const double slope = std::sin(0.1), low = 3.0, high = 3.0 + 20.0 * slope;
  const double flank = 2.0 * pi * (1.0 - slope * slope) * 20.0 * 0.5 * (low + high);
  const double caps = 2.0 * pi * (low * low * (1.0 - slope) + high * high * (1.0 + slope));
  EXPECT_NEAR(area / (flank + caps), 1.0, 1e-4);
}

}  // namespace
}  // namespace flank::internal
