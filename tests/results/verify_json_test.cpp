#include "flank/results/verify_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "flank/error.h"

namespace flank::internal {
namespace {

VerifyReport full_report() {
  VerifyReport r;
  r.verdict = Verdict::kGouge;
  r.tolerance_mm = 0.01;
  r.coverage = 0.9731415926535897;
  r.reachable_share = 0.9;
  r.coverage_reachable = 1.0 / 1.1;
  r.reach_radius_mm = 1.5;
  r.overcut_mm = 1.0 / 3.0;
  r.undercut_mm = 1e300;
  r.undercut_covered_mm = 2e-7;
  r.rms_mm = 0.1;
  r.gouge_mm = 0.25;
  r.coverage_bound = 0.875;
  r.coverage_reachable_bound = 0.9;
  r.sampling_bound_mm = 3e-4;
  r.depth = DepthProof::kProved;
  r.overcut_bound_mm = 0.35;
  r.gouge_bound_mm = 0.26;
  r.faces = {{"F1",
              true,
              120.5,
              6,
              4000,
              1.0 / 3.0,
              1e300,
              Vec3(1.0 / 7.0, 3, 4),
              2e-7,
              0.1,
              0.97,
              0.9,
              0.99,
              1.0 / 3.0,
              0.875,
              Vec3(1.0 / 7.0, 8, 9),
              55,
              0.2,
              3e-4,
              0.35,
              Vec3(1.0 / 7.0, 5, 6),
              77,
              {}},
             {"F2",
              false,
              7.0,
              1,
              12,
              0.25,
              0,
              Vec3::Zero(),
              0,
              0,
              0,
              0,
              0,
              0.0,
              0.0,
              Vec3::Zero(),
              0,
              0.2,
              0.01,
              0.26,
              Vec3::Zero(),
              9,
              WorstPlace{"F2", Vec3(4, 5, 1.0 / 3.0), -0.25, 0, 1.5, 2.5}}};
  r.worst = {{"F1", Vec3(1.0 / 7.0, 2, 3), -1.0 / 3.0, 2, 12.25, 7.5}, {"F2", Vec3(4, 5, 6), -0.25, -1, 0, 0}};
  r.histogram_edges_mm = {-0.02, 0.0, 0.02};
  r.histogram_area_mm2 = {100.5, 20.0};
  r.clearance.figures = {
      {ToolBody::kShank, ObstacleRole::kTarget, 1.0 / 7.0, 1e-3, -0.01, true, "F1", Vec3(1, 2, 1.0 / 3.0), 0, 3.25,
       70.5, 4.0},
      {ToolBody::kHolder, ObstacleRole::kFixture, 1e300 * 1e300, 0.0, 2.0, true, "", Vec3::Zero(), -1, 0.0, 0.0, 0.0}};
  r.stock = StockReport{.cell_mm = 0.1,
                        .resolution_deg = 1.0 / 3.0,
                        .before_mm3 = 100.0,
                        .left_mm3 = 1.0 / 7.0,
                        .kinds = {{"front", 59.5, 3, 12, 7.25, 100.0, 55.0}, {"link", 0.0, -1, 0, 0.0, 20.0, 0.0}},
                        .uncut_mm = 0.05,
                        .uncut_point = Vec3(1.0 / 3.0, 2, 3),
                        .entered_mm = 0.002,
                        .strip_deg = {59.5, 0.0},
                        .strip_mm3 = {55.0, 0.0},
                        .strip_mm = {100.0, 20.0}};
  r.least_left = LeastLeft{"F1", Vec3(1.0 / 7.0, 3, 4), 2.5, 1.0 / 3.0, 0.1};
  r.bending = BendingReport{.overcut_mm = 0.01,
                            .undercut_mm = 0.02,
                            .bent_overcut_mm = 0.005,
                            .bent_undercut_mm = 1.0 / 30.0,
                            .least_mm = -0.001,
                            .most_mm = 1.0 / 70.0,
                            .most_point = Vec3(1.0 / 3.0, 5, 6),
                            .samples = 573};
  return r;
}

TEST(VerifyJson, ReadsBackWhatItWrote) {
  const VerifyReport a = full_report();
  const VerifyReport b = verify_from_json(verify_to_json(a, {}), "verify.json");
  EXPECT_EQ(verify_to_json(a, {}), verify_to_json(b, {}));
  EXPECT_EQ(b.verdict, a.verdict);
  EXPECT_EQ(b.coverage, a.coverage);
  EXPECT_EQ(b.reachable_share, a.reachable_share);
  EXPECT_EQ(b.coverage_reachable, a.coverage_reachable);
  EXPECT_EQ(b.coverage_bound, a.coverage_bound);
  EXPECT_EQ(b.coverage_reachable_bound, a.coverage_reachable_bound);
  EXPECT_EQ(b.reach_radius_mm, a.reach_radius_mm);
  EXPECT_EQ(b.faces[0].coverage_reachable, 0.99);
  EXPECT_EQ(b.overcut_mm, a.overcut_mm);
  EXPECT_EQ(b.undercut_mm, a.undercut_mm);
  ASSERT_EQ(b.faces.size(), 2u);
  EXPECT_EQ(b.faces[0].samples, 4000u);
  EXPECT_FALSE(b.faces[1].target);
  EXPECT_EQ(b.faces[0].coverage_bound, 1.0 / 3.0);
  EXPECT_EQ(b.faces[0].coverage_reachable_bound, 0.875);
  EXPECT_EQ(b.faces[0].undercut_point, Vec3(1.0 / 7.0, 3, 4));
  EXPECT_EQ(b.faces[0].uncovered_point, Vec3(1.0 / 7.0, 8, 9));
  EXPECT_EQ(b.faces[0].cover_cells, 55u);
  EXPECT_EQ(b.faces[1].sampling_bound_mm, 0.01);
  EXPECT_EQ(b.depth, DepthProof::kProved);
  EXPECT_EQ(b.faces[0].overcut_bound_mm, 0.35);
  EXPECT_EQ(b.faces[0].bound_point, a.faces[0].bound_point);
  EXPECT_EQ(b.faces[0].proof_cells, 77u);
  EXPECT_FALSE(b.faces[0].deepest);
  ASSERT_TRUE(b.faces[1].deepest);
  EXPECT_EQ(b.faces[1].deepest->point, a.faces[1].deepest->point);
  EXPECT_EQ(b.faces[1].deepest->t, 1.5);
  ASSERT_EQ(b.worst.size(), 2u);
  EXPECT_EQ(b.worst[0].point, a.worst[0].point);
  EXPECT_EQ(b.worst[0].strip, 2);
  EXPECT_EQ(b.worst[1].strip, -1);
  EXPECT_EQ(b.histogram_area_mm2, a.histogram_area_mm2);
  ASSERT_EQ(b.clearance.figures.size(), 2u);
  const ClearanceFigure &shank = b.clearance.figures[0], &holder = b.clearance.figures[1];
  EXPECT_EQ(shank.body, ToolBody::kShank);
  EXPECT_EQ(shank.role, ObstacleRole::kTarget);
  EXPECT_EQ(shank.clearance_mm, 1.0 / 7.0);
  EXPECT_EQ(shank.point, a.clearance.figures[0].point);
  EXPECT_EQ(shank.t, 3.25);
  EXPECT_TRUE(std::isinf(holder.clearance_mm));
  EXPECT_EQ(holder.strip, -1);
  ASSERT_TRUE(b.stock);
  EXPECT_EQ(b.stock->left_mm3, 1.0 / 7.0);
  EXPECT_EQ(b.stock->uncut_point, a.stock->uncut_point);
  ASSERT_EQ(b.stock->kinds.size(), 2u);
  EXPECT_EQ(b.stock->kinds[0].strip, 3);
  EXPECT_EQ(b.stock->kinds[1].strip, -1);
  EXPECT_EQ(b.stock->cycles_deg(), 59.5);
  EXPECT_EQ(b.stock->strip_mm3, a.stock->strip_mm3);
  ASSERT_TRUE(b.least_left);
  EXPECT_EQ(b.least_left->point, Vec3(1.0 / 7.0, 3, 4));
  EXPECT_EQ(b.least_left->radius_mm, 1.0 / 3.0);
  EXPECT_EQ(b.least_left->bound_mm, 0.1);
  ASSERT_TRUE(b.bending);
  EXPECT_EQ(b.bending->bent_undercut_mm, 1.0 / 30.0);
  EXPECT_EQ(b.bending->most_point, a.bending->most_point);
  EXPECT_EQ(b.bending->samples, 573u);
}

TEST(VerifyJson, AFigureThatIsNoneIsNotReadAsInfinite) {
  VerifyReport r = full_report();
  r.overcut_mm = std::numeric_limits<double>::quiet_NaN();
  r.gouge_mm = -std::numeric_limits<double>::infinity();
  r.undercut_mm = std::numeric_limits<double>::infinity();
  const VerifyReport back = verify_from_json(verify_to_json(r, {}), "verify.json");
  EXPECT_TRUE(std::isnan(back.overcut_mm));
  EXPECT_EQ(back.gouge_mm, r.gouge_mm);
  EXPECT_EQ(back.undercut_mm, r.undercut_mm);
}

TEST(VerifyJson, NothingRunIsReadableToo) {
  const VerifyReport b = verify_from_json(verify_to_json(VerifyReport{}, {}), "verify.json");
  EXPECT_EQ(b.verdict, Verdict::kNotRun);
  EXPECT_TRUE(b.faces.empty());
}

std::string message_of(const std::string& text) {
  try {
    (void)verify_from_json(text, "out/verify.json");
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(VerifyJson, RefusesOtherText) {
  EXPECT_NE(message_of("").find("out/verify.json"), std::string::npos);
  EXPECT_NE(message_of("[1, 2]").find("out/verify.json"), std::string::npos);
  EXPECT_NE(message_of(R"({"schema": "openflank/tool/1"})").find("expected openflank/verify/1"), std::string::npos);
  std::string text = verify_to_json(full_report(), {});
  text.replace(text.find("\"shank\""), 7, "\"shaft\"");
  EXPECT_NE(message_of(text).find("shaft"), std::string::npos);
  text = verify_to_json(full_report(), {});
  text.replace(text.find("\"gouge\""), 7, "\"maybe\"");
  EXPECT_NE(message_of(text).find("maybe"), std::string::npos);
  text = verify_to_json(full_report(), {});
  text.replace(text.find("\"coverage\""), 10, "\"cover\"   ");
  EXPECT_FALSE(message_of(text).empty());
}

/// A cavity judged again from its folder met its request with cycles that had ended early.
TEST(VerifyJson, WhatWasNotPlannedOfACavityIsKept) {
  Acceptance kept;
  keep_planned(R"({"reasons": [{"figure": "coverage_reachable", "text": "a"}, {"figure": "cycles", "text": "b"},
                               {"figure": "engagement", "text": "c"}]})",
               "summary.json", kept);
  ASSERT_EQ(kept.reasons.size(), 2u);
  EXPECT_EQ(kept.reasons[0].text, "b");
  EXPECT_EQ(kept.reasons[1].figure, "engagement");
  keep_planned("{}", "summary.json", kept);
  EXPECT_EQ(kept.reasons.size(), 2u);
  EXPECT_THROW(keep_planned("no json", "summary.json", kept), InputError);
  EXPECT_THROW(keep_planned(R"({"reasons": [1]})", "summary.json", kept), InputError);
}

}  // namespace
}  // namespace flank::internal
