#include "flank/artefact/plan_json.h"

#include <fmt/format.h>

#include "flank/artefact/cavity/trochoid_json.h"

namespace flank::internal {
namespace {

/// A share as people read it.
std::string percent(double share) { return fmt::format("{:.2f} %", 100.0 * share); }

/// The overloads of this and of add_keys are chosen by the result's own plan.
std::string lines_of(const CoverSummary& cover) {
  std::string text;
  for (const TargetCover& t : cover.targets)
    text += fmt::format(
        "  cover       {}: {} strip{} from {} seeds, {} lines and {} candidates; {} of what is reachable before "
        "smoothing, {} after, overlap {}, links {:.1f} mm\n",
        t.faces, t.strips, t.strips == 1 ? "" : "s", t.seeds, t.lines, t.grown, percent(t.before), percent(t.after),
        percent(t.overlap), t.links_mm);
  return text;
}
std::string lines_of(const FitSummary&) { return ""; }
std::string lines_of(const TrochoidSummary& cavity) { return trochoid_lines(cavity); }

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
  return std::visit([](const auto& plan) { return lines_of(plan); }, result.plan);
}

void add_plan(const Result& result, nlohmann::ordered_json& json) {
  std::visit([&](const auto& plan) { add_keys(plan, json); }, result.plan);
}

}  // namespace flank::internal
