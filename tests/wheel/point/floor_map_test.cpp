// Where a side stands on a floor.
#include "flank/wheel/point/floor_map.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

/// A bilinear face whose normal is du x dv.
Face leaning_plane(const Vec3& corner, const Vec3& along_u, const Vec3& along_v) {
  Face face;
  BSplineSurface& s = face.surface;
  s.degree_u = s.degree_v = 1;
  s.count_u = s.count_v = 2;
  s.knots_u = s.knots_v = {0.0, 0.0, 1.0, 1.0};
  s.poles = {corner, corner + along_v, corner + along_u, corner + along_u + along_v};
  return face;
}

TEST(SideLine, EndsWhereTheFootEndsAlthoughTheFloorRises) {
  WheelAxis axis;
  axis.point = Vec3(0.0, 4.0, -4000.0), axis.direction = Vec3::UnitX();
  const auto floor = make_target({leaning_plane(Vec3::Zero(), Vec3(20.0, 0.0, 20.0), Vec3(0.0, 8.0, 0.0))});
  // It leans across the channel, and its ends are parallel to z: places up the end stand over floor beyond the foot.
  const Vec3 foot(2.0, 1.0, 2.0), end(14.0, 1.0, 14.0);
  const auto side = make_target({leaning_plane(foot, end - foot, Vec3(0.0, 2.0, 5.0))});
  const FloorMap map({floor.get()}, axis);
  const SideLine line({side.get()}, {floor.get()}, map);
  ASSERT_FALSE(line.empty());
  EXPECT_NEAR(line.from(), map.way(foot), 0.6);
  EXPECT_NEAR(line.to(), map.way(end), 0.6);
  for (const double way : {line.from(), 0.5 * (line.from() + line.to()), line.to(), map.length()})
    EXPECT_NEAR((line.angle(way) - map.angle(foot)) * 4000.0, 0.0, 0.15) << way;
}

}  // namespace
}  // namespace flank::internal
