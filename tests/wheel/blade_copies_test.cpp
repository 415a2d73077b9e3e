// A strip carried over to a side that stands a little elsewhere is as far from it as it was from its own.
#include "flank/wheel/blade_copies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

constexpr double kRadius = 2.0, kAxis = 10.0;

/// A hyperbolic paraboloid over 30 x 12 mm, standing upright; `move` displaces it.
Face side(const Eigen::Isometry3d& move) {
  Face face;
  BSplineSurface& s = face.surface;
  s.degree_u = s.degree_v = 1;
  s.count_u = s.count_v = 2;
  s.knots_u = s.knots_v = {0.0, 0.0, 1.0, 1.0};
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0, 1.0, 12), Vec3(30, 1.5, 0), Vec3(30, -1.0, 12)})
    s.poles.push_back(move * p);
  return face;
}

/// Upright poses whose lowest sphere touches the side.
Strip touching(const Target& target, double least_height) {
  Strip strip;
  for (int k = 2; k <= 28; ++k) {
    const Footpoint foot = target.closest(Vec3(k, 0.0, least_height));
    strip.poses.push_back({foot.point + kRadius * foot.normal, Vec3::UnitZ()});
  }
  return strip;
}

TEST(BladeCopies, AStripIsLedOntoASideThatDiffers) {
  WheelAxis axis;
  axis.point = Vec3(0.0, -60.0, 0.0), axis.direction = Vec3::UnitX();
  const double pitch = 0.4;
  const auto own = make_target({side(Eigen::Isometry3d::Identity())});
  Eigen::Isometry3d off = axis.turn(pitch);
  off.translate(Vec3(0.05, 0.2, 0.1));
  off.rotate(Eigen::AngleAxisd(0.004, Vec3(1, 1, 1).normalized()));
  const auto other = make_target({side(off)});
  EXPECT_GT(side_difference({own.get()}, {other.get()}, axis, pitch), 0.1);
  EXPECT_LT(side_difference({own.get()}, {own.get()}, axis, 0.0), 1e-9);
  const RadialFunction radial(ToolFamily::kCylinder, kAxis, Eigen::VectorXd::Constant(1, kRadius));
  const Strip strip = touching(*own, 1.0);
  const Strip there = carried_over(strip, radial, {own.get()}, {other.get()}, {}, axis, pitch);
  ASSERT_EQ(there.poses.size(), strip.poses.size());
  double most = 0.0;
  for (std::size_t k = 0; k < strip.poses.size(); ++k) {
    EXPECT_NEAR(there.poses[k].axis.norm(), 1.0, 1e-12);
    most = std::max(most,
                    std::abs(own->closest(strip.poses[k].tip).distance - other->closest(there.poses[k].tip).distance));
  }
  EXPECT_LT(most, 0.01) << "turned alone it is off by 0.2 mm";
}

}  // namespace
}  // namespace flank::internal
