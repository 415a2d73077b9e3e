// What is said of a cavity that misses its request: which one it would meet.
#include "flank/pipeline/cavity_notes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace flank::internal {
namespace {

TrochoidJob asked_for() {
  TrochoidJob job;
  job.tolerance_mm = 0.01;
  return job;
}

/// A cavity that was cleared, of which a wall's corner is left.
Result cleared() {
  Result out;
  out.job = TrochoidJob{};
  TrochoidSummary cavity;
  cavity.layers.emplace_back();
  cavity.layers.back().status = "done";
  out.plan = cavity;
  out.tool.radial = RadialFunction(ToolFamily::kCone, 40.0, Eigen::Vector2d(2.0, 0.1));
  out.verify.tolerance_mm = 0.01;
  out.verify.coverage = 0.8;
  out.verify.reachable_share = 0.85;
  out.verify.coverage_reachable = 0.8 / 0.85;
  return out;
}

TEST(CavityNotes, TheNearestRequestThatIsMetIsTold) {
  Result result = cleared();
  note_nearest(result);
  EXPECT_EQ(result.notes, std::vector<std::string>{"this result would meet the request with --coverage 0.94"});
}

TEST(CavityNotes, OfWhatIsTooDeepToo) {
  Result result = cleared();
  result.verify.overcut_bound_mm = 0.0144;
  note_nearest(result);
  EXPECT_EQ(result.notes.back(), "this result would meet the request with --coverage 0.94 --tolerance 0.015");
}

TEST(CavityNotes, NoneWhereCyclesGotStuckOrAllIsMet) {
  Result stuck = cleared();
  std::get<TrochoidSummary>(stuck.plan).layers.back().status = "stuck";
  note_nearest(stuck);
  EXPECT_TRUE(stuck.notes.empty());
  Result met = cleared();
  met.verify.coverage_reachable = 0.96;
  note_nearest(met);
  EXPECT_TRUE(met.notes.empty());
}

TEST(CavityNotes, ThickerPlacesOfTheToolAreTold) {
  Result result = cleared();
  const auto thicker = [] { return 0.81; };
  const auto alike = [] { return 0.85; };
  note_own_reach({}, thicker, result);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_NE(result.notes[0].find("reaches 81.0 % of the sides"), std::string::npos) << result.notes[0];
  EXPECT_NE(result.notes[0].find("finishes 98.8 % of that"), std::string::npos) << result.notes[0];
  note_own_reach({}, alike, result);
  EXPECT_EQ(result.notes.size(), 1u) << "a tool that is as thick everywhere";
}

TEST(CavityNotes, WhatTheToolReachesIsAskedOnlyWhereCoverageMisses) {
  int asked = 0;
  const auto reach = [&] { return ++asked, 0.81; };
  Result covered = cleared(), given = cleared(), stopped = cleared();
  covered.verify.coverage_reachable = 1.0;
  stopped.complete = false;
  TrochoidJob job;
  job.judge.reach_radius_mm = 1.0;
  note_own_reach({}, reach, covered);
  note_own_reach(job, reach, given);
  note_own_reach({}, reach, stopped);
  EXPECT_EQ(asked, 0);
  Result result = cleared();
  note_own_reach({}, reach, result);
  EXPECT_EQ(asked, 1);
}

TEST(CavityNotes, WhereCyclesGotStuckTheLimitThatGetsPastIsTold) {
  CavityProgram program;
  program.layers.emplace_back();
  PlannedLayer& layer = program.layers.back();
  layer.cycles.status = CycleStatus::kStuck;
  layer.cycles.stuck = {0.0121, 61.3 * std::numbers::pi / 180.0};
  layer.share = 0.9;
  std::vector<std::string> notes;
  note_what_is_open(asked_for(), program, notes);
  EXPECT_NE(notes.at(0).find("the first cut cannot stay within 60 degrees"), std::string::npos) << notes[0];
  layer.cycles.cycles.emplace_back();
  notes.clear();
  note_what_is_open(asked_for(), program, notes);
  ASSERT_EQ(notes.size(), 3u);
  EXPECT_NE(notes[0].find("a step of 0.0121 mm with 61.30 degrees; --max-engagement 62"), std::string::npos)
      << notes[0];
  EXPECT_NE(notes[1].find("the rest is not machined"), std::string::npos) << notes[1];
}

/// A search that was stopped before any cycles said "no cycle was planned", and that the cavity is open.
TEST(CavityNotes, WithoutCyclesTheSidesAreTold) {
  std::vector<std::string> notes;
  note_what_is_open(asked_for(), {}, notes);
  EXPECT_TRUE(notes.empty()) << "nobody knows yet at which ends it is open";
  CoverageEstimate sides;
  sides.at_tolerance = 0.784;
  sides.gouge_mm = 0.2341;
  notes.push_back(no_cycles_sentence(asked_for(), sides, {NoCycles::kFarOff, 0.0, 2}));
  EXPECT_NE(notes.front().find("finish 78.4 % of both"), std::string::npos) << notes.front();
  EXPECT_NE(notes.front().find("by 0.2341 mm"), std::string::npos) << notes.front();
  EXPECT_NE(notes.front().find("95 % of the accessible area"), std::string::npos) << notes.front();
}

TEST(CavityNotes, CancelledWhereTheyWereStuckTheyTellThat) {
  CoverageEstimate sides;
  sides.at_tolerance = 0.996;
  PlannedLayer layer;
  layer.cycles.status = CycleStatus::kCancelled;
  layer.cycles.cycles.resize(5);
  layer.share = 0.25;
  EXPECT_EQ(
      why_not_done(asked_for(), layer, sides).rfind("the search ended there; roughed and finished over 25.0 %", 0), 0u);
  layer.cycles.ends_stuck = true;
  EXPECT_EQ(
      why_not_done(asked_for(), layer, sides).rfind("no step within 60 degrees of engagement is free of gouges", 0),
      0u);
  layer.cycles.stuck = {0.0121, 1.0699};
  EXPECT_NE(why_not_done(asked_for(), layer, sides).find("a step of 0.0121 mm with 61.30 degrees"), std::string::npos);
  EXPECT_NE(why_not_done(asked_for(), layer, sides).find("finish 99.6 % of both"), std::string::npos);
  layer.cycles.status = CycleStatus::kDone;
  EXPECT_TRUE(why_not_done(asked_for(), layer, sides).empty());
}

TEST(CavityNotes, TheLimitOfWorkIsAReasonOfTheLayerThatEndsThere) {
  Result result = cleared();
  auto& layers = std::get<TrochoidSummary>(result.plan).layers;
  layers.push_back(layers.back());
  layers.back().status = "cancelled";
  note_limit_of_work(result);
  EXPECT_EQ(result.notes.size(), 1u);
  EXPECT_TRUE(layers.front().why.empty());
  EXPECT_NE(layers.back().why.find("limit of work"), std::string::npos);
}

TEST(CavityNotes, WhyThereAreNoCyclesIsTold) {
  const auto told = [](const WhyNoCycles& why) { return no_cycles_sentence(asked_for(), {}, why); };
  EXPECT_NE(told({NoCycles::kFarOff, 0.0, 1}).find("deeper than four tolerances"), std::string::npos);
  EXPECT_NE(told({NoCycles::kNarrow, 0.214, 1}).find("it is 0.21 diameters of the tool long"), std::string::npos);
  EXPECT_NE(told({NoCycles::kEnded, 2.0, 5}).find("after the sides of 5 upper limits"), std::string::npos);
}

TEST(CavityNotes, FrontsThatDoNotGetIntoTheCavityAreTold) {
  CavityProgram program;
  PlannedLayer& layer = program.layers.emplace_back();
  layer.cycles.status = CycleStatus::kStuck;
  layer.cycles.cycles.resize(134);
  const auto told = [&](double share) {
    layer.share = share;
    std::vector<std::string> notes;
    note_what_is_open(asked_for(), program, notes);
    return std::count_if(notes.begin(), notes.end(), [](const std::string& note) {
      return note.find("all 134 cutting moves end before one of the sides begins") != std::string::npos;
    });
  };
  EXPECT_EQ(told(0.0), 1);
  EXPECT_EQ(told(0.1), 0);
}

TEST(CavityNotes, WhereTheSidesLeadAlongTheAxisOfStuckCyclesThatIsTold) {
  CavityProgram program;
  program.layers.emplace_back();
  PlannedLayer& layer = program.layers.back();
  layer.cycles.status = CycleStatus::kStuck;
  layer.cycles.cycles.emplace_back();
  layer.share = 0.9;
  const auto told = [&](double degrees) {
    layer.off_axis_rad = degrees * std::numbers::pi / 180.0;
    std::vector<std::string> notes;
    note_what_is_open(asked_for(), program, notes);
    return std::count_if(notes.begin(), notes.end(), [](const std::string& note) {
      return note.find("the sides run only 16 degrees off the tool's axis") != std::string::npos;
    });
  };
  EXPECT_EQ(told(16.0), 1);
  EXPECT_EQ(told(80.0), 0);
  EXPECT_FALSE(program.stuck_along_axis());
  layer.off_axis_rad = 0.5;
  EXPECT_TRUE(program.stuck_along_axis());
  layer.cycles.status = CycleStatus::kDone;
  EXPECT_EQ(told(16.0), 0);
}

}  // namespace
}  // namespace flank::internal
