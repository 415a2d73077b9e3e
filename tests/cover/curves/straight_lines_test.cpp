// Lines through curves: the best in the sense of least squares, measured, and rejected for a reason.
#include "flank/cover/curves/straight_lines.h"

#include <gtest/gtest.h>

#include "cover/cover_targets.h"
#include "flank/base/random.h"

namespace flank::internal {
namespace {

double sum_of_squares(const IntegralCurve& curve, const Pose& pose) {
  double sum = 0.0;
  for (std::size_t k = 0; k < curve.s.size(); ++k) sum += (curve.centres[k] - pose.at(curve.s[k])).squaredNorm();
  return sum;
}

IntegralCurve curve_of(const Pose& pose, double first, double last, double noise) {
  Random random(3);
  IntegralCurve curve;
  for (int k = 0; k <= 12; ++k) {
    curve.s.push_back(first + (last - first) * k / 12.0);
    curve.centres.push_back(pose.at(curve.s.back()) + noise * Vec3(random.normal(), random.normal(), random.normal()));
  }
  return curve;
}

TEST(LineThrough, IsTheLineItself) {
  const Pose pose{Vec3(1.0, -2.0, 3.0), Vec3(1.0, 2.0, -0.5).normalized()};
  const Pose found = line_through(curve_of(pose, 4.0, 18.0, 0.0));
  EXPECT_LE((found.tip - pose.tip).norm(), 1e-12);
  EXPECT_LE((found.axis - pose.axis).norm(), 1e-12);
}

TEST(LineThrough, HasTheLeastSquares) {
  const Pose pose{Vec3(1.0, -2.0, 3.0), Vec3(1.0, 2.0, -0.5).normalized()};
  const IntegralCurve curve = curve_of(pose, 4.0, 18.0, 0.3);
  const Pose best = line_through(curve);
  const double least = sum_of_squares(curve, best);
  Random random(7);
  for (int k = 0; k < 200; ++k) {
    const Vec3 shift(random.normal(), random.normal(), random.normal());
    const Vec3 turn(random.normal(), random.normal(), random.normal());
    const double size = std::pow(10.0, -random.uniform(1.0, 5.0));
    const Pose other{best.tip + size * shift, (best.axis + 0.1 * size * turn).normalized()};
    EXPECT_GE(sum_of_squares(curve, other), least);
  }
}

TEST(StraightLine, IsRejectedForAReason) {
  const testing::LongSurface surface;
  const double length = surface.tool.axis_length();
  LineFitter fitter(*surface.exact.target, surface.tool, {.tolerance_mm = 1e-3});
  StraightLineOptions options;
  options.most_error_mm = 1e-3;
  const Pose pose = surface.pose(0.5);
  const auto line = straight_line(curve_of(pose, 0.0, length, 0.0), fitter, PoseGuard(), options);
  ASSERT_TRUE(line.has_value());
  EXPECT_LE(line->error_mm, 1e-4);
  // It can move on the way that the envelope was made, up to the slide along itself.
  const AxisJet jet = surface.exact.motion.jet(0.5);
  const Vec3 velocity = jet.velocity(surface.first + 0.5 * length);
  const Vec3 across = (velocity - velocity.dot(jet.u) * jet.u).normalized();
  EXPECT_GE(std::abs(across.dot(line->velocity.middle)), 0.99);
  EXPECT_FALSE(straight_line(curve_of(pose, 0.0, 0.4 * length, 0.0), fitter, PoseGuard(), options)) << "too short";
  const Pose off{pose.tip + Vec3(0.0, 0.01, 0.0), pose.axis};
  EXPECT_FALSE(straight_line(curve_of(off, 0.0, length, 0.0), fitter, PoseGuard(), options)) << "too far off";
  options.refine = true;
  const auto refined = straight_line(curve_of(off, 0.0, length, 0.0), fitter, PoseGuard(), options);
  ASSERT_TRUE(refined.has_value());
  EXPECT_LE(refined->error_mm, 1e-3);
}

TEST(StraightLine, SlidesClearOfAWall) {
  const auto target = testing::flat_target(0.0, 50.0, 0.0, 30.0);
  const Obstacles obstacles = testing::wall_at(30.0);
  const Tool tool = testing::cylinder(4.0, 16.0);
  const PoseGuard guard(tool, obstacles, 0.0);
  LineFitter fitter(*target, tool.radial, {.tolerance_mm = 0.01});
  StraightLineOptions options;
  options.most_error_mm = 0.01;
  const Pose pose{Vec3(25.0, 12.0, 4.0), Vec3::UnitY()};  // its end would be at y = 28 + 4
  const auto line = straight_line(curve_of(pose, 0.0, 16.0, 0.0), fitter, guard, options);
  ASSERT_TRUE(line.has_value());
  EXPECT_TRUE(guard.clear(line->pose));
  EXPECT_LE(line->pose.at(16.0).y(), 26.0 + 1e-9);
  EXPECT_GE(line->pose.at(16.0).y(), 24.0);
}

}  // namespace
}  // namespace flank::internal
