#include "flank/results/acceptance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "flank/results/cavity/stock_json.h"
#include "flank/results/verify_json.h"
#include "flank/results/verify_text.h"

namespace flank::internal {
namespace {

Tool tool_of(std::initializer_list<double> coefficients) {
  Tool tool;
  tool.radial = RadialFunction::spline(
      20.0, Eigen::Map<const Eigen::VectorXd>(coefficients.begin(), static_cast<Eigen::Index>(coefficients.size())));
  return tool;
}

Tool cylinder() { return tool_of({3, 3, 3, 3}); }

/// A report with nothing wrong, exactly at its limits.
VerifyReport at_the_limits() {
  VerifyReport r;
  r.verdict = Verdict::kPass;
  r.tolerance_mm = 0.01;
  r.coverage = 0.8;
  r.coverage_reachable = 0.95;
  r.overcut_mm = r.gouge_mm = 0.01;
  for (const char* name : {"F1", "F2", "F3"}) {
    FaceVerdict face;
    face.face = name;
    face.target = r.faces.empty();
    face.overcut_mm = 0.01;
    r.faces.push_back(face);
  }
  return r;
}

JudgeRequest asking(double least_coverage) {
  JudgeRequest request;
  request.least_coverage = least_coverage;
  return request;
}

/// With a shank and a holder, and nothing of the face left.
Tool whole_tool() {
  Tool tool = cylinder();
  tool.shank = {{20.0, 3.0}, {50.0, 3.0}};
  tool.holder = {{50.0, 10.0}, {90.0, 10.0}};
  return tool;
}

TEST(Acceptance, PassesAtTheLimits) {
  VerifyReport r = at_the_limits();
  r.coverage = 0.95;
  const Acceptance a = accept(whole_tool(), r, asking(0.95));
  EXPECT_TRUE(a.pass());
  EXPECT_EQ(reason_lines(a), "");
}

void expect_one(const Acceptance& a, const std::string& figure, const std::string& text) {
  ASSERT_EQ(a.reasons.size(), 1u);
  EXPECT_EQ(a.reasons[0].figure, figure);
  EXPECT_NE(a.reasons[0].text.find(text), std::string::npos) << a.reasons[0].text;
  EXPECT_FALSE(a.pass());
}

TEST(Acceptance, EachFigureAlone) {
  expect_one(accept(cylinder(), at_the_limits(), asking(0.95), false), "complete", "interrupted");
  VerifyReport sampled = at_the_limits();
  sampled.faces[0].overcut_bound_mm = 1.0;  // between the samples nobody has looked
  expect_one(accept(cylinder(), sampled, asking(0.95), false), "complete", "interrupted");
  expect_one(accept(cylinder(), at_the_limits(), asking(0.951)), "coverage_reachable", "95.000 % < 95.100 %");
  VerifyReport unread = at_the_limits();
  unread.unread_faces = {{"F4", "p.step, face F4 (#12 in the file): the CAD kernel cannot read it"}};
  expect_one(accept(cylinder(), unread, asking(0.95)), "unread_faces", "F4 is not checked: p.step, face F4 (#12");
  VerifyReport r = at_the_limits();
  r.faces[0].overcut_mm = r.overcut_mm = 0.0101;
  expect_one(accept(cylinder(), r, asking(0.95)), "overcut_mm", "F1 is gouged by 0.0101 mm > 0.01 mm");
  r = at_the_limits();
  ClearanceFigure figure;
  figure.kept = false;
  figure.obstacle = "F7";
  r.clearance.figures = {figure};
  expect_one(accept(cylinder(), r, asking(0.95)), "clearance", "the shank keeps ");
  expect_one(accept(tool_of({1, 30, 1, 30}), at_the_limits(), asking(0.95)), "legitimate", "profile is not valid");
}

// A face that nobody found cut is not good for that: it has to be proved, by samples too.
TEST(Acceptance, WhatIsNotProvedDoesNotPass) {
  VerifyReport r = at_the_limits();
  for (FaceVerdict& face : r.faces) face.overcut_bound_mm = 0.01;
  r.overcut_bound_mm = r.gouge_bound_mm = 0.01;
  r.depth = DepthProof::kProved;
  EXPECT_TRUE(accept(cylinder(), r, asking(0.95)).pass());
  r.faces[1].overcut_bound_mm = r.gouge_bound_mm = 0.0123;
  r.faces[1].bound_point = Vec3(1, 2, -3);
  expect_one(accept(cylinder(), r, asking(0.95)), "gouge_bound_mm",
             "F2 is not proved: gouge 0.0100 mm found, 0.0123 mm > 0.01 mm possible near (1.000, 2.000, -3.000)");
  r.depth = DepthProof::kSampled;
  expect_one(accept(cylinder(), r, asking(0.95)), "gouge_bound_mm", "between samples; leave out --sample for a proof");
  EXPECT_EQ(depth_text(r).substr(0, 10), "not proved");
}

TEST(Acceptance, CoverageThatIsNotProvedDoesNotPass) {
  VerifyReport r = at_the_limits();
  r.coverage_bound = 0.79;
  r.coverage_reachable_bound = 0.95;
  EXPECT_TRUE(accept(cylinder(), r, asking(0.95)).pass());
  r.coverage_reachable_bound = 0.94999;
  r.faces[0].uncovered_point = Vec3(1, 2, -3);
  expect_one(accept(cylinder(), r, asking(0.95)), "coverage_bound",
             "95.000 % of the accessible area measured, 94.999 % proved < 95.000 %; largest unproved area near (1.000, "
             "2.000, -3.000)");
  // A target that may be cut too deep says that, and nothing of its coverage.
  r.overcut_bound_mm = r.faces[0].overcut_bound_mm = 0.02;
  r.coverage_reachable_bound = 0.0;
  expect_one(accept(cylinder(), r, asking(0.95)), "overcut_bound_mm", "F1 is not proved");
}

TEST(Acceptance, NamesTheFacesThatAreEnteredDeepestFirst) {
  VerifyReport r = at_the_limits();
  r.faces[1].overcut_mm = 0.02;
  r.faces[2].overcut_mm = r.gouge_mm = 0.5;
  r.faces[2].deepest = WorstPlace{"F3", Vec3(1, 2, -3), -0.5, 1, 4.0, 2.0};
  const Acceptance a = accept(cylinder(), r, asking(0.95));
  ASSERT_EQ(a.reasons.size(), 2u);
  EXPECT_EQ(a.reasons[0].text, "F3 is gouged by 0.5000 mm > 0.01 mm at (1.000, 2.000, -3.000), pass 2");
  EXPECT_EQ(a.reasons[1].text, "F2 is gouged by 0.0200 mm > 0.01 mm");
  const auto json = nlohmann::json::parse(verify_to_json(r, a));
  EXPECT_EQ(json.at("pass"), false);
  EXPECT_EQ(json.at("reasons").at(0).at("figure"), "gouge_mm");
  EXPECT_EQ(json.at("reasons").at(1).at("text"), a.reasons[1].text);
  EXPECT_EQ(json.at("faces").at(2).at("deepest").at("strip"), 2);
}

/// Two layers whose cycles and sweeps are within 60 degrees.
TrochoidSummary two_layers() {
  TrochoidSummary cavity;
  cavity.most_engagement_deg = 60.0;
  for (int k = 0; k < 2; ++k) {
    LayerSummary layer;
    layer.cycles = 20;
    layer.status = "done";
    layer.front_deg = 60.0, layer.back_deg = 40.0, layer.side_deg = 30.0;
    cavity.layers.push_back(layer);
  }
  return cavity;
}

TEST(AcceptCavity, EveryMotionIsHeldToTheLimitOfTheEngagement) {
  Acceptance none;
  accept_cavity(two_layers(), none);
  EXPECT_TRUE(none.pass());
  TrochoidSummary cavity = two_layers();
  cavity.layers[1].side_deg = 178.25;
  Acceptance sweep;
  accept_cavity(cavity, sweep);
  ASSERT_EQ(sweep.reasons.size(), 1u);
  EXPECT_EQ(sweep.reasons[0].text, "layer 2: a finishing pass has an engagement of 178.25 degrees > 60 degrees");
  cavity = two_layers();
  cavity.layers[0].back_deg = 61.0;
  cavity.layers[1].status = "stuck";
  Acceptance both;
  accept_cavity(cavity, both);
  ASSERT_EQ(both.reasons.size(), 2u);
  EXPECT_EQ(both.reasons[0].text, "engagement 61.00 degrees > 60 degrees");
  EXPECT_EQ(both.reasons[1].text, "layer 2 is stuck after 20 cycles");
}

TEST(AcceptCavity, AReasonSaysWhatEndedTheCyclesOrWhyThereAreNone) {
  TrochoidSummary cavity = two_layers();
  cavity.layers[1].status = "stuck";
  cavity.layers[1].cycles = 81;
  cavity.layers[1].why = "no step stays within 60 degrees of engagement";
  Acceptance stuck, none;
  accept_cavity(cavity, stuck);
  ASSERT_EQ(stuck.reasons.size(), 1u);
  EXPECT_EQ(stuck.reasons[0].text, "layer 2 is stuck after 81 cycles: no step stays within 60 degrees of engagement");
  cavity.layers.clear();
  cavity.no_cycles = "sides finish 76 %";
  accept_cavity(cavity, none);
  ASSERT_EQ(none.reasons.size(), 1u);
  EXPECT_EQ(none.reasons[0].text, "no cycle was planned: sides finish 76 %");
}

TEST(AcceptStock, EveryKindOfStripIsHeldToTheLimitButForTheCells) {
  StockReport stock;
  stock.cell_mm = 0.1;
  stock.resolution_deg = 1.5;
  for (const char* kind : {"entry", "front", "back", "side", "link"}) stock.kinds.push_back({.kind = kind});
  for (StockKind& kind : stock.kinds) {
    kind.engagement_deg = 61.4;
    Acceptance within;
    accept_stock(stock, 60.0, 0.02, within);
    EXPECT_TRUE(within.pass()) << kind.kind;
    kind.engagement_deg = 61.6;
    kind.strip = 6;
    Acceptance over;
    accept_stock(stock, 60.0, 0.02, over);
    ASSERT_EQ(over.reasons.size(), 1u) << kind.kind;
    EXPECT_EQ(over.reasons[0].text, "stock simulation: " + move_words(kind.kind) +
                                        " with an engagement of 61.60 degrees > 60 + 1.50, pass 7");
    kind.engagement_deg = 0.0;
  }
}

TEST(AcceptStock, RampsAndPlungesCutASlotWhichNoLimitHolds) {
  StockReport stock;
  stock.cell_mm = 0.1;
  for (const char* kind : {"ramp", "plunge"})
    stock.kinds.push_back({.kind = kind, .engagement_deg = 180.0, .strip = 0});
  Acceptance acceptance;
  accept_stock(stock, 60.0, 0.02, acceptance);
  EXPECT_TRUE(acceptance.pass());
}

TEST(AcceptBends, EachEndIsHeldToTheRadiusThatIsAskedFor) {
  const BendRadii bends{.tip_mm = 12.5, .holder_end_mm = 4.0};
  FitJob job;
  Acceptance a;
  accept_bends(job, bends, a);
  EXPECT_TRUE(a.pass()) << "nothing was asked";
  job.min_bend_radius_mm = 4.0;
  accept_bends(job, bends, a);
  EXPECT_TRUE(a.pass()) << "at the limit";
  job.min_bend_radius_mm = 5.0;
  accept_bends(job, bends, a);
  expect_one(a, "bend_radius", "the path of the holder end: 4 mm < 5 mm");
  job.min_bend_radius_mm = 20.0;
  a = {};
  accept_bends(job, bends, a);
  EXPECT_EQ(a.reasons.size(), 2u);
  a = {};
  accept_bends(job, {}, a);
  EXPECT_TRUE(a.pass()) << "a straight path";
  accept_bends(CoverJob(), bends, a);
  EXPECT_TRUE(a.pass());
}

/// The cautions of one figure.
std::vector<std::string> cautions(const Acceptance& a, Figure figure) {
  std::vector<std::string> texts;
  for (const Shortfall& caution : a.cautions)
    if (caution.figure == figure_name(figure)) texts.push_back(caution.text);
  return texts;
}

TEST(Acceptance, WhatIsLeftOfTheWholeFaceIsACautionAndOnDemandAReason) {
  VerifyReport r = at_the_limits();
  r.undercut_mm = 2.1;
  r.reach_radius_mm = 8.0;
  r.finer_reach = {1.25, 0.96};
  const Acceptance open = accept(whole_tool(), r, asking(0.95));
  EXPECT_TRUE(open.pass());
  ASSERT_EQ(cautions(open, Figure::kWholeCoverage).size(), 1u);
  EXPECT_EQ(cautions(open, Figure::kWholeCoverage)[0],
            "20.00 % of the face is not finished, up to 2.1 mm of excess material; a tool of radius 1.2 mm would reach "
            "96.0 %");
  r.least_left = LeastLeft{"F1", Vec3(1, 2, 3), 2.1, 8.0, 0.9};
  EXPECT_NE(cautions(accept(whole_tool(), r, asking(0.95)), Figure::kWholeCoverage)[0].find(
                "; at (1.000, 2.000, 3.000) every tool with no radius below 8 mm leaves or cuts 0.9 mm or more"),
            std::string::npos);
  // Rounded the way that keeps it true.
  r.least_left->radius_mm = 4.2925;
  r.least_left->bound_mm = 0.618;
  EXPECT_NE(cautions(accept(whole_tool(), r, asking(0.95)), Figure::kWholeCoverage)[0].find(
                "every tool with no radius below 4.3 mm leaves or cuts 0.61 mm or more"),
            std::string::npos);
  r.least_left->bound_mm = 0.5 * r.tolerance_mm;
  EXPECT_EQ(cautions(accept(whole_tool(), r, asking(0.95)), Figure::kWholeCoverage)[0],
            cautions(open, Figure::kWholeCoverage)[0])
      << "such a tool may finish it";
  JudgeRequest whole = asking(0.95);
  whole.least_whole = 0.9;
  expect_one(accept(whole_tool(), r, whole), "coverage", "90.000 % of the whole face is required");
  // Measured is not proved.
  r.coverage = 0.92;
  r.coverage_bound = 0.89;
  r.coverage_reachable_bound = 0.95;
  expect_one(accept(whole_tool(), r, whole), "coverage", "is not proved: 92.000 % measured, 89.000 % proved");
  r.coverage_bound = 0.9;
  EXPECT_TRUE(accept(whole_tool(), r, whole).pass());
}

TEST(Acceptance, BendingIsACautionWhereItTakesTheErrorBeyondTheTolerance) {
  VerifyReport r = at_the_limits();
  r.tolerance_mm = 0.05;
  r.bending = BendingReport{.overcut_mm = 0.01, .undercut_mm = 0.04, .bent_overcut_mm = 0.01, .bent_undercut_mm = 0.05};
  EXPECT_TRUE(cautions(accept(whole_tool(), r, asking(0.95)), Figure::kBending).empty()) << "within it";
  r.bending->bent_undercut_mm = 0.062;
  r.bending->most_point = Vec3(1, 2, 3);
  const Acceptance bent = accept(whole_tool(), r, asking(0.95));
  ASSERT_EQ(cautions(bent, Figure::kBending).size(), 1u);
  EXPECT_EQ(
      cautions(bent, Figure::kBending)[0],
      "where the tool bends under the load, it gouges by 0.010 mm and leaves 0.062 mm (stiff: 0.010 and 0.040), by "
      "samples; most is added at (1.000, 2.000, 3.000)");
  r.bending->undercut_mm = 0.07;
  EXPECT_TRUE(cautions(accept(whole_tool(), r, asking(0.95)), Figure::kBending).empty()) << "bending has made it less";
}

TEST(Acceptance, AShankOrHolderThatIsNotGivenIsACaution) {
  VerifyReport r = at_the_limits();
  r.coverage = 1.0;
  const auto said = [&](const Tool& tool) {
    const Acceptance a = accept(tool, r, asking(0.95));
    EXPECT_TRUE(a.pass());
    const std::vector<std::string> texts = cautions(a, Figure::kBodyUnknown);
    return texts.empty() ? std::string() : texts.front();
  };
  EXPECT_EQ(said(whole_tool()), "");
  EXPECT_EQ(said(cylinder()), "shank and holder were not given and not checked");
  Tool shank = whole_tool(), holder = whole_tool();
  shank.holder.clear();
  holder.shank.clear();
  EXPECT_EQ(said(shank), "the holder was not given and not checked");
  EXPECT_EQ(said(holder), "the shank was not given and not checked");
  r.hold.emplace().as_thick = ClearanceFigure{.clearance_mm = -1.5, .kept = false, .obstacle = "F11", .strip = 2};
  EXPECT_NE(said(cylinder())
                .find("would collide with F11 by 1.5 mm within one diameter above it, pass 3; the flank is 20 mm long"),
            std::string::npos)
      << said(cylinder());
}

TEST(Acceptance, WhereTheAxisRunsThroughThePartNothingHoldsTheTool) {
  VerifyReport r = at_the_limits();
  r.hold.emplace().axis = {.body = ToolBody::kAxis, .clearance_mm = -0.3, .kept = false, .obstacle = "F8", .strip = 0};
  for (const Tool& tool : {cylinder(), whole_tool()})
    expect_one(accept(tool, r, asking(0.95)), "hold", "above the flank its axis runs through F8");
}

}  // namespace
}  // namespace flank::internal
