#include "flank/verify/swept/tool_distance.h"

#include <gtest/gtest.h>

#include <vector>

#include "flank/base/random.h"

namespace flank::internal::verify {
namespace {

/// Every node of the table that is no higher than its neighbours and below the limit, by looking at all of them.
std::vector<double> minima_of_all_nodes(const RadialTable& radial, double z, double rho, double below) {
  const auto at = [&](int i) { return std::hypot(z - radial.node(i), rho) - radial.node_radius(i); };
  std::vector<double> found;
  for (int i = 0; i <= radial.count(); ++i) {
    const bool left = i == 0 || at(i) <= at(i - 1), right = i == radial.count() || at(i) < at(i + 1);
    if (left && right && at(i) < below + radial.step()) found.push_back(radial.node(i));
  }
  return found;
}

TEST(ToolDistance, MinimaAreThoseOfAllNodes) {
  const RadialFunction shapes[] = {
      RadialFunction::spline(60.0, (Eigen::VectorXd(7) << 3.0, 1.0, 4.0, 0.8, 3.5, 1.2, 4.0).finished()),
      RadialFunction(ToolFamily::kHyperbolic, 40.0, Eigen::Vector3d(2.0, 0.0, 0.02))};
  for (const RadialFunction& shape : shapes) {
    const ToolDistance tool(shape);
    Random random(7);
    int several = 0, none = 0;
    for (int k = 0; k < 20000; ++k) {
      const double z = random.uniform(-30.0, 90.0), rho = random.uniform(0.0, 40.0);
      const double below = random.uniform(-5.0, 50.0);
      const std::vector<double> wanted = minima_of_all_nodes(tool.radial(), z, rho, below);
      std::array<double, ToolDistance::kMostMinima> s;
      const int count = tool.minima(z, rho, below, s);
      ASSERT_EQ(std::vector<double>(s.begin(), s.begin() + count), wanted) << z << ' ' << rho << ' ' << below;
      several += count > 1;
      none += count == 0;
    }
    EXPECT_GT(several, 100);
    EXPECT_GT(none, 100);
    std::array<double, ToolDistance::kMostMinima> s;
    EXPECT_EQ(tool.minima(1.0, 2.0, 1e300, s),
              static_cast<int>(minima_of_all_nodes(tool.radial(), 1.0, 2.0, 1e300).size()));
  }
}

/// The nodes that the search looks at are those that can matter: no sphere is nearer than the one it finds.
TEST(ToolDistance, SearchFindsTheNearestOfAllSpheres) {
  const RadialFunction shapes[] = {
      RadialFunction::spline(60.0, (Eigen::VectorXd(7) << 3.0, 1.0, 4.0, 0.8, 3.5, 1.2, 4.0).finished()),
      RadialFunction(ToolFamily::kHyperbolic, 40.0, Eigen::Vector3d(2.0, 0.0, 0.02)),
      RadialFunction(ToolFamily::kCylinder, 30.0, Eigen::VectorXd::Constant(1, 4.0))};
  constexpr int kPlaces = 2000;
  for (const RadialFunction& shape : shapes) {
    const ToolDistance tool(shape);
    Random random(13);
    for (int k = 0; k < 2000; ++k) {
      const double z = random.uniform(-30.0, 90.0), rho = random.uniform(0.0, 40.0);
      const NearestSphere found = tool.search(z, rho);
      const auto at = [&](double s) { return std::hypot(z - s, rho) - tool.radial().at(s).r; };
      ASSERT_NEAR(at(found.s), found.g, 1e-12);
      for (int i = 0; i <= kPlaces; ++i)
        ASSERT_LE(found.g, at(shape.axis_length() * i / kPlaces) + 1e-9) << z << ' ' << rho;
    }
  }
}

/// A cylinder whose meridian turns up sharply at its upper end, as a free tool's may.
RadialFunction peaked() {
  Eigen::VectorXd c = Eigen::VectorXd::Constant(24, 6.0);
  c[23] = 6.6;
  return RadialFunction::spline(40.0, c);
}

/// Of a group of poses that are farther from each other at one end: no sphere of any of them is nearer, and the bound is not far below.
TEST(ToolDistance, TheBoundOfAWiderToolIsBelowAllItsSpheres) {
  const RadialFunction shapes[] = {
      RadialFunction::spline(60.0, (Eigen::VectorXd(7) << 3.0, 1.0, 4.0, 0.8, 3.5, 1.2, 4.0).finished()),
      RadialFunction(ToolFamily::kCone, 38.0, Eigen::Vector2d(0.4, 0.2)),
      RadialFunction(ToolFamily::kCylinder, 30.0, Eigen::VectorXd::Constant(1, 4.0))};
  constexpr int kPlaces = 2000;
  for (const RadialFunction& shape : shapes) {
    const ToolDistance tool(shape);
    Random random(14);
    double loss = 0.0;
    for (int k = 0; k < 1000; ++k) {
      const double z = random.uniform(-30.0, 90.0), rho = random.uniform(0.0, 40.0), length = shape.axis_length();
      const double low = random.uniform(0.0, 5.0), high = random.uniform(0.0, 60.0);
      double least = 1e300;
      for (int i = 0; i <= kPlaces; ++i) {
        const double s = length * i / kPlaces, wide = shape.at(s).r + low + (high - low) * s / length;
        least = std::min(least, std::hypot(z - s, rho) - wide);
      }
      const double bound = tool.least_of_wider(z, rho, low, high);
      ASSERT_LE(bound, least) << z << ' ' << rho << ' ' << low << ' ' << high;
      loss = std::max(loss, least - bound);
    }
    EXPECT_LE(loss, 0.5 * shape.largest());
  }
}

TEST(ToolDistance, FewerMinimaAreBelowWhereTheMeridianIsFlat) {
  const RadialFunction shapes[] = {
      peaked(), RadialFunction::spline(60.0, (Eigen::VectorXd(7) << 3.0, 1.0, 4.0, 0.8, 3.5, 1.2, 4.0).finished())};
  for (const RadialFunction& shape : shapes) {
    const ToolDistance tool(shape);
    Random random(11);
    int told = 0;
    for (int k = 0; k < 20000; ++k) {
      const double z = random.uniform(-10.0, 70.0), rho = random.uniform(0.0, 20.0);
      const double below = random.uniform(-3.0, 10.0), focal = tool.focal_curvature(z, rho, below);
      ASSERT_LE(focal, tool.focal_curvature());
      if (rho * focal >= 1.0) continue;
      told += rho * tool.focal_curvature() >= 1.0;
      // Minima of the table's nodes lie above those of the tool by up to a step.
      ASSERT_LE(minima_of_all_nodes(tool.radial(), z, rho, below - tool.radial().step()).size(), 1U)
          << z << ' ' << rho << ' ' << below;
    }
    EXPECT_GT(told, 100) << "where the whole meridian would not tell";
  }
}

TEST(ToolDistance, APeakAtAnEndDoesNotMatterElsewhere) {
  const ToolDistance tool(peaked());
  EXPECT_GT(6.0 * tool.focal_curvature(), 1.0);
  EXPECT_LT(6.0 * tool.focal_curvature(20.0, 6.1, 0.2), 0.1);
  EXPECT_EQ(tool.focal_curvature(38.0, 6.1, 0.5), tool.focal_curvature());
  EXPECT_EQ(tool.focal_curvature(20.0, 9.0, 0.2), 0.0) << "no sphere is so near";
}

}  // namespace
}  // namespace flank::internal::verify
