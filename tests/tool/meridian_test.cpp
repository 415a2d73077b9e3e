#include "flank/tool/meridian.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "flank/error.h"
#include "flank/tool.h"

namespace flank::internal {
namespace {

constexpr double kLength = 20.0;

Eigen::VectorXd values(std::initializer_list<double> list) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(list.size()));
  int i = 0;
  for (const double x : list) v[i++] = x;
  return v;
}

TEST(Meridian, OfABarrelIsACircleArc) {
  const RadialFunction f(ToolFamily::kBarrel, kLength, values({85.0, 5.0, 8.0}));
  for (const Vec2& p : meridian(f, 101)) EXPECT_NEAR((p - Vec2(8.0, -80.0)).norm(), 85.0, 1e-12);
}

TEST(Meridian, OfAConcaveBarrelIsACircleArcFromOutside) {
  const RadialFunction f(ToolFamily::kBarrel, kLength, values({-60.0, 5.0, 8.0}));
  for (const Vec2& p : meridian(f, 101)) EXPECT_NEAR((p - Vec2(8.0, 65.0)).norm(), 60.0, 1e-12);
}

TEST(Meridian, OfATaperedBarrelIsACircleArcWithItsSlopeAtMidLength) {
  const double angle = 0.2;
  const RadialFunction f(ToolFamily::kTaperedBarrel, kLength, values({250.0, 5.0, angle}));
  const Vec2 normal(-std::sin(angle), std::cos(angle)), centre = Vec2(10.0, 0.0) - 245.0 * normal;
  for (const Vec2& p : meridian(f, 101)) EXPECT_NEAR((p - centre).norm(), 250.0, 1e-11);
  const Vec2 chord = meridian_point(f, 10.0 + 1e-5) - meridian_point(f, 10.0 - 1e-5);
  EXPECT_NEAR(std::atan2(chord.y(), chord.x()), angle, 1e-9);
}

TEST(Meridian, OfAConeIsALineOfItsAngle) {
  const RadialFunction f(ToolFamily::kCone, kLength, values({2.0, 0.05}));
  const Vec2 a = meridian_point(f, 0.0), b = meridian_point(f, kLength);
  EXPECT_NEAR(std::atan2(b.y() - a.y(), b.x() - a.x()), 0.05, 1e-15);
  for (const Vec2& p : meridian(f, 33)) EXPECT_NEAR((p - a).dot(Vec2(-std::sin(0.05), std::cos(0.05))), 0.0, 1e-14);
}

TEST(Meridian, EveryInscribedSphereTouchesItAndNoneCrossesIt) {
  const RadialFunction f = RadialFunction::spline(kLength, values({3.0, 3.3, 3.9, 4.2, 4.4, 4.1, 4.6, 5.0}));
  ASSERT_TRUE(check_legitimacy(f).legitimate);
  const std::vector<Vec2> profile = meridian(f, 201);
  for (int i = 0; i <= 200; ++i) {
    const double s = kLength * i / 200;
    EXPECT_NEAR((profile[static_cast<std::size_t>(i)] - Vec2(s, 0.0)).norm(), f.at(s).r, 1e-13);
    for (const Vec2& p : profile) EXPECT_GE((p - Vec2(s, 0.0)).norm(), f.at(s).r - 1e-12);
  }
}

TEST(RadialFromMeridian, GivesBackTheSplineItCameFrom) {
  const RadialFunction truth = RadialFunction::spline(kLength, values({3.0, 3.3, 3.9, 4.2, 4.4, 4.1, 4.6, 5.0}));
  const std::vector<Vec2> profile = meridian(truth, 201);
  const RadialFunction found = radial_from_meridian(profile, kLength, 8);
  EXPECT_LT((found.parameters() - truth.parameters()).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(RadialFromMeridian, FindsTheLengthOfACircleArcByItself) {
  const RadialFunction truth(ToolFamily::kBarrel, kLength, values({60.0, 5.0, 12.0}));
  std::vector<Vec2> profile = meridian(truth, 101);
  for (Vec2& p : profile) p.x() += 3.7;  // where the file has its origin does not matter
  const RadialFunction found = radial_from_meridian(profile, std::nullopt, 24);
  EXPECT_NEAR(found.axis_length(), kLength, 1e-3);
  double largest = 0.0;
  const double start = 3.7 + kLength - found.axis_length();
  EXPECT_NEAR(start, 3.7, 1e-3);
  for (const Vec2& p : meridian(found, 501)) {
    // The arc's centre in the found frame: its s = 0 is the first normal's axis point, at s = 0 of the truth up to the
    // start's error.
    largest = std::max(largest, std::abs((p - Vec2(12.0, -55.0)).norm() - 60.0));
  }
  EXPECT_LT(largest, 1e-4);
}

TEST(RadialFromMeridian, RefusesProfilesThatNoSpheresFillAndNamesThePoint) {
  const auto message = [](const std::vector<Vec2>& profile, std::optional<double> length) -> std::string {
    try {
      (void)radial_from_meridian(profile, length, 8);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message({{0, 1}, {1, 1}, {2, 1}}, std::nullopt).find("at least 4"), std::string::npos);
  EXPECT_NE(message({{0, 1}, {1, 1}, {2, -1}, {3, 1}}, std::nullopt).find("point 3"), std::string::npos);
  EXPECT_NE(message({{0, 1}, {1, 1}, {1, 2}, {3, 1}}, std::nullopt).find("point 3"), std::string::npos);
  EXPECT_NE(message({{0, 1}, {1, 1}, {NAN, 1}, {3, 1}}, std::nullopt).find("finite"), std::string::npos);
  std::vector<Vec2> notch;  // concave, sharper than its distance from the axis
  for (int i = 0; i <= 40; ++i) notch.emplace_back(0.1 * i, 5.0 - std::sqrt(25.0 / 4.0 - std::pow(0.1 * i - 2.0, 2)));
  EXPECT_EQ(message(notch, std::nullopt),
            "");            // waist 2.5, arc 2.5 is fine: spheres from inside always fit a concave arc
  std::vector<Vec2> bulge;  // the outer side of a torus
  for (int i = 0; i <= 40; ++i) bulge.emplace_back(0.1 * i, 3.0 + std::sqrt(9.0 - std::pow(0.1 * i - 2.0, 2)));
  EXPECT_NE(message(bulge, std::nullopt).find("bulges too sharply"), std::string::npos);
  const std::vector<Vec2> line = {{0, 2}, {1, 2}, {2, 2}, {3, 2}, {4, 2}};
  EXPECT_NE(message(line, 10.0).find("not over the axis length"), std::string::npos);
  EXPECT_EQ(message(line, 4.0), "");
}

}  // namespace
}  // namespace flank::internal
