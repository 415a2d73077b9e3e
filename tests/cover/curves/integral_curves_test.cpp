// Integral curves follow the axes of exact envelopes, are straight on planes and along rulings, and end where they should.
#include "flank/cover/curves/integral_curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cover/cover_targets.h"
#include "flank/cover/curves/straight_lines.h"

namespace flank::internal {
namespace {

IntegralCurveOptions options_for(double length, double tolerance_mm = 1e-3) {
  IntegralCurveOptions options;
  options.filter = {tolerance_mm, length, 3.0};
  return options;
}

/// The sphere of (s, t) of an exact envelope, with the admissible direction nearest to the true axis.
CurveSeed seed_at(const testing::ExactTarget& exact, const Pose& pose, const RadialFunction& radial, double s,
                  const IntegralCurveOptions& options) {
  CurveSeed seed;
  seed.foot = exact.target->closest(pose.at(s));
  seed.s = s;
  double nearest = -2.0;
  const CandidateDirections found = candidate_directions(seed.foot, radial.at(s), options.filter);
  for (const Vec3& direction : found.all()) {
    if (direction.dot(pose.axis) <= nearest) continue;
    nearest = direction.dot(pose.axis);
    seed.direction = direction;
  }
  return seed;
}

double largest_distance(const IntegralCurve& curve, const Pose& pose) {
  double largest = 0.0;
  for (std::size_t k = 0; k < curve.s.size(); ++k)
    largest = std::max(largest, (curve.centres[k] - pose.at(curve.s[k])).norm());
  return largest;
}

TEST(IntegralCurve, FollowsTheAxisOfAnExactEnvelope) {
  const testing::LongSurface surface;
  const double length = surface.tool.axis_length();
  IntegralCurveOptions options = options_for(length);
  for (const double t : {0.2, 0.5, 0.8}) {
    for (const double s : {3.0, 12.0, 20.0}) {
      const Pose pose = surface.pose(t);
      const CurveSeed seed = seed_at(surface.exact, pose, surface.tool, s, options);
      std::array<double, 2> error{};
      for (const int round : {0, 1}) {
        options.steps = round == 0 ? 8 : 32;
        const IntegralCurve curve = integral_curve(*surface.exact.target, surface.tool, seed, options);
        EXPECT_EQ(curve.tip, CurveEnd::kToolEnd) << "t " << t << " s " << s;
        EXPECT_EQ(curve.holder, CurveEnd::kToolEnd) << "t " << t << " s " << s;
        EXPECT_NEAR(curve.span(), length, 1e-9);
        error[static_cast<std::size_t>(round)] = largest_distance(curve, pose);
      }
      EXPECT_LE(error[0], 1e-6) << "t " << t << " s " << s;
      EXPECT_LE(error[1], 2e-7) << "t " << t << " s " << s;
    }
  }
}

TEST(IntegralCurve, ErrorIsOfSecondOrderWhereItBends) {
  const Example blade = make_example("twisted-blade");
  const auto target = make_target(blade.faces);
  const RadialFunction cylinder = testing::cylinder(5.0, 20.0).radial;
  IntegralCurveOptions options = options_for(20.0);
  options.straightness_rad = 1.0;
  std::array<double, 2> error{};
  int counted = 0;
  for (const CurveSeed& seed : curve_seeds(*target, cylinder, 60, 1, options.filter)) {
    std::array<IntegralCurve, 3> curves;
    for (const std::size_t k : {0u, 1u, 2u}) {
      options.steps = k == 2 ? 512 : k == 1 ? 16 : 8;
      curves[k] = integral_curve(*target, cylinder, seed, options);
    }
    if (std::any_of(curves.begin(), curves.end(), [](const IntegralCurve& c) { return c.span() < 19.999; })) continue;
    ++counted;
    for (const std::size_t k : {0u, 1u})
      error[k] += (curves[k].centres.front() - curves[2].centres.front()).norm() +
                  (curves[k].centres.back() - curves[2].centres.back()).norm();
  }
  ASSERT_GE(counted, 20);
  EXPECT_GE(error[0], 3.0 * error[1]);
}

TEST(IntegralCurve, KeepsTheDistanceAllAlong) {
  // A barrel whose radii all occur twice: r(s) = h has two answers, s has none to give.
  const testing::LongSurface surface;
  const IntegralCurveOptions options = options_for(surface.tool.axis_length());
  const CurveSeed seed = seed_at(surface.exact, surface.pose(0.4), surface.tool, 9.0, options);
  const IntegralCurve curve = integral_curve(*surface.exact.target, surface.tool, seed, options);
  ASSERT_GT(curve.s.size(), 10u);
  EXPECT_TRUE(std::is_sorted(curve.s.begin(), curve.s.end()));
  for (std::size_t k = 0; k < curve.s.size(); ++k)
    EXPECT_NEAR(surface.exact.target->closest(curve.centres[k]).distance, surface.tool.at(curve.s[k]).r, 1e-9);
}

TEST(IntegralCurve, IsStraightOnAPlaneAndAlongRulings) {
  const auto plane = testing::flat_target(0.0, 50.0, 0.0, 40.0);
  const RadialFunction cylinder = testing::cylinder(4.0, 16.0).radial;
  const IntegralCurveOptions on_plane = options_for(16.0);
  for (const CurveSeed& seed : curve_seeds(*plane, cylinder, 20, 3, on_plane.filter)) {
    const IntegralCurve curve = integral_curve(*plane, cylinder, seed, on_plane);
    EXPECT_LE(
        largest_distance(curve, {seed.foot.point + 4.0 * seed.foot.normal - seed.s * seed.direction, seed.direction}),
        1e-9);
  }
  // A cone rolls off its own envelope along its axis.
  const testing::ExactTarget cone = testing::cone_target();
  const IntegralCurveOptions on_cone = options_for(40.0);
  const CurveSeed seed = seed_at(cone, cone.motion.pose(0.5), cone.tool, 20.0, on_cone);
  const IntegralCurve curve = integral_curve(*cone.target, cone.tool, seed, on_cone);
  ASSERT_GE(curve.s.size(), 10u);
  EXPECT_LE(largest_distance(curve, line_through(curve)), 2e-4);
}

TEST(IntegralCurve, EndsAtTheBorder) {
  const auto plane = testing::flat_target(0.0, 50.0, 0.0, 40.0);
  const RadialFunction cylinder = testing::cylinder(4.0, 16.0).radial;
  CurveSeed seed;
  seed.foot = plane->closest(Vec3(3.0, 20.0, 0.0));
  seed.s = 8.0;
  seed.direction = Vec3::UnitX();
  const IntegralCurve curve = integral_curve(*plane, cylinder, seed, options_for(16.0));
  EXPECT_EQ(curve.tip, CurveEnd::kBorder);
  EXPECT_EQ(curve.holder, CurveEnd::kToolEnd);
  EXPECT_NEAR(curve.s.front(), 5.0, 1.0 + 1e-9) << "within a step of the border";
}

TEST(IntegralCurve, EndsWhereItBends) {
  // Along a tool of another bend, the directions of an envelope turn.
  const Example blade = make_example("twisted-blade");
  const auto target = make_target(blade.faces);
  const RadialFunction cylinder = testing::cylinder(5.0, 20.0).radial;
  IntegralCurveOptions options = options_for(20.0, 0.02);
  int bent = 0, farther = 0;
  for (const CurveSeed& seed : curve_seeds(*target, cylinder, 60, 1, options.filter)) {
    options.step_by_step = false;
    const IntegralCurve curve = integral_curve(*target, cylinder, seed, options);
    if (curve.tip != CurveEnd::kStraightness && curve.holder != CurveEnd::kStraightness) continue;
    ++bent;
    const Vec3 chord = (curve.centres.back() - curve.centres.front()).normalized();
    EXPECT_TRUE(curve.s.size() == 1 || chord.dot(seed.direction) >= std::cos(kStraightnessRad));
    options.step_by_step = true;
    if (integral_curve(*target, cylinder, seed, options).span() > curve.span()) ++farther;
  }
  EXPECT_GE(bent, 10);
  EXPECT_GE(farther, bent / 2) << "the printed rule lets a curve turn further";
}

TEST(IntegralCurve, NoSeedWhereTheSphereDoesNotFit) {
  const auto hollow = make_target(make_example("elliptic-side").faces, -1);
  const DirectionFilterOptions filter{1e-3, 60.0, 3.0};
  EXPECT_TRUE(curve_seeds(*hollow, testing::cylinder(80.0, 60.0).radial, 50, 3, filter).empty());
  EXPECT_FALSE(curve_seeds(*hollow, testing::cylinder(5.0, 10.0).radial, 50, 3, {1e-3, 10.0, 3.0}).empty());
}

}  // namespace
}  // namespace flank::internal
