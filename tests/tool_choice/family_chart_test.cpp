// Families as spaces: bounds that follow the target, coordinates that rise, roundings, and texts that read back.
#include "flank/tool_choice/family_chart.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cover/cover_targets.h"
#include "flank/tool_request/tool_spec.h"
#include "seed/sheet.h"

namespace flank::internal {
namespace {

constexpr double kLength = 20.0, kTolerance = 0.05, kDegree = 3.14159265358979324 / 180.0;

/// The hollow of a cylinder of radius 30: curvatures 0 and 1 / 30, the diagonal is that of 24 x 40 mm and its rise.
ScreenPlaces hollow() {
  return screen_places(*make_target({testing::sheet([](double u, double v) {
    const double a = 0.8 * (u - 0.5);
    return Vec3(30.0 * std::sin(a), 40.0 * v, -30.0 * std::cos(a));
  })}),
                       80);
}
ScreenPlaces flat() { return screen_places(*testing::flat_target(0.0, 80.0, 0.0, 60.0), 80); }

FamilyChart chart(ToolFamily family, const std::map<std::string, double>& given, const ScreenPlaces& places) {
  return FamilyChart(family, given, kLength, places, kTolerance);
}

double parameter(const FamilyChart& chart, const std::vector<double>& x, int k) {
  const auto radial = chart.at(x);
  EXPECT_TRUE(radial);
  return radial ? radial->parameters()[k] : 0.0;
}

TEST(FamilyBounds, RadiiReachFromATenthOfTheAxisToAShareOfTheTarget) {
  const FamilyChart cylinders = chart(ToolFamily::kCylinder, {}, flat());
  EXPECT_NEAR(parameter(cylinders, {0.0}, 0), 2.0, 1e-9);
  EXPECT_NEAR(parameter(cylinders, {1.0}, 0), 0.15 * 100.0, 1e-9);
  EXPECT_NEAR(parameter(cylinders, {0.5}, 0), std::sqrt(2.0 * 15.0), 5e-3) << "in the logarithm";
}

TEST(FamilyBounds, ATinyTargetLeavesSomeRoomForTheRadius) {
  const ScreenPlaces tiny = screen_places(*testing::flat_target(0.0, 3.0, 0.0, 4.0), 40);
  EXPECT_NEAR(parameter(chart(ToolFamily::kCylinder, {}, tiny), {1.0}, 0), 1.5 * 2.0, 1e-9);
}

TEST(FamilyBounds, CurvaturesReachHalfAsFarAgainAsTheTargets) {
  const FamilyChart barrels = chart(ToolFamily::kBarrel, {{"radius", 5.0}}, hollow());
  EXPECT_NEAR(parameter(barrels, {1.0}, 0), 30.0 / 1.5, 0.02) << "1.5 / 30 at most";
  // No curvature of the target is negative: the least that the tolerance sees remains, 16 tolerance / L^2.
  EXPECT_NEAR(parameter(barrels, {0.0}, 0), -kLength * kLength / (16.0 * kTolerance), 0.1);
  const FamilyChart on_flat = chart(ToolFamily::kBarrel, {{"radius", 5.0}}, flat());
  EXPECT_NEAR(parameter(on_flat, {1.0}, 0), kLength * kLength / (16.0 * kTolerance), 0.1);
  EXPECT_NEAR(parameter(on_flat, {0.5}, 0), 1e6, 1.0) << "straight, as an arc of a kilometre";
}

TEST(FamilyBounds, AnglesAreThoseOfTheFamily) {
  EXPECT_NEAR(parameter(chart(ToolFamily::kCone, {{"radius", 4.0}}, flat()), {1.0}, 1), 20.0 * kDegree, 1e-9);
  EXPECT_EQ(parameter(chart(ToolFamily::kCone, {{"radius", 4.0}}, flat()), {0.0}, 1), 0.0);
  const FamilyChart tapered = chart(ToolFamily::kTaperedBarrel, {{"radius", 8.0}, {"arc", 200.0}}, flat());
  EXPECT_NEAR(parameter(tapered, {1.0}, 2), 40.0 * kDegree, 1e-9);
  const FamilyChart hyperbolic = chart(ToolFamily::kHyperbolic, {{"radius", 5.0}, {"bend", 1e-4}}, flat());
  EXPECT_NEAR(parameter(hyperbolic, {0.0}, 1), -0.2, 1e-12);
  EXPECT_NEAR(parameter(hyperbolic, {1.0}, 1), 0.2, 1e-12);
  EXPECT_NEAR(parameter(hyperbolic, {0.5}, 1), 0.0, 1e-12);
}

TEST(FamilyCoordinates, EveryOneRises) {
  const ScreenPlaces places = hollow();
  const auto rises = [&](const FamilyChart& space, int parameter_index, bool inverse) {
    double last = -1e300;
    int tools = 0;
    for (int i = 0; i <= 40; ++i) {
      const auto radial = space.at({i / 40.0});
      if (!radial) continue;
      const double value = radial->parameters()[parameter_index], here = inverse ? 1.0 / value : value;
      EXPECT_GE(here, last);
      last = here;
      ++tools;
    }
    EXPECT_GE(tools, 30);
  };
  rises(chart(ToolFamily::kCylinder, {}, places), 0, false);
  rises(chart(ToolFamily::kCone, {{"radius", 3.0}}, places), 1, false);
  rises(chart(ToolFamily::kBarrel, {{"radius", 3.0}}, places), 0, true);
  rises(chart(ToolFamily::kTaperedBarrel, {{"radius", 9.0}, {"arc", 100.0}}, places), 2, false);
}

TEST(FamilyCoordinates, ParametersAreRoundAndWhatIsGivenStays) {
  const FamilyChart space = chart(ToolFamily::kTaperedBarrel, {{"radius", 6.123456}}, hollow());
  ASSERT_EQ(space.coordinates().size(), 2u);
  for (const double x : {0.13, 0.58, 0.77}) {
    for (const double y : {0.05, 0.4}) {
      const auto radial = space.at({x, y});
      if (!radial) continue;
      EXPECT_EQ(radial->parameters()[1], 6.123456);
      const double degrees = radial->parameters()[2] / kDegree, arc = radial->parameters()[0];
      EXPECT_NEAR(degrees * 100.0, std::round(degrees * 100.0), 1e-6);
      const double digits = arc / std::pow(10.0, std::floor(std::log10(std::abs(arc))) - 3.0);
      EXPECT_NEAR(digits, std::round(digits), 1e-6) << "four digits";
    }
  }
  const double radius = parameter(chart(ToolFamily::kCylinder, {}, hollow()), {0.37}, 0);
  EXPECT_NEAR(radius * 100.0, std::round(radius * 100.0), 1e-6);
}

TEST(FamilyCoordinates, AnArcSmallerThanTheToolIsNoTool) {
  // Curvatures up to 1 / 20: from a radius of 20 mm on the largest has no tool.
  EXPECT_TRUE(chart(ToolFamily::kBarrel, {{"radius", 19.0}}, hollow()).at({1.0}));
  EXPECT_FALSE(chart(ToolFamily::kBarrel, {{"radius", 20.5}}, hollow()).at({1.0}));
  EXPECT_TRUE(chart(ToolFamily::kBarrel, {{"radius", 20.5}}, hollow()).at({0.5}));
}

TEST(FamilyCoordinates, ALensIsTheBarrelOfItsCurvature) {
  const FamilyChart lenses = chart(ToolFamily::kLens, {{"radius", 6.0}}, hollow());
  const FamilyChart barrels = chart(ToolFamily::kBarrel, {{"radius", 6.0}}, hollow());
  for (const double x : {0.05, 0.6, 0.95}) {
    const auto lens = lenses.at({x}), barrel = barrels.at({x});
    ASSERT_TRUE(lens && barrel);
    for (const double s : {0.0, 4.0, 10.0, 20.0}) EXPECT_NEAR(lens->at(s).r, barrel->at(s).r, 2e-3) << x << " " << s;
  }
}

TEST(FamilyCoordinates, HaveLevelsThatSeeTheirTools) {
  const FamilyChart space = chart(ToolFamily::kTaperedBarrel, {}, hollow());
  ASSERT_EQ(space.coordinates().size(), 3u);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(space.levels(k), space.coordinates()[k] == FamilyCoordinate::kCurvature ? 9 : 5);
}

TEST(FamilyText, NamesWhatIsSearched) {
  const std::string barrel = chart(ToolFamily::kBarrel, {}, hollow()).text();
  EXPECT_NE(barrel.find("radius from a tenth of the axis length to "), std::string::npos) << barrel;
  EXPECT_NE(barrel.find("arc from -500 mm (concave) through straight to 20 mm"), std::string::npos) << barrel;
  EXPECT_EQ(chart(ToolFamily::kCone, {{"radius", 3.0}}, flat()).text(), "angle 0 to 20 degrees");
  EXPECT_EQ(chart(ToolFamily::kHyperbolic, {{"radius", 3.0}, {"bend", 0.0}}, flat()).text(), "slope -0.2 to 0.2");
}

/// A family's text, read as the command line reads it, is the same tool.
TEST(FamilyText, ReadsBack) {
  const std::vector<RadialFunction> tools = {
      RadialFunction(ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, 4.25)),
      RadialFunction(ToolFamily::kCone, kLength, Eigen::Vector2d(3.5, 7.25 * kDegree)),
      RadialFunction(ToolFamily::kBarrel, kLength, Eigen::Vector3d(85.5, 5.0, 10.0)),
      RadialFunction(ToolFamily::kBarrel, kLength, Eigen::Vector3d(-120.0, 5.0, 7.5)),
      RadialFunction(ToolFamily::kLens, kLength, Eigen::Vector2d(6.0, 5.1234)),
      RadialFunction(ToolFamily::kTaperedBarrel, kLength, Eigen::Vector3d(250.0, 6.5, 12.5 * kDegree)),
      RadialFunction(ToolFamily::kHyperbolic, kLength, Eigen::Vector3d(5.0, 0.05, 0.00125))};
  for (const RadialFunction& radial : tools) {
    const std::string text = family_text(radial);
    const ToolSpec spec = parse_tool_spec(text);
    ASSERT_TRUE(spec.family) << text;
    const RadialFunction read = make_tool(*spec.family, spec.given, kLength).radial;
    EXPECT_EQ(read.family(), radial.family());
    EXPECT_LT((read.parameters() - radial.parameters()).cwiseAbs().maxCoeff(), 1e-9) << text;
  }
}

TEST(FamilyText, ReadsBackFromEveryGridPointOfAChart) {
  const FamilyChart space = chart(ToolFamily::kTaperedBarrel, {}, hollow());
  int tools = 0;
  for (const double x : {0.0, 0.3, 1.0})
    for (const double y : {0.1, 0.5, 0.9})
      for (const double z : {0.0, 0.35, 0.7}) {
        const auto radial = space.at({x, y, z});
        if (!radial) continue;
        ++tools;
        const ToolSpec spec = parse_tool_spec(family_text(*radial));
        const RadialFunction read = make_tool(*spec.family, spec.given, kLength).radial;
        for (const double s : {0.0, 7.0, 20.0})
          EXPECT_NEAR(read.at(s).r, radial->at(s).r, 1e-9) << family_text(*radial);
      }
  EXPECT_GE(tools, 9);
}

}  // namespace
}  // namespace flank::internal
