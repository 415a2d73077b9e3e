#include "flank/pipeline/run_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "flank/base/stopping.h"
#include "flank/base/tolerance_budget.h"
#include "flank/error.h"
#include "flank/fit/rejected.h"
#include "flank/job/check_fields.h"
#include "flank/pipeline/auto_shank.h"
#include "flank/pipeline/finish.h"
#include "flank/pipeline/fit_shank.h"
#include "flank/pipeline/free_line.h"
#include "flank/pipeline/judge/judge_job.h"
#include "flank/pipeline/repair_judged_cuts.h"
#include "flank/pipeline/run_journal.h"
#include "flank/pipeline/search/fit_search.h"
#include "flank/pipeline/search/stiff_fit.h"
#include "flank/results/acceptance.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/tool_body.h"
#include "flank/surface/facet_gaps.h"

namespace flank::internal {

void check_radius(const RadiusRequest& radius) {
  if (radius.max_mm && !(*radius.max_mm > radius.min_mm.value_or(0.0)))
    throw UsageError("radius_max_mm", "must be above `radius_min_mm`");
}

bool has_body(const ToolSpec& spec, const ObstacleRequest& obstacles) {
  return obstacles.shank == "auto" || obstacles.shank_length_mm || obstacles.holder ||
         (spec.tool && has_body(*spec.tool));
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

std::vector<StiffnessStep> stiffness_steps(const FlankFitResult& fit, const FitJob& job, double reachable_share) {
  std::vector<StiffnessStep> steps;
  for (const RejectedTool& rejected : fit.rejected) {
    // What is no tool, and a fit that lost its values, say nothing.
    if (!(rejected.slenderness < 1e300) || !(rejected.estimate.overcut_mm < 1e300)) continue;
    StiffnessStep step{.slenderness = rejected.slenderness,
                       .axis_length_mm = rejected.axis_length_mm,
                       .largest_radius_mm = rejected.largest_radius_mm,
                       .strips = rejected.strips,
                       .coverage = rejected.estimate.at_tolerance,
                       .coverage_reachable = {},
                       .overcut_mm = rejected.estimate.overcut_mm,
                       .gouge_mm = rejected.estimate.gouge_mm,
                       .rms_mm = rejected.estimate.rms_mm};
    // Beside walls the planner counts what is reachable.
    if (job.avoid) {
      step.coverage_reachable = step.coverage;
      step.coverage *= reachable_share;
    }
    steps.push_back(step);
  }
  return steps;
}

StiffnessStep judged_step(const RejectedTool& tool, const VerifyReport& verify) {
  return {.slenderness = tool.slenderness,
          .axis_length_mm = tool.axis_length_mm,
          .largest_radius_mm = tool.largest_radius_mm,
          .strips = tool.strips,
          .coverage = verify.coverage,
          .coverage_reachable = verify.coverage_reachable,
          .overcut_mm = verify.overcut_mm,
          .gouge_mm = verify.gouge_mm,
          .rms_mm = verify.rms_mm,
          .judged = true};
}

double spare_needed(const FitJob& job, const VerifyReport& verify, double estimate) {
  constexpr double kLittle = 0.02;  // of the face
  const double proved = verify.coverage_reachable_bound.value_or(verify.coverage_reachable);
  const double missing = job.judge.least_coverage - proved;
  const bool only_that = verify.verdict == Verdict::kPass && missing > 0.0 && missing < kLittle;
  const bool open = job.strips == 0 && !job.start && !job.guide;
  return only_that && open ? std::max(0.0, estimate - proved) : 0.0;
}

}  // namespace flank::internal

namespace flank {
using namespace internal;
namespace {

void check_job(const FitJob& job) {
  check_fields(job);
  check_radius(job.radius);
  if (job.start && job.guide) throw UsageError("start", "cannot be combined with `guide`");
  if (job.stiffness_curve && job.tool.spec != "free")
    throw UsageError("stiffness_curve", "needs a free tool (--tool free)");
}

void check_axis_length(const FitJob& job, const Part& part) {
  if (!job.tool.axis_length_mm) return;
  const double size = part.box.diagonal(), length = *job.tool.axis_length_mm;
  // A thousandth of the part would take a million passes.
  const double longest = 1.5 * size, shortest = 1e-3 * size;
  if (length > longest)
    throw UsageError("axis_length_mm", fmt::format("{}", length),
                     fmt::format("is too long for this part of {:.1f} mm; expected at most {:.1f} mm", size, longest));
  if (length < shortest)
    throw UsageError(
        "axis_length_mm", fmt::format("{}", length),
        fmt::format("is too short for this part of {:.3g} mm; expected at least {:.3g} mm", size, shortest));
}

/// The group that each motion machines.
std::vector<const TargetGroup*> groups_of_motions(const FitSearch& search) {
  std::vector<const TargetGroup*> groups;
  for (const std::size_t g : search.group_of_motion) groups.push_back(&search.machined()[g]);
  return groups;
}

/// Strips of the path, with the notes of what is wrong with them.
std::vector<StripSurface> sample_path(const FitSearch& search, double tolerance_mm, Result& result) {
  const Legitimacy legitimacy = check_legitimacy(result.tool.radial);
  if (!legitimacy.legitimate) result.notes.push_back("the tool's profile is not valid: " + legitimacy.reason);
  std::vector<StripSurface> surfaces = add_strips(tolerance_mm, groups_of_motions(search), result);
  if (result.largest_c >= 1.0)
    result.notes.push_back(fmt::format(
        "the tool moves along its own axis where it touches the machined face: axial slip |c| = {:.3f} >= 1",
        result.largest_c));
  return surfaces;
}

/// What no smooth motion can finish of a mesh.
void note_facets(const FitSearch& search, const FitJob& job, std::vector<std::string>& notes) {
  constexpr double kMostUnsaid = 0.5;  // of what may be missed
  for (const TargetGroup& group : search.targets) {
    const FacetGaps gaps = facet_gaps(*group.target, *job.tolerance_mm);
    if (gaps.share <= kMostUnsaid * (1.0 - job.judge.least_coverage)) continue;
    const double most = coverage_bound_by_facets(*group.target, *job.tolerance_mm);
    const bool hopeless = most < job.judge.least_coverage;
    notes.push_back(fmt::format(
        "{}: the mesh is coarse or rough: on {:.1f} % of it triangles lie farther than the tolerance, up to {:.2g} mm, "
        "off the smooth surface through their corners{}; use a finer mesh, or the CAD file",
        group.faces, 100.0 * gaps.share, gaps.largest_mm,
        hopeless ? fmt::format("; smooth motions finish {:.1f} % at most, so the search ended there", 100.0 * most)
                 : ""));
  }
}

void take_found(const FitSearch& search, Result& result) {
  result.plan = fit_summary(search.fit);
  result.motions = search.motions_of(search.fit);
}

void take_fit(const FitSearch& search, Result& result) {
  // The verdict, now and later, is about what was searched for.
  if (search.reach_radius_mm) std::get<FitJob>(result.job).judge.reach_radius_mm = search.reach_radius_mm;
  take_found(search, result);
  result.diagonal_mm = search.machined().front().target->diagonal();
  result.notes.insert(result.notes.end(), search.fit.notes.begin(), search.fit.notes.end());
  note_facets(search, std::get<FitJob>(result.job), result.notes);
}

/// A rung of the ladder, by the judge's samples: no proof, which would cost more than the fit.
StiffnessStep judged_rung(const Setup& setup, const FitSearch& search, const FlankFitResult& rung,
                          const Result& result) {
  const auto& job = std::get<FitJob>(result.job);
  Result one;
  one.job = job;
  one.tool = found_tool(parse_tool_spec(job.tool.spec), rung.tool, job.obstacles);
  one.motions = search.motions_of(rung);
  (void)add_strips(*job.tolerance_mm, groups_of_motions(search), one);  // surfaces are for drawings
  const VerifyReport verify = judge_job(setup, job.judge, one.tool, one.path, DepthProof::kSampled);
  return judged_step(rejected_tool(rung.tool, rung.motions.size(), rung.after, search.options.bounds), verify);
}

/// What every step of stiffness costs: the tools that were tried on the way, the chosen one, and, if the job asks for the
/// curve, the ladder.
void add_stiffness(const Setup& setup, const FitSearch& search, const Progress& progress, Result& result) {
  const auto& job = std::get<FitJob>(result.job);
  if (!search.tool.free() || search.fit.motions.empty() || !result.complete) return;
  std::vector<StiffnessStep> steps = stiffness_steps(search.fit, job, result.verify.reachable_share);
  const RejectedTool chosen =
      rejected_tool(search.fit.tool, search.fit.motions.size(), search.fit.after, search.options.bounds);
  steps.push_back(judged_step(chosen, result.verify));
  steps.back().chosen = true;
  if (job.stiffness_curve) {
    try {
      for (const FlankFitResult& rung :
           stiffness_ladder(search.tasks(), search.fit, search.tool, search.options, progress))
        steps.push_back(judged_rung(setup, search, rung, result));
    } catch (const Stopped&) {
      result.complete = false;
    }
    if (progress.stop()) result.complete = false;
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const auto& a, const auto& b) { return a.slenderness < b.slenderness; });
  std::get<FitSummary>(result.plan).stiffness = std::move(steps);
}

/// Path, verdict and drawings of what was found; again with a thinner tool or another motion where the judge sees what the
/// search did not.
void judge_fit(const Setup& setup, const ClearanceScene& scene, FitSearch& search, Result& result, Stopwatch& watch) {
  /// The judge looks no deeper than it must to find a place beyond the tolerance: there may be a deeper one.
  constexpr int kMostTimes = 3;
  const FitJob job = std::get<FitJob>(result.job);
  const std::vector<std::string> notes = result.notes;
  std::optional<JudgedFit> before;
  for (int k = 0; k < kMostTimes; ++k) {
    result.notes = notes;
    result.path = {};
    result.chord_bound_mm = 0.0;
    result.tool = found_tool(parse_tool_spec(job.tool.spec), search.fit.tool, job.obstacles);
    std::vector<StripSurface> surfaces = sample_path(search, *job.tolerance_mm, result);
    watch.lap("sample");
    judge_result(setup, scene, std::move(surfaces), result, watch);
    if (!result.complete || k + 1 == kMostTimes) return;
    if (!repair_judged_cuts(*job.tolerance_mm, before, search, result.verify)) return;
    take_found(search, result);
    watch.lap("mend");
  }
}

/// A search and its verdict. `read`: what is known before. `open_shank`: one is chosen for what was found.
Result search_and_judge(const Setup& setup, const ClearanceScene& scene, const ToolSpec& spec, Result read,
                        const FitDemand& demand, bool open_shank, const Progress& progress) {
  FitJob job = std::get<FitJob>(read.job);
  Result result = std::move(read);
  Stopwatch watch(result);
  // What follows the search takes a share of the progress each.
  const double judged_at = job.stiffness_curve ? 0.5 : 0.9;
  FitSearch search = search_fit(job, setup, spec, progress.part(0.0, judged_at), demand);
  if (search.fit.motions.empty()) stop_here();  // nothing takes the place of an earlier result
  if (open_shank && !search.fit.motions.empty())
    choose_shank(job, setup, scene, search, found_tool(spec, search.fit.tool, {}), job.obstacles);
  std::get<FitJob>(result.job).obstacles = job.obstacles;
  if (spec.free && !stopping()) lift_shank(job, scene, search, result.notes);
  take_fit(search, result);
  result.complete = !progress.stop();
  watch.lap("fit");

  progress.step("verify", judged_at);
  judge_fit(setup, scene, search, result, watch);
  add_stiffness(setup, search, progress.part(judged_at + 0.1, 1.0), result);
  if (job.stiffness_curve) watch.lap("stiffness curve");
  return result;
}

/// The progress of the same search once more: its finished steps are taken from the journal.
Progress once_more(const Progress& progress) {
  Progress again = progress;
  again.journal = std::make_shared<Progress::Journal>(*progress.journal->key(), progress.journal->steps(), "");
  return again;
}

bool passes(const Result& result) {
  const auto& job = std::get<FitJob>(result.job);
  return accept(result.tool, result.verify, job.judge, result.complete).reasons.empty();
}

/// What the plans of a job have in common.
struct ReadPart {
  Setup setup;
  ClearanceScene scene;
  decltype(FitDemand::is_free_line) is_free_line;
  std::vector<std::string> notes;  ///< of both
};

ReadPart read_part_of(const FitJob& job, const ToolSpec& spec) {
  ReadPart read;
  read.setup = read_setup(job.part, job.obstacles, job.tolerance_mm, read.notes);
  check_axis_length(job, read.setup.part);
  read.scene = make_clearance_scene(read.setup, job.obstacles, has_body(spec, job.obstacles), read.notes);
  read.is_free_line = free_line_in(read.scene.sight);
  return read;
}

/// A shank that is to be chosen is that of the motions found. `part`: read by an earlier plan of this job, if there was one.
Result plan_fit(const FitJob& request, KnownShank known, const Progress& asked, std::optional<ReadPart>& part) {
  const Progress progress = with_journal(asked);
  check_job(request);
  Result result;
  FitJob job = request;
  // The same as not asked for, to the byte.
  if (job.part.allowance_mm == 0.0) job.part.allowance_mm.reset();
  result.inputs = input_stamps(job);
  const ToolSpec spec = parse_tool_spec(job.tool.spec);
  result.notes.insert(result.notes.end(), spec.notes.begin(), spec.notes.end());
  job.obstacles.shank = default_shank(job.obstacles, spec.tool && has_body(*spec.tool));
  check_obstacles(job.obstacles, spec.tool ? &*spec.tool : nullptr);
  Stopwatch watch(result);
  progress.step("read", 0.0);
  if (!part) part = read_part_of(job, spec);
  const Setup& setup = part->setup;
  const ClearanceScene& scene = part->scene;
  result.notes.insert(result.notes.end(), part->notes.begin(), part->notes.end());
  job.tolerance_mm = setup.tolerance_mm;
  result.job = job;
  result.part_sha256 = setup.part.sha256;
  progress.journal->begin(journal_key(job, result.part_sha256));
  watch.lap("read");
  stop_here();

  const Result read = result;
  const bool in_the_way = known == KnownShank::kInTheWay,
             open = job.obstacles.shank == "auto" || known == KnownShank::kLength;
  result = search_and_judge(setup, scene, spec, read, {0.0, part->is_free_line, in_the_way}, open, progress);
  const double estimate = std::get<FitSummary>(result.plan).after.coverage;
  const double spare = result.complete ? spare_needed(job, result.verify, estimate) : 0.0;
  if (spare > 0.0) {
    try {
      Result stricter = search_and_judge(setup, scene, spec, read, {spare, part->is_free_line, in_the_way}, open,
                                         once_more(progress));
      if (passes(stricter)) result = std::move(stricter);
    } catch (const Stopped&) {  // what was found before is whole
    }
  }
  if (!result.complete) result.journal = progress.journal;
  return result;
}

}  // namespace

Result run_fit(const FitJob& request, const Progress& asked) {
  std::optional<ReadPart> part;
  const ShankPlan<FitJob> plan = [&](const FitJob& job, KnownShank known, const Progress& progress) {
    return plan_fit(job, known, progress, part);
  };
  const double slenderest = parse_tool_spec(request.tool.spec).free ? request.radius.slenderness_max : kAnySlenderness;
  return with_room_for_shank<FitJob>(request, false, slenderest, plan, asked);
}

}  // namespace flank
