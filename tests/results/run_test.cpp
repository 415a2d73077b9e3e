// The figures of a cover of several targets are of all of them, and both summaries say so.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "flank/run.h"

namespace flank::internal {
namespace {

CoverSummary two_targets() {
  TargetCover large, small;
  large.faces = "F1";
  large.area_mm2 = 300.0;
  large.seeds = 10, large.lines = 5, large.grown = 4, large.strips = 2;
  large.reachable = 0.8;                                        // 240 mm^2
  large.before = 0.5, large.after = 0.75, large.overlap = 0.1;  // 120, 180, 198
  large.links_mm = 7.0, large.overcut_mm = 0.02;
  small.faces = "F3,F4";
  small.area_mm2 = 100.0;
  small.seeds = 1, small.lines = 1, small.grown = 1, small.strips = 1;
  small.reachable = 0.6;  // 60 mm^2
  small.before = 1.0, small.after = 1.0, small.overlap = 0.0;
  small.links_mm = 3.0, small.overcut_mm = 0.01;
  return {{large, small}};
}

TEST(CoverSummary, WeightsSharesByTheAreasThatTheyAreSharesOf) {
  const TargetCover whole = two_targets().whole();
  EXPECT_EQ(whole.faces, "F1,F3,F4");
  EXPECT_EQ(whole.area_mm2, 400.0);
  EXPECT_NEAR(whole.reachable, 300.0 / 400.0, 1e-15);
  EXPECT_NEAR(whole.before, 180.0 / 300.0, 1e-15);
  EXPECT_NEAR(whole.after, 240.0 / 300.0, 1e-15);
  EXPECT_NEAR(whole.overlap, 258.0 / 240.0 - 1.0, 1e-15);
  EXPECT_EQ(whole.seeds, 11);
  EXPECT_EQ(whole.lines, 6);
  EXPECT_EQ(whole.grown, 5);
  EXPECT_EQ(whole.strips, 3);
  EXPECT_EQ(whole.links_mm, 10.0);
  EXPECT_EQ(whole.overcut_mm, 0.02);
}

TEST(CoverSummary, DoesNotDependOnTheOrderAndOneTargetIsItself) {
  CoverSummary turned = two_targets();
  std::swap(turned.targets[0], turned.targets[1]);
  EXPECT_NEAR(turned.whole().after, two_targets().whole().after, 1e-15);
  CoverSummary one = two_targets();
  one.targets.pop_back();
  EXPECT_NEAR(one.whole().before, 0.5, 1e-15);
  EXPECT_NEAR(one.whole().overlap, 0.1, 1e-15);
}

TEST(CoverSummary, OfNothingIsZero) {
  EXPECT_EQ(CoverSummary().whole().after, 0.0);
  CoverSummary unreachable{{TargetCover()}};
  unreachable.targets[0].area_mm2 = 5.0;
  EXPECT_EQ(unreachable.whole().after, 0.0);
  EXPECT_EQ(unreachable.whole().overlap, 0.0);
}

Result covered() {
  Result result;
  CoverJob job;
  job.part.file = "parts/blade.step";
  job.part.faces = "F1,F3,F4";
  job.tool.spec = "barrel";
  job.tolerance_mm = 0.05;
  job.judge.least_coverage = 0.9;
  result.job = job;
  result.plan = two_targets();
  result.tool.radial = RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 5.0));
  result.verify.tolerance_mm = 0.05;
  result.verify.coverage_reachable = 0.95;
  return result;
}

TEST(Summary, SaysWhatWasAskedAndTheFiguresOfAllTargets) {
  const auto json = nlohmann::json::parse(summary_json(covered()));
  EXPECT_EQ(json.at("schema"), "openflank/summary/1");
  EXPECT_EQ(json.at("part"), "parts/blade.step");
  EXPECT_EQ(json.at("least_coverage"), 0.9);
  EXPECT_EQ(json.at("within"), true);
  EXPECT_NEAR(json.at("before").at("coverage").get<double>(), 0.6, 1e-15);
  EXPECT_NEAR(json.at("after").at("coverage").get<double>(), 0.8, 1e-15);
  EXPECT_EQ(json.at("after").at("overcut"), 0.02);
  EXPECT_EQ(json.at("cover").at("strips"), 3);
  ASSERT_EQ(json.at("targets").size(), 2u);
  EXPECT_EQ(json.at("targets").at(1).at("faces"), "F3,F4");
  EXPECT_FALSE(json.contains("ranking"));
  const std::string text = summary_text(covered());
  EXPECT_NE(text.find("request     tool barrel, tolerance 0.05 mm, coverage 0.9"), std::string::npos) << text;
  EXPECT_NE(text.find("F3,F4: 1 pass chosen from"), std::string::npos) << text;
  EXPECT_NE(text.find("meets the request"), std::string::npos) << text;
}

TEST(Summary, AcceptanceGoesByTheJobsCoverage) {
  Result result = covered();
  EXPECT_TRUE(result.acceptance().pass());
  std::get<CoverJob>(result.job).judge.least_coverage = 0.96;
  EXPECT_FALSE(result.acceptance().pass());
  EXPECT_NE(summary_text(result).find("does NOT meet the request"), std::string::npos);
  result = covered();
  result.complete = false;
  EXPECT_FALSE(result.acceptance().pass());
}

TEST(Summary, HasNoFiguresOfAResultThatNobodyHasJudged) {
  Result result = covered();
  result.complete = false;
  const auto json = nlohmann::json::parse(summary_json(result));
  EXPECT_EQ(json.at("judged"), false);
  for (const char* key : {"coverage", "coverage_reachable", "overcut", "other_faces_overcut", "overcut_bound"})
    EXPECT_TRUE(json.at(key).is_null()) << key;
  result.verify.verdict = Verdict::kPass;
  const auto judged = nlohmann::json::parse(summary_json(result));
  EXPECT_FALSE(judged.contains("judged"));
  EXPECT_EQ(judged.at("coverage_reachable"), 0.95);
}

TEST(Summary, HasTheRankingOfTheTools) {
  Result result = covered();
  Ranking ranking;
  ranking.source = "catalogue tools";
  ranking.tools.resize(2);
  RankedChoice& works = ranking.tools.front();
  works.tool = "long", works.stage = "full", works.works = true, works.coverage = 0.9, works.strips = 3;
  RankedChoice& fails = ranking.tools.back();
  fails.tool = "stout", fails.stage = "screened", fails.reason = "too stout";
  result.ranking = ranking;
  const auto json = nlohmann::json::parse(summary_json(result));
  ASSERT_EQ(json.at("ranking").size(), 2u);
  EXPECT_EQ(json.at("ranking").at(0).at("rank"), 1);
  EXPECT_FALSE(json.at("ranking").at(0).contains("reason"));
  EXPECT_EQ(json.at("ranking").at(1).at("reason"), "too stout");
  EXPECT_NE(summary_text(result).find("2 tools: catalogue tools"), std::string::npos);
}

/// A fit of three tools: a stiff one that covers less, the chosen one, and a thin one that cuts too deep.
Result three_tools() {
  Result result;
  result.job = FitJob();
  result.tool.radial = RadialFunction(ToolFamily::kCylinder, 30.0, Eigen::Matrix<double, 1, 1>(5.0));
  result.verify.tolerance_mm = 0.01;
  FitSummary fit;
  fit.stiffness = {{.slenderness = 2.0, .coverage = 0.9, .coverage_reachable = 0.95, .overcut_mm = 0.01},
                   {.slenderness = 3.0, .coverage = 0.99, .rms_mm = 0.002, .judged = true, .chosen = true},
                   {.slenderness = 6.0, .coverage = 1.0, .overcut_mm = 0.02, .judged = true}};
  result.plan = fit;
  return result;
}

TEST(StiffnessCurve, IsInTheSummaries) {
  const auto json = nlohmann::json::parse(summary_json(three_tools()));
  const auto& steps = json.at("stiffness");
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(steps[0].at("slenderness"), 2.0);
  EXPECT_EQ(steps[0].at("coverage_reachable"), 0.95);
  EXPECT_EQ(steps[0].at("judged"), false);
  EXPECT_FALSE(steps[1].contains("coverage_reachable"));
  EXPECT_EQ(steps[1].at("chosen"), true);
  EXPECT_EQ(steps[1].at("rms"), 0.002);
  EXPECT_EQ(steps[2].at("overcut"), 0.02);
  // An estimate that no more than matches a stiffer tool is worth no word; neither is a single tool.
  Result four = three_tools();
  auto& tools = std::get<FitSummary>(four.plan).stiffness;
  tools.push_back({.slenderness = 7.0, .coverage = 0.99});
  EXPECT_NE(summary_text(four).find("4 tools tried; L:D and finished area: 2.0 90.00 % (estimate), 3.0 99.00 % "
                                    "(chosen), 6.0 100.00 % with gouges of 0.02 mm\n"),
            std::string::npos)
      << summary_text(four);
  Result one = three_tools();
  std::get<FitSummary>(one.plan).stiffness.resize(1);
  EXPECT_EQ(summary_text(one).find("tools tried"), std::string::npos);
  std::get<FitSummary>(one.plan).stiffness.clear();
  EXPECT_FALSE(nlohmann::json::parse(summary_json(one)).contains("stiffness"));
}

TEST(BendRadius, IsInTheSummaryAndNullWhereNothingBends) {
  Result result = three_tools();
  result.bends.tip_mm = 7.5;
  const auto bends = nlohmann::json::parse(summary_json(result)).at("bend_radius");
  EXPECT_EQ(bends.at("tip"), 7.5);
  EXPECT_TRUE(bends.at("holder_end").is_null());
}

}  // namespace
}  // namespace flank::internal
