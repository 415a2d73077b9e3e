#include "flank/pipeline/run_cover.h"
#include "flank/pipeline/auto_shank.h"

#include <fmt/format.h>

#include <algorithm>

#include "flank/base/stopping.h"
#include "flank/error.h"
#include "flank/job/check_fields.h"
#include "flank/pipeline/finish.h"
#include "flank/pipeline/run_journal.h"
#include "flank/pipeline/search/cover_choice.h"
#include "flank/pipeline/search/reach_ball.h"
#include "flank/pipeline/search/search_setup.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/tool_body.h"
#include "flank/strip/strip_order.h"
#include "flank/tool_request/tool_spec.h"

namespace flank::internal {

TargetCover summary_of(const Covered& covered) {
  const CoverResult& result = covered.result;
  TargetCover summary;
  summary.faces = covered.group.faces;
  summary.area_mm2 = covered.group.target->area();
  summary.seeds = result.seeds;
  summary.lines = result.lines;
  summary.grown = result.grown;
  summary.strips = static_cast<int>(result.motions.size());
  summary.reachable = result.reachable;
  summary.before = result.coverage_before;
  summary.after = result.coverage;
  summary.overlap = result.overlap;
  summary.links_mm = link_length(result.motions);
  summary.overcut_mm = result.overcut_mm;
  return summary;
}

}  // namespace flank::internal

namespace flank {
using namespace internal;
namespace {

void add_notes(const Covered& covered, Result& result) {
  const CoverResult& cover = covered.result;
  result.notes.insert(result.notes.end(), cover.notes.begin(), cover.notes.end());
  if (!cover.message.empty()) result.notes.push_back(covered.group.faces + ": " + cover.message);
  if (cover.reachable < 0.9995)
    result.notes.push_back(
        fmt::format("{}: {:.1f} % is accessible: elsewhere a ball of the tool's smallest radius would gouge another "
                    "face; {:.1f} % of that is finished",
                    covered.group.faces, 100.0 * cover.reachable, 100.0 * cover.coverage));
  result.seconds.insert(result.seconds.end(), cover.seconds.begin(), cover.seconds.end());
}

Covered cover_group(const CoverJob& job, const Setup& setup, TargetGroup group, const Tool& tool,
                    const Progress& progress) {
  const Obstacles obstacles = obstacles_of(job, setup, group, extent_of(tool));
  CoverResult result = cover(*group.target, tool, obstacles, options_of(job), progress);
  return {std::move(group), std::move(result)};
}

std::vector<Covered> cover_groups(const CoverJob& job, const Setup& setup, const Tool& tool, const Progress& progress) {
  std::vector<Covered> all;
  for (TargetGroup& group : make_targets(setup))
    all.push_back(cover_group(job, setup, std::move(group), tool, progress));
  return all;
}

/// The strips of all targets, in the result and as surfaces.
std::vector<StripSurface> collect(const CoverJob& job, const std::vector<Covered>& all, Result& result) {
  CoverSummary summary;
  std::vector<const TargetGroup*> groups;
  for (const Covered& covered : all) {
    summary.targets.push_back(summary_of(covered));
    add_notes(covered, result);
    const std::vector<RuledMotion>& motions = covered.result.motions;
    result.motions.insert(result.motions.end(), motions.begin(), motions.end());
    groups.insert(groups.end(), motions.size(), &covered.group);
  }
  result.plan = std::move(summary);
  result.diagonal_mm = all.front().group.target->diagonal();
  return add_strips(*job.tolerance_mm, groups, result);
}

/// A tool that was chosen does not say what is to be reached: the part does, unless the tool is thinner.
void ask_for_reach(const CoverJob& job, const Setup& setup, const std::vector<Covered>& all, Result& result) {
  if (job.judge.reach_radius_mm) return;
  double ball = result.tool.radial.smallest();
  for (const Covered& covered : all) {
    const Target& target = *covered.group.target;
    const RadiusBounds bounds = radius_bounds({}, job.obstacles, target.diagonal());
    ball = std::min(ball, reach_of_part(setup, target, job.tool.axis_length_mm, bounds));
  }
  std::get<CoverJob>(result.job).judge.reach_radius_mm = ball;
}

/// A shank that is to be chosen is that of the path found.
Result plan_cover(const CoverJob& request, KnownShank /*known*/, const Progress& asked) {
  const Progress progress = with_journal(asked);
  check_fields(request);
  (void)options_of(request);
  CoverJob job = request;
  // The same as not asked for, to the byte.
  if (job.part.allowance_mm == 0.0) job.part.allowance_mm.reset();
  Result result;
  result.inputs = input_stamps(job);
  const std::optional<ToolChoice> choice = tool_choice(job);
  if (choice) {
    job.obstacles.shank = default_shank(job.obstacles, false);
  } else {
    result.tool = given_tool(job.tool.spec, job.tool.axis_length_mm,
                             "flank cover needs a given tool; flank fit finds one", result.notes);
    job.obstacles.shank = default_shank(job.obstacles, has_body(result.tool));
    check_obstacles(job.obstacles, &result.tool);
    equip_tool(job.obstacles, result.tool);
  }
  Stopwatch watch(result);
  progress.step("read", 0.0);
  const Setup setup = read_setup(job.part, job.obstacles, job.tolerance_mm, result.notes);
  job.tolerance_mm = setup.tolerance_mm;
  result.job = job;
  result.part_sha256 = setup.part.sha256;
  progress.journal->begin(journal_key(job, result.part_sha256));
  watch.lap("read");
  stop_here();
  const std::vector<Covered> all =
      choice ? cover_with_best(job, *choice, setup, result, progress) : cover_groups(job, setup, result.tool, progress);
  watch.lap("cover");
  // Nothing takes the place of an earlier result.
  if (std::all_of(all.begin(), all.end(), [](const Covered& c) { return c.result.motions.empty(); })) stop_here();
  if (choice) ask_for_reach(job, setup, all, result);
  std::vector<StripSurface> surfaces = collect(job, all, result);
  watch.lap("sample");
  const bool body = has_body(result.tool) || job.obstacles.shank == "auto";
  const ClearanceScene scene = make_clearance_scene(setup, job.obstacles, body, result.notes);
  const bool own = request.obstacles.shank != "auto" && has_body(result.tool);  // of the catalogue
  if (own) std::get<CoverJob>(result.job).obstacles.shank = "given";
  if (job.obstacles.shank == "auto" && !own && !result.path.strips.empty())
    take_clear_shank(scene, setup.part.box, 1e300, std::get<CoverJob>(result.job).obstacles, result);
  result.complete = !progress.stop();
  progress.step("verify", 0.9);
  judge_result(setup, scene, std::move(surfaces), result, watch);
  if (!result.complete) result.journal = progress.journal;
  return result;
}

}  // namespace

Result run_cover(const CoverJob& request, const Progress& asked) {
  return with_room_for_shank<CoverJob>(request, true, kAnySlenderness, plan_cover, asked);
}

}  // namespace flank
