// Grown tools: every family keeps its kind, and every sphere grows by the same.
#include "flank/tool/grown.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace flank::internal {
namespace {

constexpr double kLength = 30.0, kMore = 0.3;

RadialFunction of(ToolFamily family, const std::vector<double>& p) {
  return {family, kLength, Eigen::Map<const Eigen::VectorXd>(p.data(), static_cast<Eigen::Index>(p.size()))};
}

TEST(Grown, EverySphereIsLargerByTheSame) {
  const std::vector<RadialFunction> tools = {of(ToolFamily::kCylinder, {4.0}),
                                             of(ToolFamily::kCone, {3.0, 0.08}),
                                             of(ToolFamily::kBarrel, {85.0, 5.0, 12.0}),
                                             of(ToolFamily::kBarrel, {-60.0, 3.0, 12.0}),
                                             of(ToolFamily::kLens, {5.0, 3.5}),
                                             of(ToolFamily::kTaperedBarrel, {120.0, 4.0, 0.1}),
                                             of(ToolFamily::kHyperbolic, {3.0, 0.02, 0.004}),
                                             RadialFunction::spline(kLength, Eigen::VectorXd::LinSpaced(9, 2.0, 4.0))};
  for (const RadialFunction& tool : tools) {
    const RadialFunction more = grown(tool, kMore);
    EXPECT_EQ(more.family(), tool.family());
    for (int k = 0; k <= 60; ++k) {
      const double s = kLength * k / 60.0;
      const RadialJet a = tool.at(s), b = more.at(s);
      EXPECT_NEAR(b.r, a.r + kMore, 1e-12) << family_name(tool.family()) << " at " << s;
      EXPECT_NEAR(b.d1, a.d1, 1e-12);
      EXPECT_NEAR(b.d2, a.d2, 1e-12);
    }
  }
}

TEST(Grown, AFamilyWithoutSuchAMemberBecomesASplineAsNear) {
  const RadialFunction tool = of(ToolFamily::kPower, {4.0, 0.3, 1.0, 2.0}), more = grown(tool, kMore);
  EXPECT_EQ(more.family(), ToolFamily::kSpline);
  for (int k = 0; k <= 997; ++k) {
    const double s = kLength * k / 997.0;
    EXPECT_NEAR(more.at(s).r, tool.at(s).r + kMore, kGrownErrorMm) << s;
  }
}

TEST(Grown, ShankAndHolderStay) {
  Tool tool;
  tool.radial = of(ToolFamily::kCylinder, {4.0});
  tool.shank = {{kLength, 4.0}, {kLength + 20.0, 4.0}};
  tool.name = "end mill";
  const Tool more = grown(tool, kMore);
  EXPECT_EQ(more.shank, tool.shank);
  EXPECT_EQ(more.name, tool.name);
  EXPECT_DOUBLE_EQ(more.radial.smallest(), 4.3);
}

}  // namespace
}  // namespace flank::internal
