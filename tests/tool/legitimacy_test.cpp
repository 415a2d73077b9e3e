#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "flank/tool.h"

namespace flank::internal {
namespace {

RadialFunction family(ToolFamily which, double length, std::initializer_list<double> list) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(list.size()));
  int i = 0;
  for (const double x : list) v[i++] = x;
  return {which, length, v};
}

bool says(const Legitimacy& l, const std::string& part) { return l.reason.find(part) != std::string::npos; }

TEST(Legitimacy, EveryFamilyHasLegitimateTools) {
  EXPECT_TRUE(check_legitimacy(family(ToolFamily::kCylinder, 20, {4})).legitimate);
  EXPECT_TRUE(check_legitimacy(family(ToolFamily::kCone, 20, {2, 0.05})).legitimate);
  EXPECT_TRUE(check_legitimacy(family(ToolFamily::kBarrel, 20, {85, 5, 8})).legitimate);
  EXPECT_TRUE(check_legitimacy(family(ToolFamily::kBarrel, 20, {-60, 5, 8})).legitimate);
  EXPECT_TRUE(check_legitimacy(family(ToolFamily::kLens, 20, {5, 4})).legitimate);
  EXPECT_TRUE(check_legitimacy(family(ToolFamily::kTaperedBarrel, 20, {250, 5, 0.2})).legitimate);
  EXPECT_TRUE(check_legitimacy(family(ToolFamily::kHyperbolic, 20, {3, 0, 0.004})).legitimate);
  EXPECT_TRUE(check_legitimacy(family(ToolFamily::kPower, 20, {8, 1.5, 1.2, 2.3})).legitimate);
}

/// A torus of centre circle 3 and tube 2 (B, Example 1): r = 2 + sqrt(9 + x^2) grows, stays positive, |r'| < 1, and is
/// no tool.
TEST(Legitimacy, OuterTorusIsRefusedForItsThirdCondition) {
  const Legitimacy l = check_legitimacy(family(ToolFamily::kBarrel, 20, {2, 5, 0}));
  EXPECT_FALSE(l.legitimate);
  EXPECT_TRUE(says(l, "1 - r'^2 - r r''")) << l.reason;
  EXPECT_DOUBLE_EQ(l.s, 0.0);
  // (1 + k radius) / W^3 at x = 0 with k = 1 / (2 - 5): -2/3.
  EXPECT_TRUE(says(l, "-0.666667")) << l.reason;
}

TEST(Legitimacy, SteepSlopeIsNamedWhereItFirstOccurs) {
  // r' = 0.1 (s - 5) reaches 1 at s = 15; r r'' < 0 keeps the third condition until there... it is bend < 0 that
  // decides.
  const Legitimacy l = check_legitimacy(family(ToolFamily::kHyperbolic, 20, {30, -0.5, -0.05}));
  EXPECT_FALSE(l.legitimate);
  EXPECT_NEAR(l.s, 15.0, 1e-9);  // r' = -0.5 - 0.1 (s - 10) = -1
  EXPECT_TRUE(says(l, "r' = -1")) << l.reason;
  EXPECT_TRUE(says(l, "|r'| < 1")) << l.reason;
}

TEST(Legitimacy, NegativeRadiusIsNamedWhereItFirstOccurs) {
  const Legitimacy l = check_legitimacy(family(ToolFamily::kCone, 20, {1, -0.1}));
  EXPECT_FALSE(l.legitimate);
  EXPECT_NEAR(l.s, 1.0 / std::sin(0.1), 1e-9);
  EXPECT_TRUE(says(l, "the radius must be positive")) << l.reason;
}

TEST(Legitimacy, FormulasWithoutValueAreRefusedWithAReason) {
  EXPECT_TRUE(says(check_legitimacy(family(ToolFamily::kPower, 20, {-1, 1, 1, 2})), "not a finite number"));
  EXPECT_TRUE(says(check_legitimacy(family(ToolFamily::kBarrel, 20, {5, 5, 8})), "not a finite number"));
  EXPECT_TRUE(says(check_legitimacy(family(ToolFamily::kLens, 20, {15, 5})), "not a finite number"));
}

/// The margin of a barrel is known: 1 - |r'| at the far end, or (arc / (arc - radius)) / W^3 there, or r / L.
TEST(Legitimacy, MarginIsTheSmallestOfAllConditions) {
  const Legitimacy l = check_legitimacy(family(ToolFamily::kBarrel, 20, {85, 5, 8}));
  const double end_radius = 85.0 - std::hypot(80.0, 12.0);
  EXPECT_NEAR(l.margin, end_radius / 20.0, 1e-12);
  EXPECT_DOUBLE_EQ(l.s, 20.0);
  const Legitimacy wide = check_legitimacy(family(ToolFamily::kBarrel, 20, {35, 30, 0}));
  const double w = std::hypot(1.0, 20.0 / 5.0);
  EXPECT_NEAR(wide.margin, std::min(1.0 - (20.0 / 5.0) / w, 7.0 / (w * w * w)), 1e-12);
}

/// A dip far narrower than the first samples' spacing is found because the samples follow the knots.
TEST(Legitimacy, NarrowDipOfASplineIsFound) {
  const int count = 203;
  Eigen::VectorXd c = Eigen::VectorXd::Constant(count, 3.0);
  c[101] = 3.2;
  c[102] = 3.2;
  const Legitimacy l = check_legitimacy(RadialFunction::spline(20.0, c));
  EXPECT_FALSE(l.legitimate);
  EXPECT_NEAR(l.s, 9.8, 0.3);
}

TEST(Legitimacy, BarelyLegitimateAndBarelyNotAreToldApart) {
  // r = 5 + c x^2 over |x| <= 1: the third condition is 1 - 10 c - 6 c^2 x^2, least at both ends.
  const double limit = (std::sqrt(124.0) - 10.0) / 12.0;
  EXPECT_TRUE(check_legitimacy(family(ToolFamily::kHyperbolic, 2, {5, 0, limit * (1.0 - 1e-12)})).legitimate);
  EXPECT_FALSE(check_legitimacy(family(ToolFamily::kHyperbolic, 2, {5, 0, limit * (1.0 + 1e-12)})).legitimate);
}

}  // namespace
}  // namespace flank::internal
