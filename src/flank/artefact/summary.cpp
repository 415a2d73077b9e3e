// The summary of a fit: a table for people, JSON for programs.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "flank/artefact/verify_json.h"
#include "flank/pipeline/fit_job.h"

namespace flank::internal {
namespace {

std::string percent(double share) { return fmt::format("{:.2f} %", 100.0 * share); }

/// What the path leaves, by the judge.
std::string error_lines(const FitOutcome& outcome) {
  const VerifyReport& v = outcome.verify;
  std::string text;
  text += fmt::format("  path        {} strip{}, {} poses, joined within {:.2g} mm of the motion, largest |c| {:.3f}\n",
                      outcome.path.strips.size(), outcome.path.strips.size() == 1 ? "" : "s", outcome.path.pose_count(),
                      outcome.chord_bound_mm, outcome.largest_c);
  text += fmt::format("  coverage    {} of the target within {} mm\n", percent(v.coverage), v.tolerance_mm);
  text += "  " + reach_text(v) + "\n";
  text += fmt::format("  overcut     {:.6f} mm\n", v.overcut_mm);
  text += fmt::format("  undercut    {:.6f} mm where the path touches, {:.4f} mm anywhere on the target\n",
                      v.undercut_covered_mm, v.undercut_mm);
  text += fmt::format("  rms         {:.6f} mm over the covered samples\n", v.rms_mm);
  text += fmt::format("  other faces {:.6f} mm deepest overcut\n", v.gouge_mm);
  text +=
      fmt::format("  bound       between the judge's samples f is worse by at most {:.4f} mm\n", v.sampling_bound_mm);
  return text;
}

}  // namespace

std::string summary_text(const FitJob& job, const FitOutcome& outcome) {
  const VerifyReport& v = outcome.verify;
  const double length = outcome.tool.radial.axis_length();
  std::string text = fmt::format("{} {}\n", job.part, job.faces);
  double low = 1e300, high = 0.0;
  for (int j = 0; j <= 100; ++j) {
    const double r = outcome.tool.radial.at(length * j / 100.0).r;
    low = std::min(low, r);
    high = std::max(high, r);
  }
  text += fmt::format("  tool        {} ({}), axis {:.3f} mm, radius {:.3f} to {:.3f} mm\n", outcome.tool.name,
                      family_name(outcome.tool.radial.family()), length, low, high);
  text += outcome.path.pose_count() > 0 ? error_lines(outcome) : "  path        no strip: nothing is machined\n";
  text += clearance_text(v.clearance);
  for (const auto& [name, value] : outcome.figures) text += fmt::format("  {:<11} {:.4g}\n", name, value);
  text += outcome.ranking_text;
  for (const std::string& note : outcome.notes) text += "  note        " + note + "\n";
  text += "  time       ";
  for (const auto& [stage, seconds] : outcome.seconds) text += fmt::format(" {} {:.2f} s", stage, seconds);
  const Acceptance acceptance = outcome.acceptance(job);
  text +=
      fmt::format("\n  verdict     {}{}\n", acceptance.pass() ? "within what was asked" : "NOT within what was asked",
                  outcome.complete ? "" : " (interrupted: incomplete)");
  text += reason_lines(acceptance);
  return text;
}

std::string summary_json(const FitJob& job, const FitOutcome& outcome) {
  const VerifyReport& v = outcome.verify;
  nlohmann::ordered_json json;
  json["schema"] = "openflank/summary/1";
  json["units"] = "mm";
  json["part"] = job.part;
  json["faces"] = job.faces;
  json["complete"] = outcome.complete;
  json["within"] = outcome.acceptance(job).pass();
  json["tolerance"] = job.tolerance_mm;
  json["coverage"] = v.coverage;
  json["reachable_share"] = v.reachable_share;
  json["coverage_reachable"] = v.coverage_reachable;
  json["reach_radius"] = v.reach_radius_mm;
  json["least_coverage"] = job.least_coverage;
  json["overcut"] = v.overcut_mm;
  // Without a path nothing is as far from the target as anything.
  json["undercut"] = outcome.path.pose_count() > 0 ? nlohmann::ordered_json(v.undercut_mm) : nullptr;
  json["undercut_covered"] = v.undercut_covered_mm;
  json["rms"] = v.rms_mm;
  json["other_faces_overcut"] = v.gouge_mm;
  json["sampling_bound"] = v.sampling_bound_mm;
  if (!v.clearance.figures.empty()) json["clearance"] = nlohmann::ordered_json::parse(clearance_to_json(v.clearance));
  json["chord_bound"] = outcome.chord_bound_mm;
  json["largest_c"] = outcome.largest_c;
  json["diagonal"] = outcome.diagonal_mm;
  json["axis_length"] = outcome.tool.radial.axis_length();
  json["strips"] = outcome.path.strips.size();
  json["poses"] = outcome.path.pose_count();
  json["candidates"] = outcome.fit.candidates;
  json["before"] = {{"coverage", outcome.fit.before.at_tolerance}, {"overcut", outcome.fit.before.overcut_mm}};
  json["after"] = {{"coverage", outcome.fit.after.at_tolerance}, {"overcut", outcome.fit.after.overcut_mm}};
  for (const auto& [name, value] : outcome.figures) json["figures"][name] = value;
  if (!outcome.ranking.empty()) json["ranking"] = nlohmann::ordered_json::parse(outcome.ranking).at("tools");
  json["residuals"] = {{"rms", outcome.fit.residuals.rms_mm},
                       {"largest", outcome.fit.residuals.largest_mm},
                       {"inside_share", outcome.fit.residuals.inside_share}};
  auto& trace = json["trace"] = nlohmann::ordered_json::array();
  for (const IterationTrace& entry : outcome.fit.trace)
    trace.push_back(
        {{"cost", entry.cost}, {"rms", entry.rms_mm}, {"largest", entry.largest_mm}, {"damping", entry.damping}});
  json["notes"] = outcome.notes;
  return json.dump(2) + "\n";
}

}  // namespace flank::internal
