#include "flank/example/example_envelope.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/envelope.h"
#include "flank/error.h"
#include "flank/example.h"
#include "flank/example/example_motions.h"
#include "flank/example/example_tools.h"
#include "flank/target.h"

namespace flank::internal {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kDenseT = 7, kDenseS = 5;
constexpr double kAccuracy = 1e-7;
#else
constexpr int kDenseT = 47, kDenseS = 29;
constexpr double kAccuracy = 1e-9;
#endif

/// Parameters that are no grid points of the interpolation.
double off_grid(int i, int count) { return (i + 0.5) / count; }

class ExampleEnvelope : public ::testing::TestWithParam<std::tuple<const char*, int>> {
 protected:
  const RadialFunction radial = example_tool(std::get<0>(GetParam())).radial;
  const RuledMotion motion = std::get<1>(GetParam()) == 0
                                 ? facing_motion(radial.axis_length())
                                 : example_motion(std::get<1>(GetParam()), radial.axis_length());
};

TEST_P(ExampleEnvelope, IsWellInsideWhatExists) {
  const double length = radial.axis_length();
  EXPECT_TRUE(check_legitimacy(radial).legitimate);
  EXPECT_GE(length, 30.0);
  EXPECT_LE(length, 50.0);
  for (int j = 0; j <= 100; ++j) {
    EXPECT_GE(radial.at(length * j / 100.0).r, 3.0);
    EXPECT_LE(radial.at(length * j / 100.0).r, 10.0);
  }
  const Regularity found = regularity(motion, radial, 101, 41);
  EXPECT_EQ(found.failures, 0);
  EXPECT_LT(found.largest_c, 0.5);
  const double travel = (motion.pose(1.0).at(0.5 * length) - motion.pose(0.0).at(0.5 * length)).norm();
  EXPECT_GE(travel, 60.0);
  EXPECT_LE(travel, 100.0);
}

TEST_P(ExampleEnvelope, FaceIsTheEnvelope) {
  const EnvelopeFace made = envelope_face(motion, radial, kAccuracy);
  EXPECT_LE(made.error_mm, kAccuracy * made.diagonal_mm);
  const double length = radial.axis_length();
  double worst = 0.0;
  for (int i = 0; i < kDenseT; ++i) {
    for (int j = 0; j < kDenseS; ++j) {
      const double t = off_grid(i, kDenseT), s = length * off_grid(j, kDenseS);
      const SurfaceJet jet = made.face.surface.jet(t, s / length);
      const Vec3 centre = motion.pose(t).at(s), normal = jet.du.cross(jet.dv).normalized();
      worst = std::max(worst, std::abs((jet.p - centre).norm() - radial.at(s).r));
      // The outward normal is the machining side: from the face to the axis.
      EXPECT_GT(normal.dot((centre - jet.p).normalized()), 1.0 - 1e-6);
    }
  }
  EXPECT_LE(worst, kAccuracy * made.diagonal_mm);
  EXPECT_FALSE(made.face.reversed);
  EXPECT_FALSE(made.face.of_solid);
}

TEST_P(ExampleEnvelope, AxisPointsLieTheRadiusAwayFromTheFace) {
  // The closest point of the whole face: no other part of it may come nearer than r(s).
  const EnvelopeFace made = envelope_face(motion, radial, kAccuracy);
  const auto target = make_target({made.face});
  double worst = 0.0;
  for (int i = 0; i < kDenseT; ++i) {
    for (int j = 0; j < kDenseS; ++j) {
      const double s = radial.axis_length() * off_grid(j, kDenseS);
      const Footpoint foot = target->closest(motion.pose(off_grid(i, kDenseT)).at(s));
      worst = std::max(worst, std::abs(foot.distance - radial.at(s).r));
    }
  }
  EXPECT_LE(worst, kAccuracy * made.diagonal_mm);
}

INSTANTIATE_TEST_SUITE_P(All, ExampleEnvelope,
                         ::testing::Combine(::testing::Values("barrel", "hyperbolic", "cone", "spline"),
                                            ::testing::Values(0, 1, 2, 3)));

TEST(ExampleEnvelopeFace, RefusesAMotionThatPlunges) {
  RuledMotion motion = example_motion(1, 50.0);
  motion.tip.poles.row(0) *= 0.01;
  motion.tip.poles.row(1).setZero();
  motion.tip.poles.row(2) << 0, -20, -40, -60;
  motion.direction.poles.colwise() = Vec3(0, 0, 1);
  EXPECT_THROW((void)envelope_face(motion, example_tool("cone").radial, 1e-6), InternalError);
}

TEST(WithBump, RaisesTheMiddleAndLeavesTheBorder) {
  const EnvelopeFace made = envelope_face(example_motion(1, 40.0), example_tool("barrel").radial, 1e-7);
  const BSplineSurface& plain = made.face.surface;
  const BSplineSurface bumped = with_bump(plain, 0.8);
  const SurfaceJet middle = plain.jet(0.5, 0.5);
  const Vec3 normal = middle.du.cross(middle.dv).normalized();
  EXPECT_LT((bumped.value(0.5, 0.5) - (middle.p + 0.8 * normal)).norm(), 1e-5);
  for (const double x : {0.0, 0.3, 1.0}) {
    EXPECT_LT((bumped.value(x, 0.02) - plain.value(x, 0.02)).norm(), 1e-5);
    EXPECT_LT((bumped.value(0.97, x) - plain.value(0.97, x)).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace flank::internal
