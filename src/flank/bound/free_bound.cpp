#include "flank/bound/free_bound.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "flank/base/proved_digits.h"
#include "flank/base/stopping.h"
#include "flank/bound/bound_setup.h"
#include "flank/error.h"
#include "flank/io/text/json_dump.h"
#include "flank/job/bound_fields.h"
#include "flank/limit/ball_room.h"
#include "flank/setup/radius_default.h"
#include "flank/tool_request/tool_spec.h"

namespace flank::internal {
namespace {

using Json = nlohmann::ordered_json;

Json triple(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json target_entry(const FreeBoundTarget& target) {
  const BallBound& bound = target.bound;
  Json entry = {{"faces", target.faces},
                {"complete", bound.complete},
                {"radius_min", target.radius_mm},
                {"least_error", bound.bound_mm},
                {"reached_by_ball", bound.found_mm},
                {"area", bound.area_mm2},
                {"not_finished_area", bound.out_of_reach_mm2},
                {"sites", bound.sites}};
  if (bound.bound_mm > 0.0) {
    entry["point"] = triple(bound.point);
    entry["normal"] = triple(bound.normal);
    entry["ball"] = triple(bound.centre);
  }
  return entry;
}

}  // namespace

double FreeBound::bound_mm() const {
  double most = 0.0;
  for (const FreeBoundTarget& target : targets) most = std::max(most, target.bound.bound_mm);
  return most;
}

bool asks_for_free_tool(const BoundJob& job) { return parse_tool_spec(job.tool.spec, "tool").free; }

FreeBound run_free_bound(const BoundJob& request, const Progress& progress) {
  check_fields(request);
  if (request.map) throw UsageError("map", "true", "needs a given tool: --tool cylinder:radius=5 or a tool file");
  FreeBound result;
  result.job = request;
  progress.step("read", 0.0);
  const BoundSetup setup = read_bound_setup(request, result.notes);
  result.part_sha256 = setup.setup.part.sha256;
  result.job.tolerance_mm = setup.setup.tolerance_mm;
  std::vector<const Target*> surfaces = setup.avoided();
  for (const TargetGroup& group : setup.groups) surfaces.push_back(group.target.get());
  const double share = 1.0 / static_cast<double>(setup.groups.size());
  for (std::size_t k = 0; k < setup.groups.size() && !progress.stop(); ++k) {
    const Target& target = *setup.groups[k].target;
    const double radius = request.radius_min_mm.value_or(kSmallestRadiusShare * target.diagonal());
    const BallBoundOptions options = {.radius_mm = radius,
                                      .tolerance_mm = setup.setup.tolerance_mm,
                                      .spacing_mm = std::sqrt(target.area() / request.points),
                                      .gap = request.gap};
    const Progress part = progress.part(share * static_cast<double>(k), share * static_cast<double>(k + 1));
    const BallRoom room(setup.setup, surfaces, setup.groups[k].indices, target.box(), radius);
    result.targets.push_back(
        {setup.groups[k].faces, target.diagonal(), radius, ball_bound(target, room.scene(), options, part)});
  }
  if (result.targets.empty() || result.targets.front().bound.sites == 0) throw Stopped();
  result.complete = result.targets.size() == setup.groups.size();
  for (const FreeBoundTarget& target : result.targets) result.complete = result.complete && target.bound.complete;
  return result;
}

std::string free_bound_json(const FreeBound& result) {
  Json targets = Json::array();
  for (const FreeBoundTarget& target : result.targets) targets.push_back(target_entry(target));
  const Json document = {{"schema", "openflank/free-bound/1"},
                         {"units", "mm"},
                         {"command", command_line(result.job)},
                         {"part_sha256", result.part_sha256},
                         {"tolerance", *result.job.tolerance_mm},
                         {"least_error", result.bound_mm()},
                         {"notes", result.notes},
                         {"targets", targets}};
  return dumped(document, 1) + "\n";
}

std::string free_bound_text(const FreeBound& result) {
  std::string text = "What no tool does better, in any number of passes\n";
  for (const FreeBoundTarget& target : result.targets) {
    const BallBound& bound = target.bound;
    text += fmt::format("  {}: radii of at least {:.4g} mm, {} samples on {:.4g} mm2\n", target.faces,
                        digits_above(target.radius_mm, 4), bound.sites, bound.area_mm2);
    if (bound.bound_mm > 0.0)
      text += fmt::format(
          "    every such tool leaves or cuts at least {:.4g} mm near ({:.4g}, {:.4g}, {:.4g}); one ball there: {:.4g} "
          "mm\n",
          digits_below(bound.bound_mm, 4), bound.point.x(), bound.point.y(), bound.point.z(), bound.found_mm);
    else
      text += "    nothing is proved: at every sample a ball of that radius touches freely\n";
    if (bound.out_of_reach_mm2 > 0.0)
      text += fmt::format("    {:.1f} % of the area can be finished within {:.4g} mm by no such tool\n",
                          100.0 * bound.out_of_reach_mm2 / bound.area_mm2, *result.job.tolerance_mm);
    if (!bound.complete) text += "    stopped early: what is proved holds, but may be less than a whole run proves\n";
  }
  for (const std::string& note : result.notes) text += "  note: " + note + "\n";
  return text;
}

void write_free_bound(const FreeBound& result, const std::string& folder) {
  write_bound_files(result.job, folder, free_bound_json(result), free_bound_text(result));
}

}  // namespace flank::internal
