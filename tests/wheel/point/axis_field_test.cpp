// Directions of the axis turn without a jump, in how fast they do so neither, and stay where a machine holds them.
#include "flank/wheel/point/axis_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/geom/tessellate.h"
#include "flank/geom/triangle_bvh.h"
#include "verify/faces.h"

namespace flank::internal {
namespace {

constexpr int kRows = 12;

/// Places in a row, free all round, above which a floor leans to and fro.
struct Floor {
  TriangleBvh coarse = [] {
    TriangleMesh far;
    far.vertices = {Vec3(0.0, 0.0, -900.0), Vec3(1.0, 0.0, -900.0), Vec3(0.0, 1.0, -900.0)};
    far.triangles = {{0, 1, 2}};
    return TriangleBvh(far);
  }();
  RadialFunction radial{ToolFamily::kCylinder, 8.0, Eigen::VectorXd::Constant(1, 1.5)};

  [[nodiscard]] AxisField field(const TiltCone& held) const {
    FloorChannel channel;
    channel.coarse = &coarse;
    PointOptions options;
    options.held = held;
    std::vector<std::optional<TipRoom::Rest>> places(kRows);
    for (int k = 0; k < kRows; ++k) {
      const double lean = k % 3 == 0 ? 1.3 : -0.9;
      places[static_cast<std::size_t>(k)] =
          TipRoom::Rest{Vec3(2.5 * k, 0.0, 0.0), Vec3(std::sin(lean), 0.0, std::cos(lean)), 0.0};
    }
    return {TipRoom(channel, radial, options), places, kRows, 1};
  }
};

TEST(AxisField, TurnsWithoutAJump) {
  const Floor floor;
  const AxisField field = floor.field({});
  constexpr double kStep = 0.02;  // rows
  double fastest = 0.0, jump = 0.0;
  for (double row = kStep; row + kStep < kRows - 1.0; row += kStep) {
    const Vec3 a = field.at(row - kStep, 0.0), b = field.at(row, 0.0), c = field.at(row + kStep, 0.0);
    fastest = std::max(fastest, (c - b).norm()), jump = std::max(jump, (c - 2.0 * b + a).norm());
  }
  EXPECT_GT(fastest, 1e-4) << "directions that are all alike prove nothing";
  EXPECT_LT(jump, 0.1 * fastest);
}

TEST(AxisField, StaysInTheConeBetweenNodes) {
  const Floor floor;
  const TiltCone held{Vec3(0.0, 0.0, -1.0), 1.9};
  const AxisField field = floor.field(held);
  for (double row = 0.0; row <= kRows - 1.0; row += 0.1) EXPECT_TRUE(held.holds(field.at(row, 0.0))) << row;
}

/// Those of the nodes are known to have room; between them nobody has looked.
TEST(AxisField, TheDirectionsAroundAPlaceAreThoseOfItsNodesTheNearestFirst) {
  const Floor floor;
  const AxisField field = floor.field({});
  for (const double row : {0.2, 3.7, 8.4}) {
    const auto around = field.around(row, 0.0);
    const double near = std::round(row), far = row < near ? near - 1.0 : near + 1.0;
    EXPECT_EQ(around[0], field.around(near, 0.0)[0]) << row;
    EXPECT_EQ(around[1], field.around(far, 0.0)[0]) << row;
    for (const Vec3& axis : around) EXPECT_NEAR(axis.norm(), 1.0, 1e-12);
  }
}

/// Beside a wall, with a wish that leans into it.
TEST(AxisField, APlacesOwnDirectionIsTheNearestToTheWishThatHasRoom) {
  Face wall = test::plane_face("F1", 40.0, 40.0);
  for (Vec3& pole : wall.surface.poles) pole = Vec3(3.0, pole.x() - 20.0, pole.z());
  const std::unique_ptr<Target> target = make_target({wall});
  const TriangleBvh coarse(tessellate(wall, {.chord_mm = 0.01}).mesh);
  FloorChannel channel;
  channel.walls = {target.get()};
  channel.coarse = &coarse;
  const RadialFunction radial{ToolFamily::kCylinder, 8.0, Eigen::VectorXd::Constant(1, 1.5)};
  const TipRoom room(channel, radial, {});
  const Vec3 wish = Vec3(0.5, 0.3, 0.8).normalized();
  const std::optional<Vec3> axis = AxisField::nearest_free(room, {Vec3(1.4, 0.0, 20.0), Vec3::UnitZ(), 0.0}, wish, 0.0);
  ASSERT_TRUE(axis);
  EXPECT_TRUE(room.is_free({Vec3(1.4, 0.0, 20.0), *axis}));
  EXPECT_FALSE(room.is_free({Vec3(1.4, 0.0, 20.0), wish}));
  EXPECT_LT(axis->x(), 0.02);
  EXPECT_GT(axis->y(), 0.0) << "on the wish's side of all that have room";
  EXPECT_GT(axis->dot(wish), 0.75);
  EXPECT_FALSE(AxisField::nearest_free(room, {Vec3(2.0, 0.0, 20.0), Vec3::UnitZ(), 0.0}, wish, 0.0))
      << "the tip itself enters the wall";
}

TEST(TiltCone, TheNearestDirectionIsOnItsRim) {
  const TiltCone cone{Vec3::UnitZ(), 1.9};
  EXPECT_EQ(cone.nearest(Vec3::UnitX()), Vec3::UnitX());
  const Vec3 below = Vec3(0.1, 0.0, -1.0).normalized(), rim = cone.nearest(below);
  EXPECT_NEAR(std::acos(rim.z()), 1.9, 1e-12);
  EXPECT_NEAR(rim.y(), 0.0, 1e-15);
  EXPECT_GT(rim.x(), 0.0);
  EXPECT_NEAR(cone.nearest(-Vec3::UnitZ()).norm(), 1.0, 1e-12);
}

}  // namespace
}  // namespace flank::internal
