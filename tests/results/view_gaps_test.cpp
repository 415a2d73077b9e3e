#include "flank/results/view_gaps.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

/// A cylinder of radius 3, 20 mm long, with a holder of radius 10 from z = 30 to 50.
Tool held_cylinder() {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 3.0));
  tool.holder = {{30.0, 10.0}, {50.0, 10.0}};
  return tool;
}

std::vector<double> gaps(const std::vector<Vec3>& points, const std::vector<Pose>& poses, ToolBodies bodies) {
  ViewFace face;
  face.mesh.vertices = points;
  measure_gaps(held_cylinder(), poses, bodies, {&face});
  return face.gap_mm;
}

TEST(ViewGaps, AreThoseBesideCylindersAndTheirTips) {
  const Pose upright{Vec3::Zero(), Vec3::UnitZ()};
  const std::vector<Vec3> points{{5, 0, 10}, {0, 1, 10}, {0, 14, 40}, {8, 0, 35}, {0, 0, 56}, {0, 0, -4}};
  const std::vector<double> all = gaps(points, {upright}, ToolBodies::kAll);
  const double expected[] = {2.0, -2.0, 4.0, -2.0, 6.0, 1.0};
  ASSERT_EQ(all.size(), points.size());
  for (std::size_t k = 0; k < all.size(); ++k) EXPECT_NEAR(all[k], expected[k], 1e-9) << k;
  const std::vector<double> above = gaps(points, {upright}, ToolBodies::kAboveTheFlank);
  EXPECT_NEAR(above[0], 20.0, 1e-9) << "the flank is not asked";
  EXPECT_NEAR(above[3], -2.0, 1e-9);
}

TEST(ViewGaps, TheNearestPoseCountsWhicheverWayTheToolLies) {
  const Pose upright{Vec3::Zero(), Vec3::UnitZ()};
  const Pose lying{Vec3(100, 0, 0), Vec3::UnitX()};
  const std::vector<double> both = gaps({{140, 0, 4}, {4, 0, 10}}, {upright, lying}, ToolBodies::kAll);
  EXPECT_NEAR(both[0], -6.0, 1e-9);
  EXPECT_NEAR(both[1], 1.0, 1e-9);
}

TEST(ViewGaps, WithoutPosesNothingIsSaid) { EXPECT_TRUE(gaps({{0, 0, 0}}, {}, ToolBodies::kAll).empty()); }

}  // namespace
}  // namespace flank::internal
