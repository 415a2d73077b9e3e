// What the planner of roughing knows of its stock: how far places are from a tool, and what the tool engages.
#include "flank/wheel/rough/stock_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

RadialFunction cone(double radius, double degrees, double length) {
  return {ToolFamily::kCone, length, Eigen::Vector2d(radius, degrees * kDegree)};
}

TEST(Cutter, KnowsHowFarAPlaceIsFromItsSpheres) {
  const RadialFunction radial = cone(1.2, 12.0, 9.0);
  const Cutter cutter(radial);
  for (double z = -2.0; z < 11.0; z += 0.37)
    for (double off = 0.0; off < 5.0; off += 0.43) {
      double least = 1e300;
      for (int k = 0; k <= 9000; ++k) {
        const double s = 1e-3 * k;
        least = std::min(least, std::hypot(off, z - s) - radial.at(s).r);
      }
      EXPECT_NEAR(cutter.distance(z, off), least, 2e-5) << z << " " << off;
    }
}

/// A half space below y = 0, and a tool that goes along it, so deep inside.
struct Wall {
  Cutter cutter{RadialFunction(ToolFamily::kCylinder, 4.0, Eigen::VectorXd::Constant(1, 1.0))};
  StockGrid stock = [] {
    Box3 box;
    box.add(Vec3(-5.0, -4.0, -2.0)), box.add(Vec3(5.0, 4.0, 6.0));
    return StockGrid(box, 0.2, [](const Vec3& p) { return -p.y(); });
  }();
  [[nodiscard]] static Pose at(double x, double deep) { return {Vec3(x, 1.0 - deep, 0.0), Vec3::UnitZ()}; }
};

TEST(StockGrid, EngagesAsTheDepthInAWallSays) {
  for (const double deep : {0.1, 0.3, 0.7, 1.0, 1.5}) {
    Wall wall;
    wall.stock.cut(wall.cutter, {Wall::at(-4.0, deep), Wall::at(0.0, deep)});
    EXPECT_NEAR(wall.stock.engagement(wall.cutter, Wall::at(0.0, deep), Wall::at(0.3, deep)), std::acos(1.0 - deep),
                3.0 * kDegree)
        << deep;
  }
}

/// A cone that goes down has material in front of it all round; one that is drawn up, less than half.
TEST(StockGrid, EngagesAllRoundWhereAConeGoesDown) {
  const Cutter cutter(cone(1.0, 12.0, 4.0));
  Box3 box;
  box.add(Vec3(-8.0, -8.0, -8.0)), box.add(Vec3(8.0, 8.0, 12.0));
  const StockGrid stock(box, 0.4, [](const Vec3&) { return 1.0; });
  const Pose from{Vec3::Zero(), Vec3::UnitZ()};
  const auto engaged = [&](const Vec3& way) { return stock.engagement(cutter, from, {way, from.axis}); };
  const double lean = std::tan(12.0 * kDegree);
  EXPECT_NEAR(engaged(Vec3(0.3, 0.0, 0.0)), std::numbers::pi, 1e-9);
  EXPECT_NEAR(engaged(Vec3(0.1, 0.0, -0.3)), 2.0 * std::acos(-3.0 * lean), 1e-6);
  EXPECT_NEAR(engaged(Vec3(0.1, 0.0, 0.3)), 2.0 * std::acos(3.0 * lean), 1e-6);
  EXPECT_NEAR(engaged(Vec3(0.0, 0.0, -0.3)), 2.0 * std::numbers::pi, 1e-9);
  EXPECT_EQ(engaged(Vec3(0.0, 0.0, 0.3)), 0.0);
}

TEST(StockGrid, MeetsNothingWhereItWasCut) {
  Wall wall;
  EXPECT_FALSE(wall.stock.meets(wall.cutter, Wall::at(0.0, -0.1)));
  EXPECT_TRUE(wall.stock.meets(wall.cutter, Wall::at(0.0, 0.2)));
  wall.stock.cut(wall.cutter, {Wall::at(-1.0, 0.2), Wall::at(1.0, 0.2)});
  EXPECT_FALSE(wall.stock.meets(wall.cutter, Wall::at(0.0, 0.2)));
  EXPECT_TRUE(wall.stock.meets(wall.cutter, Wall::at(3.0, 0.2)));
  EXPECT_LT(wall.stock.engagement(wall.cutter, Wall::at(-0.2, 0.2), Wall::at(0.0, 0.2)), 1e-9);
}

}  // namespace
}  // namespace flank::internal
