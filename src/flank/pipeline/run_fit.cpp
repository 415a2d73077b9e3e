#include "flank/pipeline/run_fit.h"

#include <fmt/format.h>

#include <algorithm>

#include "flank/base/stopping.h"
#include "flank/base/tolerance_budget.h"
#include "flank/error.h"
#include "flank/fit/lengthen.h"
#include "flank/job/check_fields.h"
#include "flank/pipeline/finish.h"
#include "flank/pipeline/fit_search.h"
#include "flank/pipeline/run_journal.h"
#include "flank/setup/tool_body.h"

namespace flank::internal {

void check_radius(const RadiusRequest& radius) {
  if (radius.max_mm && !(*radius.max_mm > radius.min_mm.value_or(0.0)))
    throw UsageError("radius_max_mm", "a radius above `radius_min_mm` is needed");
}

bool has_body(const ToolSpec& spec, const ObstacleRequest& obstacles) {
  return obstacles.shank_length_mm || obstacles.holder || (spec.tool && has_body(*spec.tool));
}

Tool found_tool(const ToolSpec& spec, const RadialFunction& found, const ObstacleRequest& obstacles) {
  Tool tool;
  tool.radial = found;
  tool.name = spec.free ? "free" : std::string(family_name(found.family()));
  if (spec.tool) tool = *spec.tool;
  equip_tool(obstacles, tool);
  return tool;
}

FitSummary fit_summary(const FlankFitResult& fit) {
  FitSummary summary;
  summary.candidates = fit.candidates;
  summary.before = {fit.before.at_tolerance, fit.before.overcut_mm};
  summary.after = {fit.after.at_tolerance, fit.after.overcut_mm};
  summary.rms_mm = fit.residuals.rms_mm;
  summary.largest_mm = fit.residuals.largest_mm;
  summary.inside_share = fit.residuals.inside_share;
  for (const IterationTrace& step : fit.trace)
    summary.trace.push_back({step.cost, step.rms_mm, step.largest_mm, step.damping});
  return summary;
}

}  // namespace flank::internal

namespace flank {
using namespace internal;
namespace {

void check_job(const FitJob& job) {
  check_fields(job);
  check_radius(job.radius);
  if (job.start && job.guide) throw UsageError("start", "goes without `guide`; give one of them");
}

void check_axis_length(const FitJob& job, const Part& part) {
  if (!job.tool.axis_length_mm) return;
  const double size = part.box.diagonal(), length = *job.tool.axis_length_mm;
  // A thousandth of the part would take a million passes.
  const double longest = 1.5 * size, shortest = 1e-3 * size;
  if (length > longest)
    throw UsageError(
        "axis_length_mm", fmt::format("{}", length),
        fmt::format("is longer than the part ({:.1f} mm); lengths up to {:.1f} mm are accepted", size, longest));
  if (length < shortest)
    throw UsageError(
        "axis_length_mm", fmt::format("{}", length),
        fmt::format("is nothing beside the part ({:.3g} mm); lengths from {:.3g} mm are accepted", size, shortest));
}

/// Lifts a shank or holder that comes too near, if the flank's length is open (lengthen.h).
void lift_shank(const FitJob& job, const ClearanceScene& scene, FlankFitResult& fit, std::vector<std::string>& notes) {
  if (job.tool.axis_length_mm || (!job.obstacles.shank_length_mm && !job.obstacles.holder)) return;
  const auto clear = [&](const FlankFitResult& tried) {
    Tool tool;
    tool.radial = tried.tool;
    equip_tool(job.obstacles, tool);
    Path path;
    for (const RuledMotion& motion : tried.motions) {
      SamplingOptions options;
      options.chord_tolerance_mm = kToleranceBudget.chord * job.tolerance_mm;
      path.strips.push_back({});
      path.strips.back().poses = sample_motion(motion, options).poses;
    }
    return measure_clearance(scene, tool, path).kept();
  };
  const double more = lengthen_until_clear(fit, std::max(1.0, job.obstacles.clearance_mm.value_or(0.0)), clear);
  if (more > 0.0)
    notes.push_back(
        fmt::format("the flank was lengthened by {} mm, so that shank and holder keep their clearances", more));
}

/// Strips of the path, with the notes of what is wrong with them.
std::vector<StripSurface> sample_path(const FitSearch& search, double tolerance_mm, Result& result) {
  const Legitimacy legitimacy = check_legitimacy(result.tool.radial);
  if (!legitimacy.legitimate) result.notes.push_back("the tool is not legitimate: " + legitimacy.reason);
  std::vector<const TargetGroup*> groups;
  for (const std::size_t g : search.group_of_motion) groups.push_back(&search.targets[g]);
  std::vector<StripSurface> surfaces = add_strips(tolerance_mm, groups, result);
  if (result.largest_c >= 1.0)
    result.notes.push_back(fmt::format(
        "the tool plunges where it touches the target: |c| = {:.3f} >= 1 somewhere along the path", result.largest_c));
  return surfaces;
}

}  // namespace

Result run_fit(const FitJob& job, const Progress& asked) {
  const Progress progress = with_journal(asked);
  check_job(job);
  const ToolSpec spec = parse_tool_spec(job.tool.spec);
  check_obstacles(job.obstacles, spec.tool ? &*spec.tool : nullptr);
  Result result;
  result.job = job;
  Stopwatch watch(result);
  progress.step("read", 0.0);
  const Setup setup = read_setup(job.part, job.obstacles, job.tolerance_mm, result.notes);
  result.part_sha256 = setup.part.sha256;
  progress.journal->begin(journal_key(job, result.part_sha256));
  check_axis_length(job, setup.part);
  const ClearanceScene scene = make_clearance_scene(setup, job.obstacles, has_body(spec, job.obstacles), result.notes);
  watch.lap("read");
  stop_here();

  FitSearch search = search_fit(job, setup, spec, progress);
  if (search.fit.motions.empty()) stop_here();  // nothing takes the place of an earlier result
  // The verdict, now and later, is about what was searched for.
  if (search.reach_radius_mm) std::get<FitJob>(result.job).judge.reach_radius_mm = search.reach_radius_mm;
  if (spec.free && !stopping()) lift_shank(job, scene, search.fit, result.notes);
  result.plan = fit_summary(search.fit);
  result.motions = search.fit.motions;
  result.diagonal_mm = search.targets.front().target->diagonal();
  result.notes.insert(result.notes.end(), search.fit.notes.begin(), search.fit.notes.end());
  result.complete = !progress.stop();
  watch.lap("fit");

  result.tool = found_tool(spec, search.fit.tool, job.obstacles);
  std::vector<StripSurface> surfaces = sample_path(search, job.tolerance_mm, result);
  watch.lap("sample");

  progress.step("verify", 0.9);
  judge_result(setup, scene, std::move(surfaces), result, watch);
  if (!result.complete) result.journal = progress.journal;
  return result;
}

}  // namespace flank
