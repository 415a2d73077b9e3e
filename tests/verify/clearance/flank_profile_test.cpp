#include "flank/verify/clearance/flank_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/base/random.h"
#include "flank/tool.h"

namespace flank::internal::verify {
namespace {

std::vector<RadialFunction> tools() {
  return {RadialFunction(ToolFamily::kBarrel, 30.0, Eigen::Vector3d(85.0, 5.0, 12.0)),
          RadialFunction(ToolFamily::kBarrel, 16.0, Eigen::Vector3d(12.0, 6.0, 8.0)),
          RadialFunction(ToolFamily::kHyperbolic, 30.0, Eigen::Vector3d(3.0, 0.02, 0.004)),
          RadialFunction::spline(24.0, (Eigen::VectorXd(8) << 6.0, 5.0, 3.0, 1.6, 1.6, 3.0, 5.2, 6.3).finished())};
}

double off_polyline(const std::vector<Vec2>& line, const Vec2& x) {
  double least = 1e300;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 d = line[i + 1] - line[i];
    const double t = d.squaredNorm() > 0.0 ? std::clamp((x - line[i]).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
    least = std::min(least, (x - line[i] - t * d).norm());
  }
  return least;
}

TEST(FlankProfile, PointsLieOnTheMeridianAndNothingIsFarFromThem) {
  for (const RadialFunction& radial : tools()) {
    SCOPED_TRACE(family_name(radial.family()));
    const std::vector<Vec2> profile = flank_profile(radial), exact = meridian(radial, 20001);
    for (std::size_t k = 0; k + 1 < profile.size(); ++k) ASSERT_LE(profile[k].x(), profile[k + 1].x());
    for (const Vec2& p : profile) ASSERT_LT(off_polyline(exact, p), 1e-5);
    double worst = 0.0;
    for (std::size_t i = 0; i < exact.size(); i += 10) worst = std::max(worst, off_polyline(profile, exact[i]));
    EXPECT_LE(worst, kFlankProfileErrorMm);
    EXPECT_EQ(profile.front(), meridian_point(radial, 0.0));
    EXPECT_EQ(profile.back(), meridian_point(radial, radial.axis_length()));
    EXPECT_LT(profile.size(), 600u);
  }
}

TEST(FlankProfile, AnSWhoseMiddleLiesOnItsChordIsCutAllTheSame) {
  // r = 40 + b (s - s0)^3 with s0 in the middle of one of the first pieces.
  std::vector<Vec2> samples;
  for (int i = 0; i <= 20; ++i) samples.emplace_back(20.0 * i, 40.0 + 2e-6 * std::pow(20.0 * i - 212.5, 3));
  const RadialFunction radial = RadialFunction::spline_through(400.0, samples, 4);
  const std::vector<Vec2> profile = flank_profile(radial), exact = meridian(radial, 4001);
  double worst = 0.0;
  for (const Vec2& p : exact) worst = std::max(worst, off_polyline(profile, p));
  EXPECT_LE(worst, kFlankProfileErrorMm);
}

TEST(FlankProfile, StraightToolsNeedNoMorePointsThanTheFirst) {
  const RadialFunction cone(ToolFamily::kCone, 30.0, Eigen::Vector2d(2.0, 0.1));
  EXPECT_EQ(flank_profile(cone).size(), 17u);
  EXPECT_EQ(convex_bodies(flank_profile(cone)).size(), 1u);
}

/// The bodies together are the union of the spheres: the same signed distance outside, up to the profile's error.
TEST(FlankBodies, AreTheUnionOfTheSpheres) {
  for (const RadialFunction& radial : tools()) {
    SCOPED_TRACE(family_name(radial.family()));
    const std::vector<Revolved> bodies = flank_bodies(radial);
    const double length = radial.axis_length();
    Random random(3);
    int outside = 0, within = 0;
    for (int i = 0; i < 400; ++i) {
      const double z = random.uniform(-10.0, length + 10.0), rho = random.uniform(0.0, 15.0);
      double spheres = 1e300, found = 1e300;
      for (int k = 0; k <= 4000; ++k) {
        const double s = length * k / 4000;
        spheres = std::min(spheres, std::hypot(z - s, rho) - radial.at(s).r);
      }
      for (const Revolved& body : bodies) found = std::min(found, body.value(z, rho));
      if (spheres > kFlankProfileErrorMm) {
        ++outside;
        ASSERT_NEAR(found, spheres, kFlankProfileErrorMm + 1e-4) << z << ' ' << rho;
      } else if (spheres < -2e-3) {
        ++within;
        ASSERT_LT(found, 0.0) << z << ' ' << rho;
        ASSERT_GE(found, spheres - 1e-3) << "no convex part is deeper than the whole";
      }
    }
    EXPECT_GT(outside, 50);
    EXPECT_GT(within, 50);
  }
}

TEST(FlankProfile, ARadialFunctionThatIsNoToolStillMakesAProfile) {
  // Negative radii, and radii that are no numbers: bodies without sense, but bodies.
  for (const RadialFunction& radial :
       {RadialFunction(ToolFamily::kCone, 30.0, Eigen::Vector2d(2.0, -0.3)),
        RadialFunction(ToolFamily::kPower, 20.0, Eigen::Vector4d(5.0, -1.0, 1.0, 2.0))}) {
    for (const Vec2& p : flank_profile(radial)) {
      EXPECT_GE(p.y(), 0.0);
      EXPECT_TRUE(p.allFinite()) << p.transpose();
    }
  }
}

}  // namespace
}  // namespace flank::internal::verify
