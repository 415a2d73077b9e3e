// Every figure of the verdict, turned false alone: whatever tells a verdict says no, and names it. The list is the library's own, so a
// figure that is new is asked for here without anybody thinking of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "flank/results/acceptance.h"
#include "flank/results/verify_json.h"
#include "flank/results/write_result.h"

namespace flank::internal {
namespace {

std::vector<Figure> figures() {
  std::vector<Figure> all;
  for (std::size_t k = 0; k < kFigureNames.size(); ++k) all.push_back(static_cast<Figure>(k));
  return all;
}

constexpr const char* kWhy = "this is why";

/// A result with nothing wrong: a cylinder that touches one face.
Result sound() {
  Result result;
  FitJob job;
  job.part.file = "part.step";
  job.tolerance_mm = 0.01;
  job.judge.least_coverage = 0.95;
  job.min_bend_radius_mm = 2.0;
  result.job = job;
  result.tool.radial = RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 3.0));
  result.tool.shank = {{20.0, 3.0}, {50.0, 3.0}};
  result.tool.holder = {{50.0, 10.0}, {90.0, 10.0}};
  result.verify.verdict = Verdict::kPass;
  result.verify.tolerance_mm = 0.01;
  result.verify.coverage = result.verify.coverage_reachable = 1.0;
  for (const char* name : {"F1", "F2"}) {
    FaceVerdict face;
    face.face = name;
    face.target = result.verify.faces.empty();
    result.verify.faces.push_back(face);
  }
  return result;
}

/// Spoils what the figure is about, so that the rule of acceptance finds it. False: the rule of results does not ask for it, since it
/// is about programs, or is found while the part is read.
bool turn_false(Figure figure, Result& result) {
  VerifyReport& verify = result.verify;
  TrochoidSummary cavity;
  cavity.layers.emplace_back().status = "done";
  switch (figure) {
    case Figure::kComplete:
      result.complete = false;
      return true;
    case Figure::kLegitimate:
      result.tool.radial = RadialFunction::spline(20.0, Eigen::Vector4d(1.0, 30.0, 1.0, 30.0));
      return true;
    case Figure::kOvercut:
      verify.faces[0].overcut_mm = verify.overcut_mm = 1.0;
      return true;
    case Figure::kGouge:
      verify.faces[1].overcut_mm = verify.gouge_mm = 1.0;
      return true;
    case Figure::kBuried:
      verify.buried.push_back({0, Vec3::Zero()});
      return true;
    case Figure::kOvercutBound:
      verify.faces[0].overcut_bound_mm = verify.overcut_bound_mm = 1.0;
      return true;
    case Figure::kGougeBound:
      verify.faces[1].overcut_bound_mm = verify.gouge_bound_mm = 1.0;
      return true;
    case Figure::kCoverage:
      verify.coverage_reachable = 0.5;
      return true;
    case Figure::kCoverageBound:
      verify.coverage_bound = 1.0;
      verify.coverage_reachable_bound = 0.5;
      return true;
    case Figure::kClearance:
      verify.clearance.figures.emplace_back().kept = false;
      return true;
    case Figure::kStock:
      verify.stock.emplace().uncut_mm = 5.0;
      result.job = TrochoidJob();
      return true;
    case Figure::kBendRadius:
      result.bends.tip_mm = 1.0;
      return true;
    case Figure::kEngagement:
      cavity.layers[0].front_deg = 90.0;
      result.plan = cavity;
      return true;
    case Figure::kCycles:
      cavity.layers[0].status = "stuck";
      result.plan = cavity;
      return true;
    case Figure::kUnreadFaces:
      verify.unread_faces.push_back({"F4", "the CAD kernel cannot read it"});
      return true;
    case Figure::kWholeCoverage:
      std::get<FitJob>(result.job).judge.least_whole = 0.9;
      verify.coverage = 0.5;
      return true;
    case Figure::kTurn:
      verify.turn = TurnFigure{.angle_deg = 40.0};
      return true;
    case Figure::kHold:
      verify.hold.emplace().axis.kept = false;
      return true;
    default:
      return false;
  }
}

bool names_it(const nlohmann::json& list, Figure figure) {
  return list.size() == 1 && list[0].at("figure") == figure_name(figure) && list[0].at("text") == kWhy;
}

TEST(EveryFigure, HasANameOfItsOwn) {
  std::set<std::string_view> names(kFigureNames.begin(), kFigureNames.end());
  EXPECT_EQ(names.size(), kFigureNames.size());
  EXPECT_FALSE(names.contains(""));
}

TEST(EveryFigure, TurnedFalseAloneIsNoInEveryFile) {
  const Result result = sound();
  ASSERT_TRUE(result.acceptance().pass()) << reason_lines(result.acceptance());
  for (const Figure figure : figures()) {
    SCOPED_TRACE(figure_name(figure));
    Acceptance no;
    add_reason(no, figure, kWhy);
    EXPECT_FALSE(no.pass());
    EXPECT_NE(reason_lines(no).find(kWhy), std::string::npos);
    PostOutcome post;
    post.acceptance = no;
    for (const std::string& text : {verify_to_json(result.verify, no), summary_json(result, no), post_json(post)}) {
      const auto json = nlohmann::json::parse(text);
      EXPECT_EQ(json.at("pass"), false);
      EXPECT_TRUE(names_it(json.at("reasons"), figure)) << json.at("reasons");
      EXPECT_TRUE(json.at("cautions").empty());
      EXPECT_TRUE(!json.contains("within") || json["within"] == false);
    }
    EXPECT_NE(post_text(post).find(kWhy), std::string::npos);
    Verification verification;
    verification.acceptance = no;
    EXPECT_NE(verify_text(verification).find("does NOT meet the request"), std::string::npos);
  }
}

TEST(EveryFigure, ACautionIsToldBesideAYes) {
  const Result result = sound();
  for (const Figure figure : figures()) {
    SCOPED_TRACE(figure_name(figure));
    Acceptance amber;
    add_caution(amber, figure, kWhy);
    EXPECT_TRUE(amber.pass());
    EXPECT_NE(reason_lines(amber).find(std::string("CAUTION     ") + kWhy), std::string::npos);
    PostOutcome post;
    post.acceptance = amber;
    for (const std::string& text :
         {verify_to_json(result.verify, amber), summary_json(result, amber), post_json(post)}) {
      const auto json = nlohmann::json::parse(text);
      EXPECT_EQ(json.at("pass"), true);
      EXPECT_TRUE(json.at("reasons").empty());
      EXPECT_TRUE(names_it(json.at("cautions"), figure)) << json.at("cautions");
    }
  }
}

TEST(EveryFigure, ThatAResultCanFailByIsFoundByTheRule) {
  int found = 0;
  for (const Figure figure : figures()) {
    SCOPED_TRACE(figure_name(figure));
    Result result = sound();
    if (!turn_false(figure, result)) continue;
    ++found;
    const Acceptance acceptance = result.acceptance();
    EXPECT_FALSE(acceptance.pass());
    for (const Shortfall& reason : acceptance.reasons) EXPECT_EQ(reason.figure, figure_name(figure)) << reason.text;
    EXPECT_EQ(nlohmann::json::parse(summary_json(result)).at("pass"), false);
    const std::string text = summary_text(result);
    EXPECT_NE(text.find("does NOT meet the request"), std::string::npos);
    for (const Shortfall& reason : acceptance.reasons) EXPECT_NE(text.find(reason.text), std::string::npos);
  }
  EXPECT_GE(found, 14);
}

}  // namespace
}  // namespace flank::internal
