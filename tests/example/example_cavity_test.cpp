// The free-form cavity: its size, its symmetry, and that no cone can follow its walls.
#include "flank/example/example_cavity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/error.h"

namespace flank::internal {
namespace {

Vec3 at(const Face& wall, double u, double v) { return wall.surface.value(u, v); }

Vec3 normal(const Face& wall, double u, double v) {
  constexpr double kStep = 1e-6;
  const Vec3 du = at(wall, u + kStep, v) - at(wall, u - kStep, v), dv = at(wall, u, v + kStep) - at(wall, u, v - kStep);
  return du.cross(dv).normalized();
}

TEST(ExampleCavity, HasTheSizeThatIsAskedFor) {
  const CavityShape shape{.width_mm = 40.0, .depth_mm = 30.0, .length_mm = 60.0, .twist_deg = 20.0, .hollow_mm = 0.8};
  Box3 box;
  for (const Face& wall : cavity_walls(shape))
    for (int i = 0; i <= 100; ++i)
      for (int j = 0; j <= 100; ++j) box.add(at(wall, 0.01 * i, 0.01 * j));
  const Vec3 size = box.high - box.low;
  EXPECT_NEAR(size.x(), 60.0, 1e-6);
  EXPECT_NEAR(size.y(), 40.0, 0.01);
  EXPECT_GT(size.z(), 29.0);
  EXPECT_LT(size.z(), 30.5);
}

TEST(ExampleCavity, WallsLookAtEachOtherAndAreHalfATurnOfOneAnother) {
  const std::vector<Face> walls = cavity_walls({});
  ASSERT_EQ(walls.size(), 2u);
  EXPECT_EQ(walls[1].id, "F2");
  for (const double u : {0.1, 0.5, 0.8})
    for (const double v : {0.2, 0.6, 0.9}) {
      EXPECT_LT(normal(walls[0], u, v).y(), -0.8);
      EXPECT_GT(normal(walls[1], u, v).y(), 0.8);
      const Vec3 p = at(walls[0], u, v), q = at(walls[1], u, v);
      EXPECT_NEAR((Vec3(-p.x(), -p.y(), p.z()) - q).norm(), 0.0, 1e-9);
    }
}

TEST(ExampleCavity, WallsAreAsHollowAsTheyAreAskedToBe) {
  const std::vector<Face> walls = cavity_walls({.hollow_mm = 1.0});
  const Vec3 low = at(walls[0], 0.5, 0.0), high = at(walls[0], 0.5, 1.0), along = (high - low).normalized();
  double deepest = 0.0;
  for (double v = 0.0; v <= 1.0; v += 0.01) {
    const Vec3 d = at(walls[0], 0.5, v) - low;
    deepest = std::max(deepest, (d - d.dot(along) * along).norm());
  }
  EXPECT_NEAR(deepest, 1.0, 0.03) << "the cubic share moves the deepest place and adds 1.6 %";
}

TEST(ExampleCavity, IsMadeWhereItsWallsPassTheMiddleButDoNotMeet) {
  // Narrow and long, or twisted: both walls bend and twist together, beyond the plane in the middle of the cavity.
  for (const CavityShape& shape : {CavityShape{.width_mm = 8.0, .depth_mm = 12.0, .length_mm = 150.0},
                                   CavityShape{.width_mm = 10.0, .depth_mm = 25.0, .length_mm = 30.0}}) {
    const std::vector<Face> walls = cavity_walls(shape);
    double low = 1e300, high = -1e300, between = 1e300;
    for (int i = 0; i <= 100; ++i)
      for (int j = 0; j <= 100; ++j) {
        const Vec3 p = at(walls[0], 0.01 * i, 0.01 * j), q = at(walls[1], 1.0 - 0.01 * i, 0.01 * j);
        between = std::min(between, p.y() - q.y());
        high = std::max(high, p.y());
        low = std::min(low, q.y());
      }
    EXPECT_NEAR(high - low, shape.width_mm, 0.01);
    EXPECT_GT(between, 1.0);
  }
  EXPECT_THROW(static_cast<void>(cavity_walls({.width_mm = 6.0, .depth_mm = 25.0, .length_mm = 30.0})), UsageError);
}

TEST(ExampleCavity, WallsCloseItsEnds) {
  const std::vector<Face> both = cavity_walls({.length_mm = 60.0, .end_wall = true, .start_wall = true});
  ASSERT_EQ(both.size(), 4u);
  EXPECT_EQ(both[2].id, "F3");
  EXPECT_EQ(both[3].id, "F4");
  EXPECT_NEAR(at(both[2], 0.5, 0.5).x(), 30.0, 1e-9);
  EXPECT_NEAR(at(both[3], 0.5, 0.5).x(), -30.0, 1e-9);
  EXPECT_LT(normal(both[2], 0.5, 0.5).x(), -0.99) << "they look inwards";
  EXPECT_GT(normal(both[3], 0.5, 0.5).x(), 0.99);
  const std::vector<Face> start = cavity_walls({.start_wall = true});
  ASSERT_EQ(start.size(), 3u);
  EXPECT_EQ(start[2].id, "F3");
}

// 200 mm deep walls that lean by 4 degrees are 14 mm nearer to each other at the bottom than in the middle, and meet.
TEST(ExampleCavity, DeepWallsThatLeanLessDoNotMeet) {
  const CavityShape deep{.width_mm = 25.0, .depth_mm = 200.0, .length_mm = 200.0, .twist_deg = 2.0};
  EXPECT_THROW((void)cavity_walls(deep), UsageError);
  CavityShape steep = deep;
  steep.lean_deg = 0.5;
  EXPECT_EQ(cavity_walls(steep).size(), 2u);
}

TEST(ExampleCavity, RefusesWallsThatMeet) {
  EXPECT_THROW((void)cavity_walls({.width_mm = 5.0}), UsageError);
  EXPECT_THROW((void)cavity_walls({.depth_mm = 0.0}), UsageError);
  EXPECT_THROW((void)cavity_walls({.twist_deg = 80.0}), UsageError);
  EXPECT_THROW((void)cavity_walls({.lean_deg = 50.0}), UsageError);
}

}  // namespace
}  // namespace flank::internal
