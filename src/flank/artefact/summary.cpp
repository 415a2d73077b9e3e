// The summary of a fit: a table for people, JSON for programs.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "flank/artefact/acceptance.h"
#include "flank/artefact/cavity/stock_json.h"
#include "flank/artefact/cavity/trochoid_json.h"
#include "flank/artefact/clearance_text.h"
#include "flank/artefact/ranking_json.h"
#include "flank/artefact/verify_json.h"
#include "flank/io/text/json_dump.h"
#include "flank/job/command_line.h"
#include "flank/run.h"

namespace flank {
using namespace internal;
namespace {

/// A share as people read it.
std::string percent(double share) { return fmt::format("{:.2f} %", 100.0 * share); }

/// Interrupted before there was a verdict.
bool was_stopped(const Result& result) { return !result.complete && result.verify.verdict == Verdict::kNotRun; }

/// What the path leaves, by the judge.
std::string error_lines(const Result& result) {
  const VerifyReport& v = result.verify;
  std::string text;
  text += fmt::format(
      "  path        {} strip{}, {} poses, joined within {:.2g} mm of the motion, largest |c| {:.3f}, largest turn "
      "{:.1f} degrees\n",
      result.path.strips.size(), result.path.strips.size() == 1 ? "" : "s", result.path.pose_count(),
      result.chord_bound_mm, result.largest_c, result.largest_turn_rad * 180.0 / std::numbers::pi);
  if (was_stopped(result)) return text + "  judged      not at all\n";
  text += fmt::format("  coverage    {} of the target within {} mm\n", percent(v.coverage), v.tolerance_mm);
  text += "  " + reach_text(v) + "\n";
  text += fmt::format("  overcut     {:.6f} mm\n", v.overcut_mm);
  text += fmt::format("  undercut    {:.6f} mm where the path touches, {:.4f} mm anywhere on the target\n",
                      v.undercut_covered_mm, v.undercut_mm);
  text += fmt::format("  rms         {:.6f} mm over the covered samples\n", v.rms_mm);
  text += fmt::format("  other faces {:.6f} mm deepest overcut\n", v.gouge_mm);
  text += "  judged      " + depth_text(v) + "\n";
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
  return fmt::format("  tool        {} ({}), axis {:.3f} mm, radius {:.3f} to {:.3f} mm\n", tool.name,
                     family_name(tool.radial.family()), length, low, high);
}

/// MATH.md, section 11, as one number that people can compare: the cylinder that bends as much.
std::string stiffness_line(const Tool& tool) {
  const Stiffness bent = stiffness(tool);
  return fmt::format(
      "  stiffness   slenderness {:.2f}: as a cylinder of diameter {:.3f} mm, {:.3f} mm long; its tip gives "
      "way by {:.2f} um under {:.0f} N in carbide\n",
      bent.slenderness, bent.equivalent_diameter_mm, bent.length_mm, bent.deflection_um, kStiffnessForce);
}

/// What only this kind of plan has to tell; the overloads are chosen by the result's own plan.
std::string plan_lines(const CoverSummary& cover) {
  std::string text;
  for (const TargetCover& t : cover.targets)
    text += fmt::format(
        "  cover       {}: {} strip{} from {} seeds, {} lines and {} candidates; {} of what is reachable before "
        "smoothing, {} after, overlap {}, links {:.1f} mm\n",
        t.faces, t.strips, t.strips == 1 ? "" : "s", t.seeds, t.lines, t.grown, percent(t.before), percent(t.after),
        percent(t.overlap), t.links_mm);
  return text;
}
std::string plan_lines(const FitSummary&) { return ""; }
std::string plan_lines(const TrochoidSummary& cavity) { return trochoid_lines(cavity); }

/// Coverage and overcut together: neither means anything without the other.
nlohmann::ordered_json share_json(const PlannedShare& share) {
  return {{"coverage", share.coverage}, {"overcut", share.overcut_mm}};
}

/// The keys "candidates", "before" and "after" are the same for every kind of plan, so that scripts can compare them.
void add_plan(const FitSummary& fit, nlohmann::ordered_json& json) {
  json["candidates"] = fit.candidates;
  json["before"] = share_json(fit.before);
  json["after"] = share_json(fit.after);
  json["residuals"] = {{"rms", fit.rms_mm}, {"largest", fit.largest_mm}, {"inside_share", fit.inside_share}};
  auto& trace = json["trace"] = nlohmann::ordered_json::array();
  for (const FitStep& step : fit.trace)
    trace.push_back(
        {{"cost", step.cost}, {"rms", step.rms_mm}, {"largest", step.largest_mm}, {"damping", step.damping}});
}

void add_plan(const TrochoidSummary& cavity, nlohmann::ordered_json& json) {
  add_plan(cavity.sides, json);
  json["cavity"] = trochoid_to_json(cavity);
}

nlohmann::ordered_json target_json(const TargetCover& t) {
  return {{"faces", t.faces}, {"area", t.area_mm2},   {"seeds", t.seeds},         {"lines", t.lines},
          {"grown", t.grown}, {"strips", t.strips},   {"reachable", t.reachable}, {"before", t.before},
          {"after", t.after}, {"overlap", t.overlap}, {"links", t.links_mm},      {"overcut", t.overcut_mm}};
}

void add_plan(const CoverSummary& cover, nlohmann::ordered_json& json) {
  const TargetCover whole = cover.whole();
  json["candidates"] = whole.grown;
  json["before"] = share_json({whole.before, 0.0});
  json["after"] = share_json({whole.after, whole.overcut_mm});
  json["cover"] = target_json(whole);
  auto& targets = json["targets"] = nlohmann::ordered_json::array();
  for (const TargetCover& t : cover.targets) targets.push_back(target_json(t));
}

}  // namespace

std::string summary_text(const Result& result) {
  const PartRequest part = part_of(result.job);
  std::string text = fmt::format("{} {}\n", part.file, part.target_text());
  // What was asked for stands first: a verdict is about that and nothing else.
  text += fmt::format("  asked for   {}\n", fmt::join(asked_for(result.job), ", "));
  text += tool_line(result.tool) + stiffness_line(result.tool);
  text += result.path.pose_count() > 0 ? error_lines(result) : "  path        no strip: nothing is machined\n";
  text += clearance_text(result.verify.clearance);
  if (result.verify.stock) text += stock_text(*result.verify.stock);
  text += std::visit([](const auto& plan) { return plan_lines(plan); }, result.plan);
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

std::string summary_json(const Result& result) {
  const VerifyReport& v = result.verify;
  nlohmann::ordered_json json;
  json["schema"] = "openflank/summary/1";
  json["units"] = "mm";
  json["part"] = part_of(result.job).file;
  json["faces"] = part_of(result.job).target_text();
  json["complete"] = result.complete;
  json["within"] = result.acceptance().pass();
  if (was_stopped(result)) json["judged"] = false;  // figures of errors mean nothing then
  json["tolerance"] = v.tolerance_mm;
  json["coverage"] = v.coverage;
  json["reachable_share"] = v.reachable_share;
  json["coverage_reachable"] = v.coverage_reachable;
  if (v.coverage_reachable_bound) json["coverage_reachable_bound"] = *v.coverage_reachable_bound;
  json["reach_radius"] = v.reach_radius_mm;
  json["least_coverage"] = std::visit([](const auto& plan) { return plan.judge.least_coverage; }, result.job);
  json["overcut"] = v.overcut_mm;
  // Without a path nothing is as far from the target as anything.
  json["undercut"] = result.path.pose_count() > 0 ? nlohmann::ordered_json(v.undercut_mm) : nullptr;
  json["undercut_covered"] = v.undercut_covered_mm;
  json["rms"] = v.rms_mm;
  json["other_faces_overcut"] = v.gouge_mm;
  json["sampling_bound"] = v.sampling_bound_mm;
  json["depth"] = depth_name(v.depth);
  json["overcut_bound"] = v.overcut_bound_mm;
  json["other_faces_overcut_bound"] = v.gouge_bound_mm;
  if (!v.clearance.figures.empty()) json["clearance"] = clearance_to_json(v.clearance);
  json["chord_bound"] = result.chord_bound_mm;
  json["largest_c"] = result.largest_c;
  json["largest_turn"] = result.largest_turn_rad * 180.0 / std::numbers::pi;
  json["diagonal"] = result.diagonal_mm;
  json["axis_length"] = result.tool.radial.axis_length();
  const Stiffness bent = stiffness(result.tool);
  json["slenderness"] = bent.slenderness;
  json["equivalent_diameter"] = bent.equivalent_diameter_mm;
  json["tip_deflection_um_per_100N"] = bent.deflection_um;
  json["strips"] = result.path.strips.size();
  json["poses"] = result.path.pose_count();
  std::visit([&](const auto& plan) { add_plan(plan, json); }, result.plan);
  if (result.ranking) json["ranking"] = ranking_entries(*result.ranking);
  json["notes"] = result.notes;
  return dumped(json, 2) + "\n";
}

}  // namespace flank
