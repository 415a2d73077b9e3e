// What stock of even thickness engages, against closed forms.
#include "flank/verify/finish_arcs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/error.h"
#include "flank/threads.h"

namespace flank::internal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0, kRadius = 5.0, kThickness = 0.2;

RadialFunction cylinder(double length) {
  return {ToolFamily::kCylinder, length, Eigen::VectorXd::Constant(1, kRadius)};
}

/// A wall from x = -20 to 20 and z = 0 to 10, of radius `bend` about an axis along Z (0: plane), the tool's side at y < 0.
FaceSamples wall(double bend) {
  FaceSamples face;
  face.face = "F1", face.target = true;
  face.spacing_mm = 0.2;
  for (double x = -20.0; x <= 20.0; x += 0.25)
    for (double z = 0.0; z <= 10.0; z += 0.25) {
      const double angle = bend > 0.0 ? x / bend : 0.0;
      // The centre of the bend is on the tool's side.
      face.points.push_back(bend > 0.0 ? Vec3(bend * std::sin(angle), bend * (std::cos(angle) - 1.0), z)
                                       : Vec3(x, 0.0, z));
      face.normals.emplace_back(-std::sin(angle), -std::cos(angle), 0.0);
      face.areas.push_back(0.0625);
    }
  return face;
}

Strip along(double bend) {
  Strip strip;
  for (int k = -10; k <= 10; ++k) {
    const double angle = bend > 0.0 ? k / bend : 0.0, way = bend - kRadius;
    const Vec3 tip =
        bend > 0.0 ? Vec3(way * std::sin(angle), way * std::cos(angle) - bend, -5.0) : Vec3(k, -kRadius, -5.0);
    strip.poses.push_back({tip, Vec3::UnitZ()});
  }
  return strip;
}

TEST(FinishArcs, OnAPlaneWallAreThoseOfSideMilling) {
  const PathArcs arcs = finish_arcs(cylinder(20.0), {{along(0.0)}}, {wall(0.0)}, kThickness, 9);
  const double closed = std::acos(1.0 - kThickness / kRadius);
  for (const std::vector<EngagedArc>& pose : arcs.strips[0]) {
    // The face is from 5 to 15 mm above the tip.
    ASSERT_EQ(pose.size(), 5u);
    for (std::size_t k = 0; k < pose.size(); ++k) {
      EXPECT_EQ(pose[k].ring, static_cast<int>(k) + 2);
      // It goes along x, and y is on its left.
      EXPECT_NEAR(pose[k].to, 90.0 * kDegree, 1e-9);
      EXPECT_NEAR(pose[k].angle(), closed, 0.002 * closed);
    }
  }
}

TEST(FinishArcs, InAHollowWallAreLonger) {
  const double bend = 25.0;
  const PathArcs arcs = finish_arcs(cylinder(20.0), {{along(bend)}}, {wall(bend)}, kThickness, 9);
  // A circle inside of a circle: where it is as far from the wall as the stock is thick.
  const double way = bend - kRadius, inner = bend - kThickness,
               closed = std::acos((inner * inner - way * way - kRadius * kRadius) / (2.0 * way * kRadius));
  for (std::size_t k = 5; k < 16; ++k) {
    ASSERT_EQ(arcs.strips[0][k].size(), 5u);
    EXPECT_NEAR(arcs.strips[0][k][2].angle(), closed, 0.01 * closed);
  }
}

TEST(FinishArcs, AreNoneWhereNoTargetIs) {
  FaceSamples check = wall(0.0);
  check.target = false;
  const PathArcs of_check = finish_arcs(cylinder(20.0), {{along(0.0)}}, {check}, kThickness);
  for (const auto& pose : of_check.strips[0]) EXPECT_TRUE(pose.empty());
  Strip away = along(0.0);
  for (Pose& pose : away.poses) pose.tip.y() -= 0.3;
  const PathArcs of_air = finish_arcs(cylinder(20.0), {{away}}, {wall(0.0)}, kThickness);
  for (const auto& pose : of_air.strips[0]) EXPECT_TRUE(pose.empty());
  EXPECT_THROW((void)finish_arcs(cylinder(20.0), {{away}}, {wall(0.0)}, 0.0), UsageError);
}

}  // namespace
}  // namespace flank::internal
