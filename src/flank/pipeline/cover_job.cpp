#include "flank/pipeline/cover_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flank/base/tolerance_budget.h"
#include "flank/error.h"
#include "flank/pipeline/catalogue_job.h"
#include "flank/pipeline/cover_groups.h"
#include "flank/pipeline/judge_job.h"
#include "flank/setup/make_obstacles.h"
#include "flank/setup/targets.h"
#include "flank/strip/strip_order.h"
#include "flank/toolbox/tool_command.h"

namespace flank::internal {
namespace {

void require(bool holds, const std::string& message) {
  if (!holds) throw UsageError(message);
}

/// A whole tool: a file, or a family with all its parameters and an axis length.
Tool tool_of(const FitJob& job) {
  require(!job.tool.empty(), "--tool: a tool.json, or a family with all its parameters and --axis-length, is needed");
  const ToolSpec spec = parse_tool_spec(job.tool);
  if (spec.tool) {
    require(!job.axis_length_mm, "--axis-length: the tool's file has its length; it goes with a family");
    const Legitimacy legitimacy = check_legitimacy(spec.tool->radial);
    require(legitimacy.legitimate, "--tool " + job.tool + ": this is no tool: " + legitimacy.reason);
    return *spec.tool;
  }
  require(!spec.free, "--tool: flank cover takes a given tool; flank fit finds one");
  require(job.axis_length_mm.has_value(), "--axis-length: a family needs the length of its axis, mm");
  return make_tool(*spec.family, spec.given, *job.axis_length_mm);
}

CoverStrategy strategy_of(const std::string& name) {
  require(name == "grow" || name == "curves", "--strategy " + name + ": there are grow and curves");
  return name == "grow" ? CoverStrategy::kGrow : CoverStrategy::kCurves;
}

SeedPlaces places_of(const std::string& name) {
  require(name == "grid" || name == "shape", "--seeds " + name + ": there are grid and shape");
  return name == "grid" ? SeedPlaces::kGrid : SeedPlaces::kShape;
}

void check_job(const CoverJob& job) {
  const FitJob& base = job.base;
  require(base.tolerance_mm > 0.0 && std::isfinite(base.tolerance_mm), "--tolerance: a length > 0 mm is needed");
  require(base.least_coverage >= 0.0 && base.least_coverage <= 1.0, "--coverage: a share between 0 and 1 is needed");
  check_reach_radius(base);
  (void)strategy_of(job.strategy);
  (void)places_of(job.seeds);
  require(!job.most_strips || (*job.most_strips >= 1 && *job.most_strips <= 200),
          "--strips: a number from 1 to 200 is needed");
  require(!job.strip_price || (*job.strip_price >= 0.0 && *job.strip_price < 1.0),
          "--strip-price: a share from 0 to 1 is needed");
}

void keep(const CoverResult& result, const TargetGroup& group, FitOutcome& outcome) {
  outcome.fit.motions.insert(outcome.fit.motions.end(), result.motions.begin(), result.motions.end());
  outcome.fit.candidates += result.grown;
  outcome.fit.before.at_tolerance = result.coverage_before;
  outcome.fit.after.at_tolerance = result.coverage;
  outcome.fit.after.overcut_mm = std::max(outcome.fit.after.overcut_mm, result.overcut_mm);
  outcome.notes.insert(outcome.notes.end(), result.notes.begin(), result.notes.end());
  if (!result.message.empty()) outcome.notes.push_back(group.faces + ": " + result.message);
  if (result.reachable < 0.9995)
    outcome.notes.push_back(fmt::format(
        "{}: {:.1f} % can be reached: elsewhere a ball of the tool's smallest radius would enter another face; of "
        "that, {:.1f} % is covered",
        group.faces, 100.0 * result.reachable, 100.0 * result.coverage));
  for (const auto& [stage, seconds] : result.seconds) outcome.seconds.emplace_back(stage, seconds);
  const std::string prefix = group.faces + " ";
  outcome.figures.emplace_back(prefix + "seeds", result.seeds);
  outcome.figures.emplace_back(prefix + "lines", result.lines);
  outcome.figures.emplace_back(prefix + "grown", result.grown);
  outcome.figures.emplace_back(prefix + "strips", static_cast<double>(result.motions.size()));
  outcome.figures.emplace_back(prefix + "reachable", result.reachable);
  outcome.figures.emplace_back(prefix + "before", result.coverage_before);
  outcome.figures.emplace_back(prefix + "after", result.coverage);
  outcome.figures.emplace_back(prefix + "overlap", result.overlap);
  outcome.figures.emplace_back(prefix + "links mm", link_length(result.motions));
}

Covered cover_group(const CoverJob& job, const Part& part, std::span<const Part> fixtures, TargetGroup group,
                    const Tool& tool, const Progress& progress) {
  const Obstacles obstacles = obstacles_of(job, part, fixtures, group, extent_of(tool));
  CoverResult result = cover(*group.target, tool, obstacles, options_of(job), progress);
  return {std::move(group), std::move(result)};
}

/// Every group; open sheets from both sides, where none is asked for, and the better one kept.
std::vector<Covered> cover_groups(const CoverJob& job, const Part& part, const std::vector<int>& faces,
                                  const Tool& tool, const Progress& progress) {
  const std::vector<Part> fixtures = read_fixtures(job.base.clearance.fixtures, job.base.unit);
  std::vector<Covered> all;
  for (TargetGroup& group : make_targets(part, faces, job.base.side.value_or(+1)))
    all.push_back(cover_group(job, part, fixtures, std::move(group), tool, progress));
  if (job.base.side) return all;
  std::vector<TargetGroup> other_side = make_targets(part, faces, -1);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].group.of_solid) continue;
    Covered other = cover_group(job, part, fixtures, std::move(other_side[k]), tool, progress);
    const bool better =
        other.result.coverage * other.result.reachable > all[k].result.coverage * all[k].result.reachable;
    if (better) all[k] = std::move(other);
    all[k].result.notes.push_back(
        fmt::format("{}: open sheet: both sides were tried, side {} covers more; choose with --side",
                    all[k].group.faces, better ? "-" : "+"));
  }
  return all;
}

}  // namespace

CoverOptions options_of(const CoverJob& job) {
  CoverOptions options = job.options;
  options.strategy = strategy_of(job.strategy);
  options.places = places_of(job.seeds);
  options.tolerance_mm = job.base.tolerance_mm;
  if (job.most_strips) options.most_strips = *job.most_strips;
  if (job.strip_price) options.strip_price = *job.strip_price;
  return options;
}

ToolExtent extent_of(const Tool& tool) {
  ToolExtent extent;
  const double length = tool.radial.axis_length();
  for (int j = 0; j <= 16; ++j)
    extent.reach_mm = std::max(extent.reach_mm, length + 2.0 * tool.radial.at(length * j / 16.0).r);
  for (const auto* profile : {&tool.shank, &tool.holder}) {
    extent.above = extent.above || !profile->empty();
    for (const Vec2& p : *profile) extent.reach_mm = std::max(extent.reach_mm, p.x() + 2.0 * p.y());
  }
  return extent;
}

Obstacles obstacles_of(const CoverJob& job, const Part& part, std::span<const Part> fixtures, const TargetGroup& group,
                       const ToolExtent& extent) {
  const double tolerance_mm = job.base.tolerance_mm;
  const std::vector<int> targets = parse_face_list(part, job.base.faces);
  ObstacleChoice choice = choose_obstacles(group.indices, targets, faces_to_check(part, targets, job.base.check));
  choice.fixtures = fixtures;
  choice.clearance_mm = job.base.clearance.required_mm;
  choice.tolerance_mm = tolerance_mm;
  ObstacleDetail detail;
  detail.meshes_within_mm = extent.reach_mm;
  detail.deviation_mm = std::clamp(kToleranceBudget.others.triangles * tolerance_mm, 1e-3, 0.05);
  if (extent.above) {
    detail.own_deviation_mm = std::clamp(kToleranceBudget.shank.triangles * tolerance_mm, 1e-3, 0.02);
    detail.own_spare_mm = kToleranceBudget.shank.spare * tolerance_mm;
  }
  std::vector<std::string> notes;  // triangles are always to be had
  return make_obstacles(part, *group.target, choice, detail, notes);
}

FitOutcome run_cover(const CoverJob& job, const Progress& progress) {
  check_job(job);
  const FitJob& base = job.base;
  FitOutcome outcome;
  const std::optional<ToolChoice> choice = tool_choice(job);
  if (!choice) {
    outcome.tool = tool_of(base);
    check_clearance_job(base.clearance, &outcome.tool);
    equip_tool(base.clearance, outcome.tool);
  }
  Stopwatch watch(outcome);
  progress.step("read", 0.0);
  const Part part = read_part(base.part, base.unit);
  const std::vector<int> faces = parse_face_list(part, base.faces);
  const std::vector<int> checks = faces_to_check(part, faces, base.check);
  outcome.notes = part.repairs;
  if (const std::string note = unchecked_note(part, faces, checks); !note.empty()) outcome.notes.push_back(note);
  watch.lap("read");
  const std::vector<Covered> all = choice ? cover_with_best(job, *choice, part, faces, outcome, progress)
                                          : cover_groups(job, part, faces, outcome.tool, progress);
  watch.lap("cover");
  outcome.fit.tool = outcome.tool.radial;
  outcome.diagonal_mm = all.front().group.target->diagonal();
  std::vector<const TargetGroup*> groups;
  for (const Covered& covered : all) {
    keep(covered.result, covered.group, outcome);
    groups.insert(groups.end(), covered.result.motions.size(), &covered.group);
  }
  add_strips(base, outcome.fit.motions, groups, outcome);
  watch.lap("sample");
  outcome.complete = !progress.stop();
  progress.step("verify", 0.9);
  judge_outcome(base, part, faces, checks, outcome, watch);
  return outcome;
}

}  // namespace flank::internal
