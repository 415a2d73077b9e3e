// What a result says of itself: whether it meets its request, totals of its plan, summaries. The commands that make results
// are in pipeline (run_fit, run_cover, run_trochoid; pipeline/folder).
#include "flank/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "flank/io/text/json_dump.h"
#include "flank/job/command_line.h"
#include "flank/results/acceptance.h"
#include "flank/results/cavity/stock_json.h"
#include "flank/results/plan_json.h"
#include "flank/results/ranking_json.h"
#include "flank/results/verify_json.h"
#include "flank/results/verify_text.h"
#include "flank/results/write_result.h"

namespace flank {
using namespace internal;
namespace {

/// Interrupted before there was a verdict.
bool was_stopped(const Result& result) { return !result.complete && result.verify.verdict == Verdict::kNotRun; }

std::string bend_text(double radius_mm) {
  return radius_mm < 1e6 ? fmt::format("{:.3g} mm", radius_mm) : std::string("none");
}

/// What the path leaves, by the judge.
std::string error_lines(const Result& result) {
  const VerifyReport& v = result.verify;
  std::string text;
  text += fmt::format("  path        {} pass{}, {} CL points, chord error {:.2g} mm, largest axial slip |c| {:.3f}{}\n",
                      result.path.strips.size(), result.path.strips.size() == 1 ? "" : "es", result.path.pose_count(),
                      result.chord_bound_mm, result.largest_c,
                      v.turn ? fmt::format(", largest change of direction {:.1f} degrees", v.turn->angle_deg) : "");
  text += fmt::format("  curvature   smallest radius {} at the tip, {} at the holder end\n",
                      bend_text(result.bends.tip_mm), bend_text(result.bends.holder_end_mm));
  if (was_stopped(result)) return text + "  checked     no: interrupted\n";
  text += fmt::format("  finished    {:.2f} % of the whole face within {} mm\n", 100.0 * v.coverage, v.tolerance_mm);
  text += "  " + reach_text(v) + "\n";
  text += fmt::format("  gouge       {:.4f} mm\n", v.overcut_mm);
  text += fmt::format("  excess      {:.4f} mm of material where the tool passes, {:.4f} mm anywhere on the face\n",
                      v.undercut_covered_mm, v.undercut_mm);
  text += fmt::format("  rms error   {:.4f} mm where the tool passes\n", v.rms_mm);
  if (std::any_of(v.faces.begin(), v.faces.end(), [](const FaceVerdict& face) { return !face.target; }))
    text += fmt::format("  other faces {:.4f} mm deepest gouge\n", v.gouge_mm);
  text += "  checked     " + depth_text(v) + "\n";
  return text;
}

/// Every kind of job machines a part; this is its file and faces.
PartRequest part_of(const PlanJob& job) {
  return std::visit([](const auto& plan) { return machined(plan); }, job);
}

/// Name, family and size. The smallest and largest radius are looked for in 101 places: families may have them
/// inside.
std::string tool_line(const Tool& tool) {
  const double length = tool.radial.axis_length();
  double low = 1e300, high = 0.0;
  for (int j = 0; j <= 100; ++j) {
    const double r = tool.radial.at(length * j / 100.0).r;
    low = std::min(low, r);
    high = std::max(high, r);
  }
  const std::string family(family_name(tool.radial.family()));
  const std::string name = tool.name.empty() || tool.name == family ? family : tool.name + " (" + family + ")";
  return fmt::format("  tool        {}, axis {:.3f} mm, radius {:.3f} to {:.3f} mm\n", name, length, low, high);
}

/// MATH.md, section 11, as one number that people can compare: the cylinder that bends as much.
std::string stiffness_line(const Tool& tool) {
  const Stiffness bent = stiffness(tool);
  return fmt::format(
      "  stiffness   L:D {:.2f}: bends as a cylinder of diameter {:.2f} mm, {:.2f} mm long; tip deflection {:.2f} um "
      "at {:.0f} N (carbide)\n",
      bent.slenderness, bent.equivalent_diameter_mm, bent.length_mm, bent.deflection_um, kStiffnessForce);
}

/// The judge's figures; of a result that nobody has judged there are none.
void add_verdict(const Result& result, nlohmann::ordered_json& json) {
  const VerifyReport& v = result.verify;
  const bool judged = !was_stopped(result);
  const auto figure = [&](const char* key, double value) {
    json[key] = judged ? nlohmann::ordered_json(value) : nullptr;
  };
  if (!judged) json["judged"] = false;
  json["tolerance"] = v.tolerance_mm;
  if (v.allowance_mm > 0.0) json["allowance"] = v.allowance_mm;
  figure("coverage", v.coverage);
  figure("reachable_share", v.reachable_share);
  figure("coverage_reachable", v.coverage_reachable);
  if (v.coverage_reachable_bound) json["coverage_reachable_bound"] = *v.coverage_reachable_bound;
  figure("reach_radius", v.reach_radius_mm);
  json["least_coverage"] = std::visit([](const auto& plan) { return plan.judge.least_coverage; }, result.job);
  figure("overcut", v.overcut_mm);
  figure("undercut", v.undercut_mm);
  // Without a path nothing is as far from the target as anything.
  if (result.path.pose_count() == 0) json["undercut"] = nullptr;
  figure("undercut_covered", v.undercut_covered_mm);
  figure("rms", v.rms_mm);
  figure("other_faces_overcut", v.gouge_mm);
  figure("sampling_bound", v.sampling_bound_mm);
  json["depth"] = depth_name(v.depth);
  figure("overcut_bound", v.overcut_bound_mm);
  figure("other_faces_overcut_bound", v.gouge_bound_mm);
  for (const SheetSide& side : v.sheet_sides) json["sides"].push_back(sheet_side_to_json(side));
  if (!v.clearance.figures.empty()) json["clearance"] = clearance_to_json(v.clearance);
}

nlohmann::ordered_json shortfalls_json(const std::vector<Shortfall>& shortfalls) {
  auto list = nlohmann::ordered_json::array();
  for (const Shortfall& one : shortfalls) list.push_back({{"figure", one.figure}, {"text", one.text}});
  return list;
}

nlohmann::ordered_json bends_json(const BendRadii& bends) {
  // Null: no bend at all.
  const auto radius = [](double mm) { return mm < 1e300 ? nlohmann::ordered_json(mm) : nullptr; };
  return {{"tip", radius(bends.tip_mm)}, {"holder_end", radius(bends.holder_end_mm)}};
}

}  // namespace

Acceptance Result::acceptance() const {
  const JudgeRequest& request = std::visit([](const auto& asked) -> const JudgeRequest& { return asked.judge; }, job);
  Acceptance out = accept(tool, verify, request, complete);
  if (complete) accept_bends(job, bends, out);
  if (const auto* cavity = std::get_if<TrochoidSummary>(&plan)) accept_cavity(*cavity, out);
  if (const auto* cavity = std::get_if<TrochoidJob>(&job); cavity && verify.stock)
    accept_stock(*verify.stock, cavity->cycles.most_engagement_deg, verify.tolerance_mm, out);
  return out;
}

double TrochoidSummary::largest_deg() const {
  double largest = 0.0;
  for (const LayerSummary& layer : layers) largest = std::max({largest, layer.front_deg, layer.back_deg});
  return largest;
}

double TrochoidSummary::way_mm() const {
  double way = 0.0;
  for (const LayerSummary& layer : layers) way += layer.entry_mm + layer.fronts_mm + layer.backs_mm + layer.sides_mm;
  return way;
}

bool TrochoidSummary::done() const {
  return !layers.empty() &&
         std::all_of(layers.begin(), layers.end(), [](const LayerSummary& layer) { return layer.status == "done"; });
}

TargetCover CoverSummary::whole() const {
  TargetCover whole;
  double reachable = 0.0, before = 0.0, after = 0.0, milled = 0.0;  // mm^2
  for (const TargetCover& t : targets) {
    whole.faces += (whole.faces.empty() ? "" : ",") + t.faces;
    whole.area_mm2 += t.area_mm2;
    whole.seeds += t.seeds;
    whole.lines += t.lines;
    whole.grown += t.grown;
    whole.strips += t.strips;
    whole.links_mm += t.links_mm;
    whole.overcut_mm = std::max(whole.overcut_mm, t.overcut_mm);
    const double reached = t.reachable * t.area_mm2;
    reachable += reached;
    before += t.before * reached;
    after += t.after * reached;
    milled += (1.0 + t.overlap) * t.after * reached;
  }
  if (whole.area_mm2 > 0.0) whole.reachable = reachable / whole.area_mm2;
  if (reachable > 0.0) {
    whole.before = before / reachable;
    whole.after = after / reachable;
  }
  if (after > 0.0) whole.overlap = milled / after - 1.0;
  return whole;
}

std::string summary_text(const Result& result) {
  const PartRequest part = part_of(result.job);
  std::string text = fmt::format("{} {}\n", part.file, part.target_text());
  // What was asked for stands first: a verdict is about that and nothing else.
  text += fmt::format("  request     {}\n", fmt::join(asked_for(result.job), ", "));
  text += tool_line(result.tool) + stiffness_line(result.tool);
  if (const std::string left = allowance_text(result.verify); !left.empty()) text += "  allowance   " + left + "\n";
  text += result.path.pose_count() > 0 ? error_lines(result) : "  path        no pass: nothing is machined\n";
  text += sheet_side_text(result.verify) + clearance_text(result.verify.clearance);
  if (result.verify.stock) text += stock_text(*result.verify.stock);
  text += plan_lines(result);
  if (result.ranking) text += ranking_table(*result.ranking);
  for (const std::string& note : result.notes) text += "  note        " + note + "\n";
  // To people only: summary.json is the same for the same input, and times are not.
  text += "  time       ";
  for (const auto& [stage, seconds] : result.seconds) text += fmt::format(" {} {:.2f} s", stage, seconds);
  const Acceptance acceptance = result.acceptance();
  text += fmt::format("\n  verdict     {}{}\n", acceptance.pass() ? "meets the request" : "does NOT meet the request",
                      result.complete ? "" : " (interrupted: incomplete)");
  text += reason_lines(acceptance);
  return text;
}

std::string summary_json(const Result& result) { return internal::summary_json(result, result.acceptance()); }

std::string internal::summary_json(const Result& result, const Acceptance& acceptance) {
  nlohmann::ordered_json json;
  json["schema"] = "openflank/summary/1";
  json["units"] = "mm";
  json["part"] = part_of(result.job).file;
  json["faces"] = part_of(result.job).target_text();
  json["complete"] = result.complete;
  json["within"] = json["pass"] = acceptance.pass();
  json["reasons"] = shortfalls_json(acceptance.reasons);
  json["cautions"] = shortfalls_json(acceptance.cautions);
  add_verdict(result, json);
  json["chord_bound"] = result.chord_bound_mm;
  json["largest_c"] = result.largest_c;
  if (result.verify.turn) json["largest_turn"] = result.verify.turn->angle_deg;
  json["bend_radius"] = bends_json(result.bends);
  if (const auto* fit = std::get_if<FitJob>(&result.job); fit != nullptr && fit->min_bend_radius_mm)
    json["least_bend_radius"] = *fit->min_bend_radius_mm;
  json["diagonal"] = result.diagonal_mm;
  json["axis_length"] = result.tool.radial.axis_length();
  const Stiffness bent = stiffness(result.tool);
  json["slenderness"] = bent.slenderness;
  json["equivalent_diameter"] = bent.equivalent_diameter_mm;
  json["tip_deflection_um_per_100N"] = bent.deflection_um;
  json["strips"] = result.path.strips.size();
  json["poses"] = result.path.pose_count();
  add_plan(result, json);
  if (result.ranking) json["ranking"] = ranking_entries(*result.ranking);
  json["notes"] = result.notes;
  return dumped(json, 2) + "\n";
}

}  // namespace flank
