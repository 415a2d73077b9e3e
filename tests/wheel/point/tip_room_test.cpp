// A shank has as much room as it is thick, and its tool no room where it has none.
#include "flank/wheel/point/tip_room.h"

#include <gtest/gtest.h>

#include "flank/geom/tessellate.h"
#include "flank/wheel/point/axis_rod.h"

namespace flank::internal {
namespace {

/// A wall far above the flank, 4 mm beside the axis.
struct Wall {
  static constexpr double kBesideMm = 4.0;
  TriangleBvh wheel = [] {
    TriangleMesh mesh;
    mesh.vertices = {Vec3(kBesideMm, -5.0, 40.0), Vec3(kBesideMm, 5.0, 40.0), Vec3(kBesideMm, 0.0, 60.0)};
    mesh.triangles = {{0, 1, 2}};
    return TriangleBvh(mesh);
  }();
  RadialFunction radial{ToolFamily::kCylinder, 8.0, Eigen::VectorXd::Constant(1, 1.5)};

  [[nodiscard]] bool is_free(double shank_mm) const {
    FloorChannel channel;
    channel.wheel = &wheel;
    channel.reach_mm = 80.0;
    PointOptions options;
    options.shank_mm = shank_mm;
    return TipRoom(channel, radial, options).is_free({Vec3::Zero(), Vec3::UnitZ()});
  }
};

TEST(TipRoom, IsThatOfTheShankToo) {
  const Wall wall;
  EXPECT_TRUE(wall.is_free(1.5));
  EXPECT_TRUE(wall.is_free(3.4));
  EXPECT_FALSE(wall.is_free(3.9)) << "triangles are off their faces, so a little more is asked";
  EXPECT_FALSE(wall.is_free(4.5));
}

TEST(AxisRod, IsAsThickAsTheShankOrAsTheFlankEnds) {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCone, 10.0, Eigen::Vector2d(0.5, 0.2));
  const Vec2 end = meridian_point(tool.radial, 10.0);
  EXPECT_DOUBLE_EQ(shank_radius(tool), end.y());
  tool.shank = {{end.x(), 1.25}, {end.x() + 5.0, 2.0}, {end.x() + 30.0, 2.0}};
  EXPECT_DOUBLE_EQ(shank_radius(tool), 2.0);
  EXPECT_GT(rod_radius(2.0, 60.0, RodRoom::kPlanned), rod_radius(2.0, 60.0, RodRoom::kGuarded));
  EXPECT_LT(rod_radius(2.0, 60.0, RodRoom::kGuarded), 2.0) << "a path beside the faces themselves would be cut";
  EXPECT_GT(rod_radius(2.0, 60.0, RodRoom::kGuarded), 1.9);
}

}  // namespace
}  // namespace flank::internal
