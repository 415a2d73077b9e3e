// The planner's own measures: the score that ranks, the swept estimate over samples, gouges, and the validation with
// cold footpoints; all on scenes whose figures are known.
#include <gtest/gtest.h>

#include <cmath>

#include "fit/flat_scene.h"
#include "flank/fit.h"
#include "flank/fit/coverage.h"
#include "flank/fit/model/shank_balls.h"
#include "flank/threads.h"
#include "seed/exact_targets.h"

namespace flank::internal {
namespace {

using testing::cylinder;
using testing::hub;
using testing::only;
using testing::standing_blade;
using testing::upright_motion;

constexpr double kTolerance = 0.02;
/// Less than half a millimetre apart: the estimate's own error is then below 1e-4 mm.
constexpr int kPoses = 160;

CoverageEstimate estimate_of(double coverage, double overcut = 0.0, double gouge = 0.0, double rms = 0.0) {
  CoverageEstimate estimate;
  estimate.at_tolerance = coverage;
  estimate.at_four_tolerances = std::min(1.0, 1.1 * coverage);
  estimate.overcut_mm = overcut;
  estimate.gouge_mm = gouge;
  estimate.rms_mm = rms;
  return estimate;
}
double score_of(double coverage, double overcut = 0.0, double gouge = 0.0, double rms = 0.0) {
  return estimate_of(coverage, overcut, gouge, rms).score(kTolerance);
}

TEST(CoverageScore, RisesWithTheCoverage) {
  double last = -1.0;
  for (const double coverage : {0.0, 0.1, 0.5, 0.9, 0.99, 1.0}) {
    EXPECT_GT(score_of(coverage), last);
    last = score_of(coverage);
  }
  EXPECT_DOUBLE_EQ(score_of(0.0), 0.0);
  EXPECT_DOUBLE_EQ(last, 1.2);
}

TEST(CoverageScore, WhatIsNearlyCoveredCountsAFifth) {
  CoverageEstimate near = estimate_of(0.5);
  near.at_four_tolerances += 0.1;
  EXPECT_NEAR(near.score(kTolerance) - score_of(0.5), 0.02, 1e-12);
}

TEST(CoverageScore, FallsWithOvercutToElevenTolerancesAndWithGougesToAHundred) {
  double last = 1e300;
  for (const double tolerances : {0.0, 0.3, 0.9, 1.0, 1.01, 1.9, 2.5, 7.0, 11.0}) {
    const double score = score_of(0.9, tolerances * kTolerance);
    EXPECT_LT(score, last) << tolerances;
    last = score;
  }
  EXPECT_EQ(score_of(0.9, 50.0 * kTolerance), last);
  last = score_of(0.9);
  for (const double tolerances : {0.3, 1.01, 1.9, 2.5, 11.0, 30.0, 100.0}) {
    const double score = score_of(0.9, 0.0, tolerances * kTolerance);
    EXPECT_LT(score, last) << tolerances;
    last = score;
  }
  EXPECT_EQ(score_of(0.9, 0.0, 500.0 * kTolerance), last);
}

TEST(CoverageScore, TheFirstToleranceOfExcessCostsTenPercentEachFurtherOneTwo) {
  const double allowed = score_of(0.9, kTolerance);
  EXPECT_NEAR(allowed - score_of(0.9, 2.0 * kTolerance), 0.10, 1e-12);
  EXPECT_NEAR(score_of(0.9, 2.0 * kTolerance) - score_of(0.9, 3.0 * kTolerance), 0.02, 1e-12);
  EXPECT_NEAR(score_of(0.9, 5.0 * kTolerance) - score_of(0.9, 6.0 * kTolerance), 0.02, 1e-12);
}

TEST(CoverageScore, OvercutAndMeanErrorWithinTheToleranceWeighLessThanTwoPercentOfCoverage) {
  EXPECT_GT(score_of(0.92, kTolerance, 0.0, kTolerance), score_of(0.90));
}

TEST(CoverageScore, AmongEqualsTheLesserOvercutAndTheLesserMeanWin) {
  EXPECT_GT(score_of(0.9, 0.2 * kTolerance), score_of(0.9, 0.4 * kTolerance));
  EXPECT_GT(score_of(0.9, 0.0, 0.0, 0.2 * kTolerance), score_of(0.9, 0.0, 0.0, 0.3 * kTolerance));
  // "Within the tolerance the mean error counts for more": not shifted off the middle of the face.
  EXPECT_GT(score_of(0.9, 0.5 * kTolerance, 0.0, 0.1 * kTolerance), score_of(0.9, 0.0, 0.0, 0.6 * kTolerance));
}

TEST(CoverageScore, AGougeCountsLikeOvercutAndAdds) {
  const double both = score_of(0.9, 3.0 * kTolerance, 3.0 * kTolerance);
  EXPECT_LT(both, score_of(0.9, 3.0 * kTolerance));
  EXPECT_LT(both, score_of(0.9, 0.0, 3.0 * kTolerance));
}

TEST(CoverageScore, DependsOnLengthsInTolerancesOnly) {
  for (const double unit : {1e-3, 25.4}) {
    const CoverageEstimate scaled =
        estimate_of(0.8, 1.7 * kTolerance * unit, 3.1 * kTolerance * unit, 0.6 * kTolerance * unit);
    EXPECT_NEAR(scaled.score(kTolerance * unit), score_of(0.8, 1.7 * kTolerance, 3.1 * kTolerance, 0.6 * kTolerance),
                1e-12);
  }
}

TEST(CoverageScore, MaterialLeftOnTheUncoveredRestDoesNotCount) {
  CoverageEstimate left = estimate_of(0.7);
  left.undercut_mm = 30.0;
  EXPECT_EQ(left.score(kTolerance), score_of(0.7));
}

/// The blade y = 0 and a cylinder of radius 5 before it, off by `gap` (negative: into it), over all of its height.
CoverageEstimate beside_blade(double gap, const std::vector<SurfaceSample>& samples) {
  const RuledMotion motion =
      upright_motion({.y = 5.0 + gap, .z = -1.0, .x_first = -6.0, .x_last = 66.0, .length = 42.0});
  return estimate_coverage(samples, {motion}, cylinder(5.0, 42.0), kTolerance, kPoses);
}

TEST(EstimateCoverage, OfACylinderAlongAPlaneIsItsDistance) {
  const auto samples = standing_blade(0.0)->samples(4.0);
  struct Case {
    double gap, at_tolerance, at_four;
  };
  for (const Case& c : {Case{0.0, 1, 1}, {0.01, 1, 1}, {-0.01, 1, 1}, {0.05, 0, 1}, {-0.05, 0, 1}, {0.2, 0, 0}}) {
    const CoverageEstimate found = beside_blade(c.gap, samples);
    EXPECT_EQ(found.at_tolerance, c.at_tolerance) << c.gap;
    EXPECT_EQ(found.at_four_tolerances, c.at_four) << c.gap;
    EXPECT_NEAR(found.overcut_mm, std::max(0.0, -c.gap), 1e-6) << c.gap;
    EXPECT_NEAR(found.undercut_mm, std::max(0.0, c.gap), 1e-4) << c.gap;
    EXPECT_NEAR(found.rms_mm, c.at_four * std::abs(c.gap), 1e-4) << c.gap;
    EXPECT_EQ(found.gouge_mm, 0.0);
  }
}

/// Poses as far apart as a thin tool is thick: an estimate is off, unless each sample is refined.
TEST(EstimateCoverage, OfAThinToolIsItsDistanceWhereAllSamplesAreRefined) {
  constexpr double kGap = 1e-3;
  constexpr int kFewPoses = 60;
  const auto samples = standing_blade(0.0)->samples(2.3);
  const RuledMotion motion =
      upright_motion({.y = 0.5 + kGap, .z = -1.0, .x_first = -6.0, .x_last = 66.0, .length = 42.0});
  const RadialFunction thin = cylinder(0.5, 42.0);
  const CoverageEstimate rough = estimate_coverage(samples, {motion}, thin, kTolerance, kFewPoses),
                         exact = estimate_coverage(samples, {motion}, thin, kTolerance, kFewPoses, Refined::kAll);
  EXPECT_NEAR(exact.undercut_mm, kGap, 1e-9);
  EXPECT_NEAR(exact.rms_mm, kGap, 1e-9);
  EXPECT_GT(std::abs(rough.undercut_mm - kGap), 1e-3);
}

TEST(EstimateCoverage, IsTheShareOfTheAreaThatTheMotionPasses) {
  const auto samples = standing_blade(0.0)->samples(1.0);
  const RuledMotion half = upright_motion({.y = 5.0, .z = -1.0, .x_first = -6.0, .x_last = 30.0, .length = 42.0});
  const CoverageEstimate found = estimate_coverage(samples, {half}, cylinder(5.0, 42.0), kTolerance, kPoses);
  // Past the end the cylinder leaves sqrt(25 + x^2) - 5 = x^2 / 10.
  const double reach = std::sqrt(10.0 * kTolerance);
  EXPECT_NEAR(found.at_tolerance, (30.0 + reach) / 60.0, 1.0 / 60.0);
  EXPECT_NEAR(found.at_four_tolerances, (30.0 + 2.0 * reach) / 60.0, 1.0 / 60.0);
  EXPECT_NEAR(found.undercut_mm, std::hypot(29.5, 5.0) - 5.0, 0.1);
  const RuledMotion rest = upright_motion({.y = 5.0, .z = -1.0, .x_first = 30.0, .x_last = 66.0, .length = 42.0});
  EXPECT_EQ(estimate_coverage(samples, {half, rest}, cylinder(5.0, 42.0), kTolerance, kPoses).at_tolerance, 1.0);
}

TEST(EstimateCoverage, SamplesCountByTheirAreaAndThoseWithoutForOvercutAlone) {
  std::vector<SurfaceSample> samples(3);
  samples[0] = {Vec3(30.0, 0.0, 20.0), Vec3::UnitY(), 3.0};
  samples[1] = {Vec3(30.0, -1.0, 20.0), Vec3::UnitY(), 1.0};  // behind what the tool touches: material left
  samples[2] = {Vec3(30.0, 0.5, 20.0), Vec3::UnitY(), 0.0};   // inside the tool
  const CoverageEstimate found = beside_blade(0.0, samples);
  EXPECT_DOUBLE_EQ(found.at_tolerance, 0.75);
  EXPECT_NEAR(found.overcut_mm, 0.5, 1e-6);
  EXPECT_NEAR(found.undercut_mm, 1.0, 1e-4);
  const CoverageEstimate nothing = beside_blade(0.0, {});
  EXPECT_EQ(nothing.at_tolerance, 0.0);
  EXPECT_EQ(nothing.rms_mm, 0.0);
}

TEST(EstimateCoverage, ThreadsChangeNothing) {
  const testing::ExactTarget exact = testing::barrel_target();
  const auto samples = exact.target->samples(1.0);
  CoverageEstimate found[2];
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    found[threads / 2] = estimate_coverage(samples, {exact.motion}, exact.tool, kTolerance, 60);
  }
  set_thread_count(0);
  EXPECT_EQ(found[0].at_tolerance, found[1].at_tolerance);
  EXPECT_EQ(found[0].rms_mm, found[1].rms_mm);
  EXPECT_EQ(found[0].overcut_mm, found[1].overcut_mm);
  EXPECT_GT(found[0].at_tolerance, 0.97) << "the target is this tool's envelope";
}

TEST(FlankGouge, IsTheDeepestBallInTheHub) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(only(hub(true)), *blade, 2.0, 0.0);
  for (const double z : {8.0, 5.0, 4.9, 3.0, -6.0})
    EXPECT_NEAR(flank_gouge({upright_motion({.z = z})}, {&obstacles}, cylinder(5.0), {}, 20), std::max(0.0, 5.0 - z),
                1e-6)
        << z;
}

TEST(FlankGouge, OfARoughLookIsExactWhereTheFlankTouchesAndEstimatedWhereItIsInside) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(only(hub(true)), *blade, 2.0, 0.0);
  for (double z = 6.0; z > -6.0; z -= 0.05) {
    const double depth = std::max(0.0, 5.0 - z);
    EXPECT_NEAR(flank_gouge({upright_motion({.z = z})}, {&obstacles}, cylinder(5.0), {}, 20, GougeLook::kRough), depth,
                depth < 0.5 ? 1e-6 : 0.1)
        << z;
  }
}

TEST(FlankGouge, FindsTheOneBallOfABarrelThatEnters) {
  // The axis lies over the hub, the barrel's belly hangs down in its middle.
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(only(hub(true)), *blade, 2.0, 0.0);
  RuledMotion lying = upright_motion({.y = 12.0, .z = 6.0, .x_first = 10.0, .x_last = 20.0});
  lying.direction.poles.colwise() = Vec3::UnitX();
  const RadialFunction barrel(ToolFamily::kBarrel, 30.0, Eigen::Vector3d(60.0, 6.2, 17.3));
  EXPECT_NEAR(flank_gouge({lying}, {&obstacles}, barrel, {}, 12), 0.2, 2e-3);
}

TEST(FlankGouge, DoesNotStepOverANarrowBump) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(only(hub(true)), *blade, 2.0, 0.0);
  RuledMotion lying = upright_motion({.y = 12.0, .z = 6.9, .x_first = 5.0, .x_last = 15.0, .length = 60.0});
  lying.direction.poles.colwise() = Vec3::UnitX();
  Eigen::VectorXd radii = Eigen::VectorXd::Constant(12, 3.0);
  radii[5] = 9.0;  // r = 3, but 3 + 2/3 6 at the bump's top, a knot of the spline
  const double found = flank_gouge({lying}, {&obstacles}, RadialFunction::spline(60.0, radii), {}, 4);
  EXPECT_LE(found, 0.1 + 1e-9);
  EXPECT_GT(found, 0.1 - 0.5 * 0.27 * 0.25) << "half a step of one millimetre off the top, r'' = 0.27";
}

TEST(FlankGouge, CountsTheShankThatStandsAboveTheFlank) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(only(hub(true)), *blade, 2.0, 0.0);
  // The axis falls towards the hub: the flank ends 9 mm above it, and a shank of 30 mm comes down to z = 3.
  RuledMotion falling = upright_motion({.y = 12.0, .z = 15.0, .x_first = 5.0, .x_last = 15.0});
  falling.direction.poles.colwise() = Vec3(std::sqrt(1.0 - 0.04), 0.0, -0.2);
  RadiusBounds bounds;
  EXPECT_EQ(flank_gouge({falling}, {&obstacles}, cylinder(5.0), bounds, 12), 0.0);
  bounds.shank_in_the_way = true;
  bounds.shank_length = 30.0;
  for (const GougeLook look : {GougeLook::kRough, GougeLook::kQuick, GougeLook::kClose}) {
    EXPECT_NEAR(flank_gouge({falling}, {&obstacles}, cylinder(5.0), bounds, 12, look), kShankGrown * 5.0 - 3.0,
                look == GougeLook::kRough ? 0.1 : 1e-6);
    RadiusBounds thin = bounds;
    thin.shank_radius = 2.0;
    EXPECT_EQ(flank_gouge({falling}, {&obstacles}, cylinder(5.0), thin, 12, look), 0.0);
  }
}

TEST(FlankGouge, LooksOnlyAtMotionsThatHaveChecks) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(only(hub(true)), *blade, 2.0, 0.0);
  const std::vector<RuledMotion> motions = {upright_motion({.z = 0.0}), upright_motion({.z = 4.0})};
  EXPECT_EQ(flank_gouge(motions, {}, cylinder(5.0), {}, 12), 0.0);
  EXPECT_NEAR(flank_gouge(motions, {nullptr, &obstacles}, cylinder(5.0), {}, 12), 1.0, 1e-6);
  EXPECT_NEAR(flank_gouge(motions, {&obstacles, &obstacles}, cylinder(5.0), {}, 12), 5.0, 1e-6);
}

TEST(Validate, AnExactEnvelopeHasNoError) {
  for (const testing::ExactTarget& exact : {testing::barrel_target(), testing::cone_target()}) {
    const ResidualSummary error = validate({{exact.target.get(), exact.motion}}, exact.tool, 31, 17);
    EXPECT_LT(error.largest_mm, 1e-6 * exact.target->diagonal());
    EXPECT_LT(error.rms_mm, 1e-6 * exact.target->diagonal());
    EXPECT_GT(error.inside_share, 0.8);
  }
}

TEST(Validate, AToolThatIsOffIsOffByThat) {
  const testing::ExactTarget exact = testing::cone_target();
  for (const double by : {-0.03, 0.04}) {
    const RadialFunction tool = exact.tool.with_parameters(exact.tool.parameters() + Eigen::Vector2d(by, 0.0));
    const ResidualSummary error = validate({{exact.target.get(), exact.motion}}, tool, 31, 17);
    EXPECT_NEAR(error.largest_mm, std::abs(by), 1e-4);
    EXPECT_NEAR(error.rms_mm, std::abs(by), 1e-4);
    EXPECT_NEAR(error.largest_overcut_mm, std::max(0.0, by), 1e-4) << "a thicker tool cuts deeper";
  }
}

TEST(Validate, AMotionThatIsShiftedOffAPlaneIsOffByTheShift) {
  const auto blade = standing_blade(0.0);
  const ResidualSummary off = validate({{blade.get(), upright_motion({.y = 4.9})}}, cylinder(5.0), 11, 7);
  EXPECT_NEAR(off.largest_overcut_mm, 0.1, 1e-9);
  EXPECT_NEAR(off.rms_mm, 0.1, 1e-9);
  EXPECT_EQ(off.inside_share, 1.0);
}

TEST(Validate, WhatLiesPastTheBorderIsLeftOutOfTheErrors) {
  const auto blade = standing_blade(0.0);
  // 11 times from x = -30 to 30: five are past the border x = 0. The sixth lies on it.
  const FitTask task{blade.get(), upright_motion({.y = 5.2, .x_first = -31.0, .x_last = 29.0})};
  const ResidualSummary error = validate({task}, cylinder(5.0), 11, 7);
  EXPECT_NEAR(error.inside_share, 5.0 / 11.0, 1e-12);
  EXPECT_NEAR(error.largest_mm, 0.2, 1e-9);
  const ResidualSummary nothing =
      validate({{blade.get(), upright_motion({.x_first = -40.0, .x_last = -10.0})}}, cylinder(5.0), 5, 5);
  EXPECT_EQ(nothing.inside_share, 0.0);
  EXPECT_EQ(nothing.rms_mm, 0.0);
}

TEST(Validate, SeveralTasksAreTakenTogether) {
  const auto blade = standing_blade(0.0);
  const FitTask exact{blade.get(), upright_motion()}, off{blade.get(), upright_motion({.y = 5.3})};
  const ResidualSummary error = validate({exact, off}, cylinder(5.0), 9, 5);
  EXPECT_NEAR(error.rms_mm, 0.3 / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(error.largest_mm, 0.3, 1e-9);
}

}  // namespace
}  // namespace flank::internal
