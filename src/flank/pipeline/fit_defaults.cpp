#include "flank/pipeline/fit_defaults.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "flank/io/text/json_dump.h"
#include "flank/job/check_fields.h"
#include "flank/pipeline/run_fit.h"
#include "flank/pipeline/search/reach_ball.h"
#include "flank/results/verify_json.h"
#include "flank/setup/machined_side.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/targets.h"
#include "flank/tool_request/tool_spec.h"

namespace flank::internal {

FitDefaults fit_defaults(const FitJob& request) {
  check_fields(request);
  check_radius(request.radius);
  FitJob job = request;
  const ToolSpec spec = parse_tool_spec(job.tool.spec);
  FitDefaults defaults;
  const Setup setup = read_setup(job.part, job.obstacles, job.tolerance_mm, defaults.notes);
  job.tolerance_mm = defaults.tolerance_mm = setup.tolerance_mm;
  defaults.sides = setup.sides;
  const std::vector<TargetGroup> targets = make_targets(setup);
  for (const TargetGroup& group : targets) {
    defaults.faces += (defaults.faces.empty() ? "" : ",") + group.faces;
    defaults.area_mm2 += group.target->area();
  }
  const Target& first = *targets.front().target;
  defaults.diagonal_mm = first.diagonal();
  const RadiusBounds bounds = bounds_for(job, first);
  defaults.radius_min_mm = bounds.smallest, defaults.radius_max_mm = bounds.largest;
  defaults.slenderness_max = bounds.slenderest;
  defaults.reach_radius_mm = job.judge.reach_radius_mm;
  if (spec.free) defaults.reach_radius_mm = demanded_reach(job, setup, first, bounds);
  defaults.axis_length_mm = job.tool.axis_length_mm;
  defaults.least_coverage = job.judge.least_coverage;
  return defaults;
}

std::string defaults_text(const FitDefaults& defaults) {
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "would machine  {}, {:.4g} mm2, {:.4g} mm across\n", defaults.faces, defaults.area_mm2,
                 defaults.diagonal_mm);
  fmt::format_to(out, "  tolerance    {:.4g} mm\n", defaults.tolerance_mm);
  for (const SheetSide& side : defaults.sides) fmt::format_to(out, "  {:<12} {}\n", side.faces, side_text(side));
  fmt::format_to(out, "  tool radius  {:.4g} to {:.4g} mm, L:D up to {:.4g}\n", defaults.radius_min_mm,
                 defaults.radius_max_mm, defaults.slenderness_max);
  fmt::format_to(out, "  axis length  {}\n",
                 defaults.axis_length_mm ? fmt::format("{:.4g} mm", *defaults.axis_length_mm) : "as the face needs");
  fmt::format_to(out, "  accessible   {}\n",
                 defaults.reach_radius_mm
                     ? fmt::format("to a ball of radius {:.4g} mm, smaller where other faces leave it no room",
                                   *defaults.reach_radius_mm)
                     : "to a ball of the tool's smallest radius");
  fmt::format_to(out, "  finished     {:.4g} of the accessible area is required\n", defaults.least_coverage);
  for (const std::string& note : defaults.notes) fmt::format_to(out, "  note         {}\n", note);
  return text;
}

std::string defaults_json(const FitDefaults& defaults) {
  nlohmann::ordered_json json = {{"schema", "openflank/defaults/1"}, {"units", "mm"},
                                 {"faces", defaults.faces},          {"area", defaults.area_mm2},
                                 {"diagonal", defaults.diagonal_mm}, {"tolerance", defaults.tolerance_mm}};
  json["sides"] = nlohmann::ordered_json::array();
  for (const SheetSide& side : defaults.sides) json["sides"].push_back(sheet_side_to_json(side));
  json["radius_min"] = defaults.radius_min_mm, json["radius_max"] = defaults.radius_max_mm;
  json["slenderness_max"] = defaults.slenderness_max;
  const auto number = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  };
  json["axis_length"] = number(defaults.axis_length_mm);
  json["reach_radius"] = number(defaults.reach_radius_mm);
  json["coverage"] = defaults.least_coverage;
  json["notes"] = defaults.notes;
  return dumped(json, 2) + "\n";
}

}  // namespace flank::internal
