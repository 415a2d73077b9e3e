#include "flank/results/plan_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "flank/results/cavity/trochoid_json.h"

namespace flank::internal {
namespace {

/// A share as people read it.
std::string percent(double share) { return fmt::format("{:.2f} %", 100.0 * share); }

/// The overloads of this and of add_keys are chosen by the result's own plan.
std::string lines_of(const CoverSummary& cover, double) {
  std::string text;
  for (const TargetCover& t : cover.targets)
    text += fmt::format(
        "  cover       {}: {} pass{} chosen from {} candidates ({} starts, {} contact lines); estimate: {} of the "
        "accessible area finished, {} before smoothing, overlap {}; links {:.1f} mm\n",
        t.faces, t.strips, t.strips == 1 ? "" : "es", t.grown, t.seeds, t.lines, percent(t.after), percent(t.before),
        percent(t.overlap), t.links_mm);
  return text;
}

bool is_clean(const StiffnessStep& step, double tolerance_mm) {
  return step.overcut_mm <= tolerance_mm && step.gouge_mm <= tolerance_mm;
}

/// What was judged, and of the estimates those of which no stiffer one is clean and covers as much.
std::vector<StiffnessStep> worth_telling(const std::vector<StiffnessStep>& steps, double tolerance_mm) {
  constexpr double kMore = 0.001;  // of coverage
  std::vector<StiffnessStep> told;
  double most = 0.0;
  for (const StiffnessStep& step : steps) {
    const bool clean = is_clean(step, tolerance_mm);
    if (step.judged || (clean && step.coverage > most + kMore)) told.push_back(step);
    if (clean) most = std::max(most, step.coverage);
  }
  return told;
}

std::string stiffness_lines(const FitSummary& fit, double tolerance_mm) {
  const std::vector<StiffnessStep> told = worth_telling(fit.stiffness, tolerance_mm);
  if (told.size() < 2) return "";
  std::vector<std::string> words;
  for (const StiffnessStep& step : told) {
    std::string word = fmt::format("{:.1f} {}", step.slenderness, percent(step.coverage));
    if (!is_clean(step, tolerance_mm))
      word += fmt::format(" with gouges of {:.2g} mm", std::max(step.overcut_mm, step.gouge_mm));
    words.push_back(word + (step.chosen ? " (chosen)" : step.judged ? "" : " (estimate)"));
  }
  return fmt::format("  L:D         {} tools tried; L:D and finished area: {}\n", fit.stiffness.size(),
                     fmt::join(words, ", "));
}

std::string lines_of(const FitSummary& fit, double tolerance_mm) { return stiffness_lines(fit, tolerance_mm); }
std::string lines_of(const TrochoidSummary& cavity, double) { return trochoid_lines(cavity); }

/// Coverage and overcut together: neither means anything without the other.
nlohmann::ordered_json share_json(const PlannedShare& share) {
  return {{"coverage", share.coverage}, {"overcut", share.overcut_mm}};
}

void add_keys(const FitSummary& fit, nlohmann::ordered_json& json) {
  json["candidates"] = fit.candidates;
  json["before"] = share_json(fit.before);
  json["after"] = share_json(fit.after);
  json["residuals"] = {{"rms", fit.rms_mm}, {"largest", fit.largest_mm}, {"inside_share", fit.inside_share}};
  auto& trace = json["trace"] = nlohmann::ordered_json::array();
  for (const FitStep& step : fit.trace)
    trace.push_back(
        {{"cost", step.cost}, {"rms", step.rms_mm}, {"largest", step.largest_mm}, {"damping", step.damping}});
  if (fit.stiffness.empty()) return;
  auto& steps = json["stiffness"] = nlohmann::ordered_json::array();
  for (const StiffnessStep& step : fit.stiffness) {
    nlohmann::ordered_json entry{{"slenderness", step.slenderness},
                                 {"axis_length", step.axis_length_mm},
                                 {"largest_radius", step.largest_radius_mm},
                                 {"strips", step.strips},
                                 {"coverage", step.coverage}};
    if (step.coverage_reachable) entry["coverage_reachable"] = *step.coverage_reachable;
    entry.update({{"overcut", step.overcut_mm},
                  {"other_faces_overcut", step.gouge_mm},
                  {"rms", step.rms_mm},
                  {"judged", step.judged},
                  {"chosen", step.chosen}});
    steps.push_back(std::move(entry));
  }
}

void add_keys(const TrochoidSummary& cavity, nlohmann::ordered_json& json) {
  add_keys(cavity.sides, json);
  json["cavity"] = trochoid_to_json(cavity);
}

nlohmann::ordered_json target_json(const TargetCover& t) {
  return {{"faces", t.faces}, {"area", t.area_mm2},   {"seeds", t.seeds},         {"lines", t.lines},
          {"grown", t.grown}, {"strips", t.strips},   {"reachable", t.reachable}, {"before", t.before},
          {"after", t.after}, {"overlap", t.overlap}, {"links", t.links_mm},      {"overcut", t.overcut_mm}};
}

void add_keys(const CoverSummary& cover, nlohmann::ordered_json& json) {
  const TargetCover whole = cover.whole();
  json["candidates"] = whole.grown;
  json["before"] = share_json({whole.before, 0.0});
  json["after"] = share_json({whole.after, whole.overcut_mm});
  json["cover"] = target_json(whole);
  auto& targets = json["targets"] = nlohmann::ordered_json::array();
  for (const TargetCover& t : cover.targets) targets.push_back(target_json(t));
}

}  // namespace

std::string plan_lines(const Result& result) {
  return std::visit([&](const auto& plan) { return lines_of(plan, result.verify.tolerance_mm); }, result.plan);
}

void add_plan(const Result& result, nlohmann::ordered_json& json) {
  std::visit([&](const auto& plan) { add_keys(plan, json); }, result.plan);
}

}  // namespace flank::internal
