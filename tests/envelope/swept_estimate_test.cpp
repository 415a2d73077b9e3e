// The planner's swept distance against closed forms and dense search: there is always a nearest place, whatever the
// radial function.
#include "flank/envelope/swept_estimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/base/random.h"
#include "motion/sample_motions.h"
#include "sanitized.h"
#include "seed/exact_targets.h"

namespace flank::internal {
namespace {

const RadialFunction& bumpy() {
  static const RadialFunction radial =
      RadialFunction::spline(40.0, (Eigen::VectorXd(8) << 3.0, 3.3, 4.1, 4.6, 4.2, 3.9, 4.8, 5.4).finished());
  return radial;
}

/// min over t and s of |x - R(s, t)| - r(s) on a dense grid, and a little less than what it can miss.
double dense(const RuledMotion& motion, const RadialFunction& radial, const Vec3& x, int steps = 300) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i) {
    const Pose pose = motion.pose(static_cast<double>(i) / steps);
    for (int j = 0; j <= steps / 2; ++j) {
      const double s = radial.axis_length() * j / (steps / 2);
      least = std::min(least, (x - pose.at(s)).norm() - radial.at(s).r);
    }
  }
  return least;
}

/// A place of the first motion.
SweptContact at_time(double t) {
  SweptContact place;
  place.motion = 0;
  place.t = t;
  return place;
}

std::vector<Vec3> points_near(const RuledMotion& motion, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k)
    points.push_back(motion.pose(random.uniform()).at(random.uniform(-5.0, 45.0)) +
                     7.0 * Vec3(random.normal(), random.normal(), random.normal()));
  return points;
}

TEST(SweptEstimate, OfACylinderMovedSidewaysIsTheDistanceToItsSlab) {
  const RuledMotion motion = testing::translation({0, 0, 0}, {60, 0, 0}, {0, 0, 1}, 40.0);
  const RadialFunction cylinder(ToolFamily::kCylinder, 40.0, Eigen::VectorXd::Constant(1, 4.0));
  const SweptEstimate swept({motion}, cylinder, 121);
  EXPECT_NEAR(swept.spacing(), 1.0 / 120.0, 1e-15);
  for (const Vec3& x : points_near(motion, 300, 1)) {
    const Vec3 nearest(std::clamp(x[0], 0.0, 60.0), 0.0, std::clamp(x[2], 0.0, 40.0));
    const double f = (x - nearest).norm() - 4.0;
    // Poses are half a millimetre apart; the parabola is exact where the distance is large beside that.
    if (f > -2.0) {
      EXPECT_NEAR(swept.distance(x), f, 1e-3) << x.transpose();
    }
    const SweptContact exact = swept.refine(x, at_time(std::clamp(x[0] / 60.0, 0.0, 1.0)));
    if (f > -3.9) {
      EXPECT_NEAR(exact.f, f, 1e-8) << x.transpose();
    }
  }
}

TEST(SweptEstimate, IsThatOfDenseSearch) {
  const RuledMotion motion = testing::random_motion(3);
  const SweptEstimate swept({motion}, bumpy(), 161);
  for (const Vec3& x : points_near(motion, 12, 2)) {
    const double expected = dense(motion, bumpy(), x);
    const SweptContact estimate = swept.nearest(x), exact = swept.refine(x, estimate);
    EXPECT_NEAR(estimate.f, expected, 0.02) << x.transpose();
    EXPECT_LE(exact.f, expected + 1e-9) << "the least of all, not of a grid";
    EXPECT_GT(exact.f, expected - 0.02);
    // The contact is what it says: a distance to an axis point less its radius, and the way there.
    const Vec3 axis_point = motion.pose(exact.t).at(exact.s);
    EXPECT_NEAR((x - axis_point).norm() - bumpy().at(exact.s).r, exact.f, 1e-9);
    EXPECT_LT((exact.to_axis - (axis_point - x).normalized()).norm(), 1e-9);
  }
}

/// A profile that flares at its end, as past a face where nothing holds it: beside the flank its last sphere is nearest, and the
/// one that touches beside the point is near, too.
TEST(SweptEstimate, SeesTheFlareAtAnEnd) {
  const RadialFunction flared = RadialFunction::spline(
      40.0, (Eigen::VectorXd(14) << 4.8, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.2, 6.6, 8.4).finished());
  const RuledMotion motion = testing::translation({0, 0, 0}, {60, 0, 0}, {0, 0, 1}, 40.0);
  const SweptEstimate swept({motion}, flared, 121);
  int second = 0;  // places where the spheres beside the point are not the nearest
  const int points = kSanitized ? 20 : 400;
  Random random(11);
  for (int k = 0; k < points; ++k) {
    const Vec3 x(random.uniform(10.0, 50.0), random.uniform(4.8, 6.5), random.uniform(24.0, 40.0));
    const double expected = dense(motion, flared, x, 600);
    const SweptContact estimate = swept.nearest(x), exact = swept.refine(x, estimate);
    EXPECT_NEAR(estimate.f, expected, 0.02) << x.transpose();
    EXPECT_LE(exact.f, expected + 1e-9) << x.transpose();
    second += x.z() < 38.0 && exact.s == 40.0 ? 1 : 0;
  }
  EXPECT_GT(second, points / 20);
}

TEST(SweptEstimate, ItsGradientIsTheWayFromTheAxis) {
  const RuledMotion motion = testing::random_motion(4);
  constexpr double h = 1e-4;
  for (const Vec3& x : points_near(motion, 20, 3)) {
    const SweptEstimate swept({motion}, bumpy(), 161);
    const SweptContact near = swept.nearest(x), at = swept.refine(x, near);
    if (at.f < -2.0 || at.t < 0.01 || at.t > 0.99) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const double ahead = swept.refine(x + h * Vec3::Unit(axis), near).f;
      const double behind = swept.refine(x - h * Vec3::Unit(axis), near).f;
      EXPECT_NEAR((ahead - behind) / (2 * h), -at.to_axis[axis], 1e-4);
    }
  }
}

TEST(SweptEstimate, OfSeveralMotionsIsTheLeastOfEach) {
  const std::vector<RuledMotion> motions{testing::random_motion(5), testing::random_motion(6)};
  const SweptEstimate both(motions, bumpy(), 81), first({motions[0]}, bumpy(), 81), second({motions[1]}, bumpy(), 81);
  std::vector<SweptContact> places;
  for (const Vec3& x : points_near(motions[0], 15, 4)) {
    const SweptContact found = both.nearest(x);
    EXPECT_EQ(found.f, std::min(first.distance(x), second.distance(x)));
    EXPECT_EQ(found.motion, first.distance(x) <= second.distance(x) ? 0 : 1);
    both.places(x, SweptContact{}, places);
    double least = std::numeric_limits<double>::infinity();
    for (const SweptContact& place : places) least = std::min(least, both.refine(x, place).f);
    const double expected = std::min(dense(motions[0], bumpy(), x, 100), dense(motions[1], bumpy(), x, 100));
    EXPECT_LE(least, expected + 1e-9) << "the least f is reached from one of the places";
  }
}

/// A disc that is hardly longer than its flank is steep: the sphere that touches a point is far from the foot of the point on the axis.
TEST(SweptEstimate, OfASteepDiscIsThatOfDenseSearch) {
  const RadialFunction disc = RadialFunction::spline(
      4.3, (Eigen::VectorXd(10) << 4.7, 4.95, 5.2, 5.4, 5.6, 5.75, 5.85, 5.95, 6.0, 6.05).finished());
  const RuledMotion motion = testing::translation({0, 0, 0}, {40, 0, 0}, {0.2, 0, 1}, 4.3);
  const SweptEstimate swept({motion}, disc, 160);
  Random random(5);
  const int points = kSanitized ? 10 : 100;
  for (int k = 0; k < points; ++k) {
    const double z = random.uniform(0.0, 4.3), y = disc.at(z).r + random.uniform(-0.1, 0.3);
    const Vec3 x(random.uniform(5.0, 35.0), y, z);
    // A sphere that is not the nearest one would leave material where there is none.
    EXPECT_LT(swept.distance(x), dense(motion, disc, x, 600) + 0.004) << x.transpose();
  }
}

/// Whatever the hint: of a neighbour, of a place far away, of another motion, or without a value.
TEST(SweptEstimate, AHintChangesNothing) {
  const std::vector<RuledMotion> motions{testing::random_motion(5), testing::random_motion(6)};
  const SweptEstimate swept(motions, bumpy(), 81);
  SweptContact before, far, lost;
  far.motion = 1;
  far.t = 1.0;
  lost.motion = 0;
  lost.t = 7.0;
  for (const Vec3& x : points_near(motions[0], 60, 9)) {
    const SweptContact alone = swept.nearest(x);
    for (const SweptContact& hint : {before, far, lost}) {
      const SweptContact found = swept.nearest(x, hint);
      EXPECT_EQ(found.f, alone.f);
      EXPECT_EQ(found.motion, alone.motion);
      EXPECT_EQ(found.t, alone.t);
    }
    before = alone;
  }
}

TEST(SweptEstimate, FindsPlacesForARadialFunctionThatIsNoTool) {
  // A barrel on an axis that is too long for it: r < 0 at both ends.
  const std::vector<RuledMotion> motions{testing::straight_motion(80.0)};
  const RadialFunction radial = RadialFunction::spline(80.0, (Eigen::VectorXd(6) << -2, 1, 4, 4, 1, -2).finished());
  ASSERT_LT(radial.at(0.0).r, 0.0);
  const SweptEstimate swept(motions, radial, 60);
  std::vector<SweptContact> places;
  for (int k = 0; k <= 20; ++k) {
    const Vec3 x(3.0 * k, 6.0, 4.0 * k);
    swept.places(x, SweptContact{}, places);
    EXPECT_FALSE(places.empty()) << k;
    EXPECT_EQ(swept.nearest(x).motion, 0);
  }
}

TEST(SweptEstimate, FindsPlacesForARadialFunctionSteeperThanAnyTool) {
  // The swept distance is no longer 1-Lipschitz, and poses that are jumped over may be the near ones.
  const std::vector<RuledMotion> motions{testing::translation({0, 0, 0}, {60, 20, 0}, {0, 0.2, 1}, 60.0)};
  const RadialFunction radial =
      RadialFunction::spline(60.0, (Eigen::VectorXd(12) << 28, 42, 31, 39, 29, 40, 32, 38, 30, 41, 28, 43).finished());
  double steepest = 0.0;
  for (int j = 0; j <= 200; ++j) steepest = std::max(steepest, std::abs(radial.at(0.3 * j).d1));
  ASSERT_GT(steepest, 1.5);
  const SweptEstimate swept(motions, radial, 192);
  Random random(0);
  std::vector<SweptContact> places;
  for (int k = 0; k < 3000; ++k) {
    const Vec3 x(random.uniform(-40, 100), random.uniform(-40, 80), random.uniform(-20, 80));
    for (const int hinted : {-1, 0}) {
      SweptContact hint;
      hint.motion = hinted;
      hint.t = random.uniform();
      swept.places(x, hint, places);
      ASSERT_FALSE(places.empty()) << x.transpose();
      EXPECT_EQ(places.front().motion, 0);
      EXPECT_TRUE(std::isfinite(places.front().f));
    }
  }
}

TEST(SweptEstimate, HasNoPlacesWhereNothingHasAValue) {
  RuledMotion motion = testing::translation({0, 0, 0}, {60, 20, 0}, {0, 0.2, 1}, 60.0);
  motion.tip.poles.setConstant(std::numeric_limits<double>::quiet_NaN());
  const SweptEstimate swept({motion}, RadialFunction(ToolFamily::kCylinder, 60.0, Eigen::VectorXd::Constant(1, 4.0)),
                            60);
  std::vector<SweptContact> places(3);
  swept.places(Vec3(1, 2, 3), SweptContact{}, places);
  EXPECT_TRUE(places.empty());
  EXPECT_EQ(swept.refine(Vec3(1, 2, 3), at_time(0.5)).f, std::numeric_limits<double>::infinity());
}

TEST(SweptEstimate, AProfileWithoutValuesHasNoDistance) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const RuledMotion motion = testing::translation({0, 0, 0}, {60, 20, 0}, {0, 0.2, 1}, 40.0);
  const SweptEstimate swept({motion}, RadialFunction::spline(40.0, Eigen::VectorXd::Constant(8, kNone)), 60);
  for (const double t : {0.0, 0.5, 1.0, kNone}) EXPECT_FALSE(std::isfinite(swept.refine(Vec3(1, 2, 3), at_time(t)).f));
}

}  // namespace
}  // namespace flank::internal
