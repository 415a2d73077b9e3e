// When the search for a cavity's tool ends, and how long it goes on with thinner ones.
#include "flank/pipeline/cavity/cavity_search.h"

#include <gtest/gtest.h>

#include "flank/example.h"
#include "obstacle/obstacle_scene.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

/// Two blades that end at one wall, which keeps a ball of 2 mm off a thirtieth of them.
CavityFaces walled_blades() {
  const Face wall = testing::quad(Vec3(60, 50, -10), Vec3(60, -50, -10), Vec3(60, 50, 60), Vec3(60, -50, 60), "F3");
  CavityFaces faces;
  for (int side = 0; side < 2; ++side) {
    TargetGroup& group = faces.sides.emplace_back();
    group.target = testing::standing_blade(0.0);
    group.obstacles =
        std::make_unique<ObstacleField>(testing::only({make_target({wall}), true}), *group.target, 8.0, 0.0);
  }
  return faces;
}

/// For 95 % within a hundredth of a millimetre.
TrochoidJob job_for_most() {
  TrochoidJob job;
  job.tolerance_mm = 0.01;
  job.judge.least_coverage = 0.95;
  return job;
}

/// Cycles that got through between sides that a tool of 2 mm at its tip and 6 mm at its other end finishes up to a share.
CavityPlan finished(double share) {
  constexpr double kHeight = 40.0;
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k <= 20; ++k) {
    t.push_back(k / 20.0);
    poses.push_back({Vec3(50.0 * t.back(), 4.0, 0.0), Vec3::UnitZ()});  // what it covers is in reach
  }
  CavityPlan plan;
  FlankFitResult& fit = plan.sides.fit;
  fit.tool = RadialFunction(ToolFamily::kCone, kHeight, Eigen::Vector2d(2.0, std::atan(0.1)));
  fit.motions = {fit_motion(poses, t, kHeight, 6), fit_motion(poses, t, kHeight, 6)};
  fit.status = FitStatus::kPartial;
  fit.after.at_tolerance = share;
  plan.program.layers.emplace_back();
  return plan;
}

TEST(CavitySearch, IsNotDoneWhereTheVerdictWillNotBeMet) {
  // With the radii that it has the tool reaches 93 %, of which 90 % is enough: the verdict counts what 2 mm reach, 97 %.
  TrochoidJob job = job_for_most();
  const CavityFaces faces = walled_blades();
  const CavityDemand demand{job, faces};
  EXPECT_FALSE(meets(finished(0.90), demand));
  EXPECT_TRUE(meets(finished(0.93), demand));
}

TEST(CavitySearch, IsDoneWhereTheJudgeFindsAllThatIsAsked) {
  // Its samples are finer than those of the estimate, and it has proofs: what it finds is what counts.
  TrochoidJob job = job_for_most();
  const CavityFaces faces = walled_blades();
  const CavityDemand demand{job, faces};
  CavityPlan plan = finished(0.93);
  plan.finding = CavityFinding{false, 0.924};
  EXPECT_FALSE(meets(plan, demand)) << "the estimate takes it for done";
  EXPECT_TRUE(wants_even_tool(plan, demand));
  plan = finished(0.90);
  plan.finding = CavityFinding{true, 0.951};
  EXPECT_TRUE(meets(plan, demand));
  EXPECT_FALSE(wants_even_tool(plan, demand));
}

TEST(CavitySearch, TakesTheShareThatIsAskedForNotNinetyNinePercent) {
  TrochoidJob job = job_for_most();
  const CavityFaces faces = walled_blades();
  const CavityDemand demand{job, faces};
  CavityPlan plan = finished(0.992);
  plan.sides.fit.status = FitStatus::kWithinTolerance;
  job.judge.reach_radius_mm = 0.1;  // which reaches all
  EXPECT_TRUE(fills_reach(plan.sides, demand));
  job.judge.least_coverage = 0.999;
  plan.sides.fit.tool = RadialFunction(ToolFamily::kCylinder, 40.0, Eigen::VectorXd::Constant(1, 0.1));
  EXPECT_FALSE(fills_reach(plan.sides, demand));
}

/// The sides alone.
CavityPlan uncut(double share) {
  CavityPlan plan = finished(share);
  plan.program.layers.clear();
  return plan;
}

TEST(CavitySearch, SidesThatAreDoneAreAGainOnThoseThatAreShort) {
  const TrochoidJob job = job_for_most();
  const CavityFaces faces = walled_blades();
  const CavityDemand demand{job, faces};
  EXPECT_GT(rank(uncut(0.803), demand), rank(uncut(0.80), demand));
  EXPECT_EQ(rank(uncut(0.8001), demand), rank(uncut(0.80), demand)) << "a hair is no gain";
  EXPECT_GT(rank(uncut(0.93), demand), rank(uncut(0.80), demand));
  EXPECT_GT(rank(uncut(0.80), demand), rank(CavityPlan{}, demand));
}

TEST(CavitySearch, ARankIsAnOrder) {
  // Whatever three plans are compared, in whatever order: none is better than one that is better than it.
  const TrochoidJob job = job_for_most();
  const CavityFaces faces = walled_blades();
  const CavityDemand demand{job, faces};
  std::vector<CavityRank> ranks;
  for (const double share : {0.5, 0.9, 0.93})
    for (const double entered : {0.0, 0.009, 0.02, 0.5})
      for (const bool judged : {false, true}) {
        CavityPlan plan = finished(share);
        plan.program.layers.front().cycles.cycles.resize(1);
        plan.program.layers.front().cycles.cycles.front().entered_mm = entered;
        if (judged) plan.finding = CavityFinding{share > 0.92, share};
        ranks.push_back(rank(plan, demand));
      }
  for (const CavityRank& a : ranks)
    for (const CavityRank& b : ranks)
      for (const CavityRank& c : ranks) EXPECT_FALSE(a < b && b < c && !(a < c));
}

TEST(CavitySearch, SidesThatAreTooDeepOrCoverLittleAreHopeless) {
  const TrochoidJob job = job_for_most();
  const CavityFaces faces = walled_blades();
  const CavityDemand demand{job, faces};
  CavityPlan plan = finished(0.9);
  EXPECT_FALSE(is_hopeless(plan.sides, demand));
  plan.sides.fit.after.gouge_mm = 0.03;
  EXPECT_FALSE(is_hopeless(plan.sides, demand)) << "a looser tolerance is met, which is said";
  plan.sides.fit.after.gouge_mm = 6.5;
  EXPECT_TRUE(is_hopeless(plan.sides, demand));
  EXPECT_TRUE(is_hopeless(finished(0.01).sides, demand));
  EXPECT_TRUE(is_hopeless({}, demand));
}

TEST(CavitySearch, WantsAnEvenToolWhereTheThickEndLeavesWhatTheThinOneReaches) {
  TrochoidJob job = job_for_most();
  const CavityFaces faces = walled_blades();
  const CavityDemand demand{job, faces};
  EXPECT_TRUE(wants_even_tool(finished(0.90), demand));
  EXPECT_FALSE(wants_even_tool(finished(0.93), demand)) << "done";
  EXPECT_FALSE(wants_even_tool(finished(0.80), demand)) << "it leaves what it reaches itself";
  job.judge.reach_radius_mm = 2.0;
  EXPECT_FALSE(wants_even_tool(finished(0.90), demand)) << "what is to be reached does not depend on the tool";
}

TEST(CavitySearch, TriesNoBoundBelowTheLeastRadiusThatIsAskedFor) {
  const CavityWidth width{.narrowest_mm = 24.0, .median_mm = 29.0};
  TrochoidJob job;
  job.radius.min_mm = 7.0;
  const std::vector<double> some = bounds_of(job, width);
  ASSERT_FALSE(some.empty());
  for (const double bound : some) EXPECT_GT(bound, 7.0);
  job.radius.min_mm = 11.0;
  const std::vector<double> thick = bounds_of(job, width);
  ASSERT_EQ(thick.size(), 1u) << "thicker than what is tried of its own accord, but there is room";
  EXPECT_GT(thick.front(), 11.0);
}

TEST(CavitySearch, StartsSlimWhereAThickStartCoversLittle) {
  if (kSanitized) GTEST_SKIP() << "the fits of FitSides have the same parts";
  // Both walls bulge, and the tool that makes them exactly has a waist of half of its largest radius.
  const Example example = make_example("cavity-hyperbolic", {});
  const std::unique_ptr<Target> left = make_target({example.faces[0]}), right = make_target({example.faces[1]});
  const CavitySide a{left.get(), nullptr}, b{right.get(), nullptr};
  TrochoidJob job;
  SideFitOptions options;
  options.fit.bounds.largest = bounds_of(job, width_between(a, b)).front();
  options.fit.bounds.smallest = 0.5;
  const std::vector<RadiusStart> starts = starts_under(options.fit.bounds.largest, options.fit.bounds.smallest);
  options.starts = {starts.back()};
  const auto sides = fit_sides(a, b, {}, options, {});
  EXPECT_GT(sides.fit.after.at_tolerance, 0.99) << "begun as thick as the others the best covers two fifths";
  EXPECT_LT(sides.fit.after.overcut_mm, 0.1 * options.fit.tolerance_mm);
}

TEST(CavitySearch, StartsAsAConeWhereACylinderLeavesWhatATipReaches) {
  const std::vector<RadiusStart> starts = starts_under(5.0, 0.5, 1.8);
  EXPECT_NEAR(starts.front().tip_share * starts.front().radius_mm, 1.8, 1e-12);
  EXPECT_LT(starts.front().least_share * starts.front().radius_mm, 1.8) << "its tip may become thinner";
  for (const RadiusStart& start : starts_under(5.0, 0.5)) EXPECT_EQ(start.tip_share, 1.0);
}

TEST(CavitySearch, TriesNoLayersThatAreTooFew) {
  CoverageEstimate found;
  found.at_tolerance = 0.75, found.at_four_tolerances = 0.97;
  EXPECT_EQ(layers_after(1, found, 0.95), 2) << "within four tolerances it is all but there";
  found.at_tolerance = 0.2, found.at_four_tolerances = 0.55;
  EXPECT_EQ(layers_after(1, found, 0.9), 4) << "with two it would cover 55 %";
  found.at_tolerance = 0.7, found.at_four_tolerances = 0.96;
  EXPECT_EQ(layers_after(3, found, 0.89), 5);
  found.at_tolerance = 0.69, found.at_four_tolerances = 0.72;
  EXPECT_EQ(layers_after(1, found, 0.9), 2) << "what is missing is far off, for another reason";
  found.at_tolerance = found.at_four_tolerances = 0.8;
  EXPECT_EQ(layers_after(2, found, 0.9), 3);
}

/// A layer whose cycles ended so.
PlannedLayer layer_of(CycleStatus status, int cycles, double share) {
  PlannedLayer layer;
  layer.cycles.status = status;
  layer.cycles.cycles.resize(static_cast<std::size_t>(cycles));
  layer.share = share;
  return layer;
}

TEST(CavitySearch, EndsWhereCyclesGetStuckBeforeTheSidesBegin) {
  // Each bound would take fits of up to five layers, with and without leans that are alike, and all of its cycles.
  CavityProgram program;
  EXPECT_FALSE(ends_search(program, true)) << "no cycles were looked for";
  program.layers = {layer_of(CycleStatus::kStuck, 134, 0.0)};
  EXPECT_TRUE(ends_search(program, true));
  EXPECT_FALSE(ends_search(program, false)) << "a tool that is given: there is no other";
  program.layers = {layer_of(CycleStatus::kStuck, 0, 0.0)};
  EXPECT_FALSE(ends_search(program, true)) << "no first front, or no way in: a thinner tool may have one";
  program.layers = {layer_of(CycleStatus::kStuck, 134, 0.02)};
  EXPECT_FALSE(ends_search(program, true)) << "they have begun on the sides, and another tool may get farther";
  program.layers = {layer_of(CycleStatus::kDone, 50, 1.0), layer_of(CycleStatus::kStuck, 30, 0.0)};
  EXPECT_FALSE(ends_search(program, true)) << "the layer above got through";
  program.layers = {layer_of(CycleStatus::kCancelled, 30, 0.0)};
  EXPECT_FALSE(ends_search(program, true));
}

TEST(CavitySearch, SidesWithoutCyclesAreNoBetterForEnteringNothing) {
  // The former have a tool with hardly a way across; the latter cover more, and their cycles, stuck before them, enter a hair.
  const TrochoidJob job = job_for_most();
  const CavityFaces faces = walled_blades();
  const CavityDemand demand{job, faces};
  const CavityPlan none = uncut(0.6);
  CavityPlan stuck = finished(0.9);
  stuck.program.layers = {layer_of(CycleStatus::kStuck, 134, 0.0)};
  stuck.program.layers.front().cycles.cycles.front().entered_mm = 0.003;
  EXPECT_GT(rank(stuck, demand), rank(none, demand));
}

TEST(CavitySearch, SaysWhyThereAreNoCycles) {
  const TrochoidJob job = job_for_most();
  const CavityFaces faces = walled_blades();
  const CavityDemand demand{job, faces};
  EXPECT_EQ(why_no_cycles(uncut(0.01), demand).why, NoCycles::kFarOff);
  CavityPlan plan = finished(0.9);
  plan.tools = 3;
  const WhyNoCycles why = why_no_cycles(plan, demand);
  EXPECT_EQ(why.why, why.way_across < 0.3 ? NoCycles::kNarrow : NoCycles::kEnded);
  EXPECT_EQ(why.tools, 3);
}

TEST(CavitySearch, EndsAtOnceWhereCyclesGetThroughAndAThinnerToolGainsNothing) {
  EXPECT_FALSE(is_in_vain(0, true));
  EXPECT_TRUE(is_in_vain(1, true));
}

TEST(CavitySearch, EndsAfterTwoToolsInARowThatGetNoFartherWhereCyclesGetStuck) {
  EXPECT_FALSE(is_in_vain(0, false));
  EXPECT_FALSE(is_in_vain(1, false)) << "one tool may be unlucky";
  EXPECT_TRUE(is_in_vain(2, false));
}

}  // namespace
}  // namespace flank::internal
