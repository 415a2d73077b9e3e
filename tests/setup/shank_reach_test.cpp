#include "flank/setup/shank_reach.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

Tool cylinder(double radius, double length) {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, length, Eigen::VectorXd::Constant(1, radius));
  return tool;
}

Box3 box(const Vec3& low, const Vec3& high) {
  Box3 b;
  b.add(low);
  b.add(high);
  return b;
}

Path at(const Vec3& tip, const Vec3& axis) {
  Path path;
  path.strips.push_back({});
  path.strips[0].poses = {{tip, axis.normalized()}};
  return path;
}

const Box3 kPart = box({0, 0, 0}, {100, 60, 40});

TEST(ShankReach, IsTheWayOutOfThePart) {
  const Tool tool = cylinder(4.0, 20.0);
  // Upright in a pocket: the flank ends at z = 25, the part at 40, and a disc across the axis no higher; its ball is 3 mm larger.
  EXPECT_NEAR(shank_reach(tool, at({50, 30, 5}, Vec3::UnitZ()), kPart, 3.0), 18.0, 1e-9);
  // Across the part: the whole way.
  EXPECT_NEAR(shank_reach(tool, at({10, 30, 20}, Vec3::UnitX()), kPart, 3.0), 73.0, 1e-9);
  // Beside it, and above it.
  EXPECT_EQ(shank_reach(tool, at({50, 70, 20}, Vec3::UnitZ()), kPart, 3.0), 0.0);
  EXPECT_EQ(shank_reach(tool, at({50, 30, 30}, Vec3::UnitZ()), kPart, 3.0), 0.0);
  // Towards it from outside: until it has left on the other side.
  EXPECT_NEAR(shank_reach(tool, at({-40, 30, 20}, Vec3::UnitX()), kPart, 3.0), 123.0, 1e-9);
}

TEST(ShankReach, TakesTheLongestOfThePath) {
  Path path = at({50, 30, 15}, Vec3::UnitZ());
  path.strips[0].poses.push_back({Vec3(50, 30, 2), Vec3::UnitZ()});
  path.strips[0].poses.push_back({Vec3(50, 30, 10), Vec3::UnitZ()});
  EXPECT_NEAR(shank_reach(cylinder(4.0, 20.0), path, kPart, 3.0), 21.0, 1e-9);
}

TEST(StandardShank, IsNeverThickerAndAtMostATenthThinner) {
  EXPECT_EQ(standard_shank(8.0), 8.0);
  EXPECT_EQ(standard_shank(8.8), 8.0);
  EXPECT_EQ(standard_shank(7.9), std::nullopt);
  EXPECT_EQ(standard_shank(10.5), 10.0);
  EXPECT_EQ(standard_shank(2.9), std::nullopt);
}

TEST(ChosenShank, IsInWholeMillimetresAndNoShorterThanBefore) {
  ObstacleRequest request;
  choose_shank(cylinder(4.0, 20.0), at({50, 30, 5.4}, Vec3::UnitZ()), kPart, request);
  EXPECT_EQ(request.shank_radius_mm, 4.0);
  EXPECT_EQ(request.shank_length_mm, 19.0);
  choose_shank(cylinder(4.0, 20.0), at({50, 30, 25}, Vec3::UnitZ()), kPart, request);
  EXPECT_EQ(request.shank_length_mm, 19.0);
}

}  // namespace
}  // namespace flank::internal
