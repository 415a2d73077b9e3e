// The surfaces of a strip are those of its motion, from its first pose to its last.
#include "flank/envelope/strip_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/envelope.h"
#include "flank/example/example_motions.h"
#include "flank/example/example_tools.h"

namespace flank::internal {
namespace {

constexpr int kCount = 37;  ///< places a direction, prime to the grids

double share(int i) { return (i + 0.37) / kCount; }

class StripSurfaces : public ::testing::TestWithParam<int> {
 protected:
  const RadialFunction radial = example_tool("barrel").radial;
  const StripMotion strip{7, example_motion(std::abs(GetParam()), radial.axis_length()), 0.125, 0.8,
                          GetParam() > 0 ? +1 : -1};
  const StripSurface made = strip_surface(strip, radial);

  [[nodiscard]] double t(double u) const { return strip.from_t + (strip.to_t - strip.from_t) * u; }
};

TEST_P(StripSurfaces, KeepTheirPromiseBetweenTheirPoints) {
  EXPECT_EQ(made.name, "strip 7");
  EXPECT_EQ(made.plunging, 0);
  EXPECT_LE(made.envelope_deviation_mm, kStripSurfaceMm);
  EXPECT_LE(made.axis_deviation_mm, kStripSurfaceMm);
  double envelope = 0.0, axis = 0.0, radius = 0.0;
  for (int i = 0; i < kCount; ++i) {
    for (int j = 0; j < kCount; ++j) {
      const double s = radial.axis_length() * share(j);
      const ContactPoint contact = contact_point(strip.motion, radial, s, t(share(i)), strip.side);
      const Vec3 center = strip.motion.pose(t(share(i))).at(s);
      envelope = std::max(envelope, (made.envelope.value(share(i), share(j)) - contact.point).norm());
      axis = std::max(axis, (made.axis.value(share(i), share(j)) - center).norm());
      radius = std::max(radius, std::abs((made.envelope.value(share(i), share(j)) - center).norm() - radial.at(s).r));
    }
  }
  EXPECT_LE(envelope, kStripSurfaceMm);
  EXPECT_LE(axis, kStripSurfaceMm);
  EXPECT_LE(radius, kStripSurfaceMm);
}

/// What a fit gives: rails and radial function with knots, across which the envelope has a jump of curvature.
TEST(StripSurface, NeedsFewPointsAtKnots) {
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k <= 60; ++k) {
    t.push_back(k / 60.0);
    const double a = 4.0 * t.back();
    poses.push_back({Vec3(20.0 * a, 6.0 * std::sin(1.7 * a), 2.0 * std::cos(2.3 * a)),
                     Vec3(0.3 * std::sin(a), 0.2 * std::cos(2.1 * a), 1.0).normalized()});
  }
  Eigen::VectorXd c(9);
  c << 3.0, 3.2, 3.1, 2.8, 2.9, 3.4, 3.9, 4.0, 3.7;
  const RadialFunction radial = RadialFunction::spline(25.0, c);
  const RuledMotion motion = fit_motion(poses, t, 25.0, 11);
  ASSERT_LT(regularity(motion, radial, 100, 40).largest_c, 0.9);
  const StripSurface made = strip_surface({1, motion, 0.03, 0.97, -1}, radial);
  EXPECT_LE(made.envelope_deviation_mm, 0.5 * kStripSurfaceMm);
  EXPECT_LE(made.axis_deviation_mm, 0.5 * kStripSurfaceMm);
  EXPECT_LT(made.envelope.count_u, 150);
  EXPECT_LT(made.envelope.count_v, 80);
}

TEST_P(StripSurfaces, NormalsLookToTheTool) {
  const SurfaceJet jet = made.envelope.jet(0.4, 0.6);
  const Vec3 center = strip.motion.pose(t(0.4)).at(0.6 * radial.axis_length());
  EXPECT_EQ(jet.du.cross(jet.dv).dot(center - jet.p) > 0.0, made.towards_tool);
}

INSTANTIATE_TEST_SUITE_P(Motions, StripSurfaces, ::testing::Values(1, -1, 2, -2, 3));

TEST(StripSurface, SaysWhereTheToolPlunges) {
  // Along its own axis: no sphere of a tool that grows has a contact.
  Eigen::Matrix3Xd tips(3, 4), directions(3, 4);
  for (int k = 0; k < 4; ++k) {
    tips.col(k) = Vec3(0.0, 0.0, 10.0 * k);
    directions.col(k) = Vec3::UnitZ();
  }
  RuledMotion motion;
  motion.axis_length = 20.0;
  motion.tip = motion.direction = fit_curve(tips, {0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0}, 3, 4);
  motion.direction.poles = directions;
  const RadialFunction cone(ToolFamily::kCone, 20.0, Eigen::Vector2d(3.0, 0.1));
  const StripSurface made = strip_surface({1, motion, 0.0, 1.0, +1}, cone);
  EXPECT_GT(made.plunging, 0);
  std::vector<std::string> notes;
  note_strip_surfaces({made}, notes);
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes.front().find("plunges"), std::string::npos);
}

}  // namespace
}  // namespace flank::internal
