#include "flank/fit/model/tool_excess.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/tool/compliance.h"

namespace flank::internal {
namespace {

constexpr double kLength = 40.0;

std::vector<double> places(int count = 9) {
  std::vector<double> s;
  for (int j = 0; j < count; ++j) s.push_back(kLength * j / (count - 1));
  return s;
}

RadialFunction spline(std::initializer_list<double> radii) {
  Eigen::VectorXd r(static_cast<Eigen::Index>(radii.size()));
  std::copy(radii.begin(), radii.end(), r.begin());
  return RadialFunction::spline(kLength, r);
}

RadiusBounds slender(double limit) {
  RadiusBounds bounds;
  bounds.slenderest = limit;
  return bounds;
}

TEST(ToolExcess, AToolWithinItsBoundsHasNone) {
  RadiusBounds bounds{1.0, 9.0, 0.9};
  bounds.slenderest = 8.0;
  bounds.neck = 0.1;
  bounds.wheel_radius = 50.0;
  EXPECT_TRUE(tool_excesses(spline({3.0, 3.1, 3.2, 3.3, 3.4}), bounds, places()).empty());
  EXPECT_EQ(tool_excess_square(spline({3.0, 3.1, 3.2, 3.3, 3.4}), bounds, places()), 0.0);
}

// Of a spline whose profile bends hardest at a knot between two samples, which see nothing of it.
TEST(ToolExcess, BoundsAreAskedAtTheKnotsToo) {
  const RadialFunction bent = spline({8.0, 6.5, 3.0, 6.5, 8.0, 8.2});
  RadiusBounds bounds{1.0, 9.0, 0.9};
  bounds.wheel_radius = 50.0;
  const double knot = kLength / 3.0;
  const std::vector<double> coarse = {0.0, 0.9 * kLength, kLength};
  const std::vector<double> all = bound_places(bent, coarse);
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
  EXPECT_EQ(all.size(), coarse.size() + 2);
  EXPECT_EQ(std::count_if(all.begin(), all.end(), [&](double s) { return std::abs(s - knot) < 1e-12; }), 1);
  EXPECT_TRUE(tool_excesses(bent, bounds, coarse).empty());
  EXPECT_FALSE(tool_excesses(bent, bounds, all).empty());
  EXPECT_EQ(bound_places(RadialFunction(ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, 3.0)), coarse),
            coarse);
}

TEST(ToolExcess, SlendernessIsThatOfTheEquivalentCylinder) {
  // A cylinder of radius 2 has 40 / 4 = 10; a limit of 8 is exceeded by a quarter of the length.
  const auto excesses = tool_excesses(spline({2.0, 2.0, 2.0, 2.0}), slender(8.0), places());
  ASSERT_EQ(excesses.size(), 1u);
  EXPECT_NEAR(excesses.front().mm, kLength * 0.25, 0.2);
  EXPECT_EQ(excesses.front().share, 1.0);
  EXPECT_TRUE(tool_excesses(spline({2.6, 2.6, 2.6, 2.6}), slender(8.0), places()).empty());
}

TEST(ToolExcess, AShankCountsAsPartOfTheTool) {
  RadiusBounds bounds = slender(8.0);
  EXPECT_TRUE(tool_excesses(spline({3.0, 3.0, 3.0, 3.0}), bounds, places()).empty());
  bounds.shank_length = 20.0;  // 60 / 6 = 10
  const auto excesses = tool_excesses(spline({3.0, 3.0, 3.0, 3.0}), bounds, places());
  ASSERT_EQ(excesses.size(), 1u);
  EXPECT_NEAR(excesses.front().mm, kLength * 0.25, 0.2);
  bounds.shank_radius = 8.0;
  EXPECT_TRUE(tool_excesses(spline({3.0, 3.0, 3.0, 3.0}), bounds, places()).empty());
}

TEST(ToolExcess, ANeckIsWhatIsThinnerThanSomethingBelowIt) {
  RadiusBounds bounds;
  bounds.neck = 0.1;
  EXPECT_TRUE(tool_excesses(spline({3.0, 4.0, 5.0, 6.0}), bounds, places()).empty());
  EXPECT_TRUE(tool_excesses(spline({4.0, 3.9, 3.8, 3.7}), bounds, places()).empty());
  const RadialFunction bulb = spline({5.0, 5.0, 3.0, 3.0, 5.0});
  double deepest = 0.0;
  for (const ToolExcess& e : tool_excesses(bulb, bounds, places())) deepest = std::max(deepest, e.mm);
  double expected = 0.0;
  for (const double s : places()) expected = std::max(expected, 0.9 * 5.0 - bulb.at(s).r);
  EXPECT_NEAR(deepest, expected, 0.02);
}

TEST(ToolExcess, AConcaveMeridianTighterThanTheWheelIsRefused) {
  // A concave arc of 30 mm.
  const RadialFunction waist(ToolFamily::kBarrel, kLength, Eigen::Vector3d(-30.0, 4.0, 20.0));
  RadiusBounds bounds;
  bounds.wheel_radius = 29.0;
  EXPECT_TRUE(tool_excesses(waist, bounds, places()).empty());
  bounds.wheel_radius = 31.0;
  EXPECT_EQ(tool_excesses(waist, bounds, places()).size(), places().size());
}

TEST(ToolExcess, SquareIsThatOfTheResiduals) {
  RadiusBounds bounds{2.5, 4.5, 0.05};
  bounds.slenderest = 3.0;
  bounds.neck = 0.05;
  bounds.wheel_radius = 200.0;
  bounds.shank_length = 10.0;
  const RadialFunction tool = spline({5.0, 4.6, 2.2, 2.4, 3.0, 3.1});
  double sum = 0.0;
  for (const ToolExcess& e : tool_excesses(tool, bounds, places())) sum += e.share * e.mm * e.mm;
  EXPECT_NEAR(tool_excess_square(tool, bounds, places()), sum, 1e-12 * sum);
}

TEST(ToolExcess, GradientIsThatOfDifferences) {
  RadiusBounds bounds{2.5, 4.5, 0.05};
  bounds.slenderest = 3.0;
  bounds.neck = 0.05;
  bounds.wheel_radius = 200.0;
  bounds.shank_length = 10.0;
  const RadialFunction tool = spline({5.0, 4.6, 2.2, 2.4, 3.0, 3.1});
  const auto excesses = tool_excesses(tool, bounds, places());
  ASSERT_GT(excesses.size(), 10u);
  for (int k = 0; k < tool.parameter_count(); ++k) {
    constexpr double kStep = 1e-6;
    Eigen::VectorXd up = tool.parameters(), down = tool.parameters();
    up[k] += kStep, down[k] -= kStep;
    const auto above = tool_excesses(tool.with_parameters(up), bounds, places());
    const auto below = tool_excesses(tool.with_parameters(down), bounds, places());
    ASSERT_EQ(above.size(), excesses.size());
    ASSERT_EQ(below.size(), excesses.size());
    for (std::size_t e = 0; e < excesses.size(); ++e)
      EXPECT_NEAR(excesses[e].gradient[k], (above[e].mm - below[e].mm) / (2.0 * kStep),
                  1e-4 * (1.0 + excesses[e].gradient.norm()))
          << "excess " << e << ", parameter " << k;
  }
}

}  // namespace
}  // namespace flank::internal
