#include "flank/pipeline/fit_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "flank/artefact/view.h"
#include "flank/artefact/view_json.h"
#include "flank/base/tolerance_budget.h"
#include "flank/envelope.h"
#include "flank/envelope/path_regularity.h"
#include "flank/error.h"
#include "flank/fit/lengthen.h"
#include "flank/pipeline/fit_search.h"
#include "flank/pipeline/judge_job.h"
#include "flank/setup/targets.h"
#include "flank/strip/used_times.h"
#include "flank/toolbox/tool_model.h"

namespace flank::internal {
namespace {

void require(bool holds, const std::string& message) {
  if (!holds) throw UsageError(message);
}

void check_job(const FitJob& job) {
  require(job.tolerance_mm > 0.0 && std::isfinite(job.tolerance_mm), "--tolerance: a length > 0 mm is needed");
  require(!job.axis_length_mm || *job.axis_length_mm > 0.0, "--axis-length: a length > 0 mm is needed");
  require(!job.radius_min_mm || *job.radius_min_mm > 0.0, "--radius-min: a radius > 0 mm is needed");
  require(!job.radius_max_mm || *job.radius_max_mm > job.radius_min_mm.value_or(0.0),
          "--radius-max: a radius above --radius-min is needed");
  require(job.slope_max > 0.0 && job.slope_max < 1.0, "--slope-max: a number between 0 and 1 is needed");
  require(job.strips >= 0 && job.strips <= 64, "--strips: auto or a number from 1 to 64 is needed");
  require(job.least_coverage >= 0.0 && job.least_coverage <= 1.0, "--coverage: a share between 0 and 1 is needed");
  check_reach_radius(job);
  require(!(job.start && job.guide), "--start and --guide: give one of them");
}

/// Open bounds: a hundredth of the target's diagonal to 15 hundredths of it.
RadiusBounds bounds_of(const FitJob& job, double diagonal) {
  RadiusBounds bounds;
  bounds.largest = job.radius_max_mm.value_or(std::max(0.15 * diagonal, 2.0 * job.radius_min_mm.value_or(0.0)));
  bounds.smallest = job.radius_min_mm.value_or(std::min(0.01 * diagonal, 0.5 * bounds.largest));
  bounds.steepest = job.slope_max;
  return bounds;
}

/// The poses [first, last) of a range of times, and one more at each end.
std::pair<std::size_t, std::size_t> poses_between(const std::vector<double>& t, const TimeRange& range) {
  const auto after_first = std::upper_bound(t.begin(), t.end(), range.first);
  const auto not_before_last = std::lower_bound(t.begin(), t.end(), range.last);
  return {after_first == t.begin() ? 0 : static_cast<std::size_t>(after_first - t.begin()) - 1,
          not_before_last == t.end() ? t.size() : static_cast<std::size_t>(not_before_last - t.begin()) + 1};
}

/// The side of the contact points that look from the middle of the motion to the target.
int machining_contact(const RuledMotion& motion, const RadialFunction& radial, const Target& target) {
  const Vec3 middle = motion.pose(0.5).at(0.5 * radial.axis_length());
  return contact_side(motion, radial, target.closest(middle).point - middle);
}

void sample_path(const FitJob& job, const FitSearch& search, FitOutcome& outcome) {
  std::vector<const TargetGroup*> groups;
  for (const std::size_t g : search.group_of_motion) groups.push_back(&search.targets[g]);
  add_strips(job, search.fit.motions, groups, outcome);
}

/// Lifts a shank or holder that comes too near, where the flank's length is open (lengthen.h).
void lift_shank(const FitJob& job, const Part& part, const std::vector<int>& faces, const std::vector<int>& checks,
                FitSearch& search, FitOutcome& outcome) {
  if (job.axis_length_mm || (!job.clearance.shank_length_mm && !job.clearance.holder)) return;
  const auto clear = [&](const FlankFitResult& fit) {
    Tool tool;
    tool.radial = fit.tool;
    equip_tool(job.clearance, tool);
    Path path;
    for (const RuledMotion& motion : fit.motions) {
      SamplingOptions options;
      options.chord_tolerance_mm = kToleranceBudget.chord * job.tolerance_mm;
      path.strips.push_back({});
      path.strips.back().poses = sample_motion(motion, options).poses;
    }
    std::vector<std::string> notes;
    return measure_clearance(job.clearance, tool, path, part, faces, checks, job.unit, job.tolerance_mm, notes).kept();
  };
  const double more = lengthen_until_clear(search.fit, std::max(1.0, job.clearance.required_mm.value_or(0.0)), clear);
  if (more > 0.0)
    outcome.notes.push_back(
        fmt::format("the flank was lengthened by {} mm, so that shank and holder keep their clearances", more));
}

}  // namespace

Acceptance FitOutcome::acceptance(const FitJob& job) const {
  return accept(tool, verify, job.least_coverage, complete);
}

void Stopwatch::lap(const std::string& stage) {
  const auto now = std::chrono::steady_clock::now();
  outcome_.seconds.emplace_back(stage, std::chrono::duration<double>(now - last_).count());
  last_ = now;
}

void add_strips(const FitJob& job, const std::vector<RuledMotion>& motions,
                const std::vector<const TargetGroup*>& groups, FitOutcome& outcome) {
  std::vector<const Target*> targets;
  for (const TargetGroup* group : groups)
    if (std::find(targets.begin(), targets.end(), group->target.get()) == targets.end())
      targets.push_back(group->target.get());
  const RadialFunction& radial = outcome.tool.radial;
  const std::vector<TimeRange> used = used_times(motions, radial, targets, job.tolerance_mm);
  for (std::size_t m = 0; m < motions.size(); ++m) {
    SamplingOptions options;
    options.chord_tolerance_mm = kToleranceBudget.chord * job.tolerance_mm;
    const SampledMotion sampled = sample_motion(motions[m], options);
    outcome.chord_bound_mm = std::max(outcome.chord_bound_mm, sampled.chord_bound_mm);
    Strip strip;
    strip.id = static_cast<int>(m) + 1;
    strip.face = groups[m]->faces;
    const auto [first, last] = poses_between(sampled.t, used[m]);
    strip.poses.assign(sampled.poses.begin() + static_cast<std::ptrdiff_t>(first),
                       sampled.poses.begin() + static_cast<std::ptrdiff_t>(last));
    outcome.strip_surfaces.push_back(strip_surface({strip.id, motions[m], sampled.t[first], sampled.t[last - 1],
                                                    machining_contact(motions[m], radial, *groups[m]->target)},
                                                   radial));
    outcome.path.strips.push_back(std::move(strip));
  }
  outcome.largest_c = largest_c(outcome.path, radial);
  note_strip_surfaces(outcome.strip_surfaces, outcome.notes);
}

void judge_outcome(const FitJob& job, const Part& part, const std::vector<int>& faces, const std::vector<int>& checks,
                   FitOutcome& outcome, Stopwatch& watch) {
  outcome.verify = judge_job(job, part, faces, checks, outcome.tool, outcome.path);
  watch.lap("verify");
  outcome.verify.clearance = measure_clearance(job.clearance, outcome.tool, outcome.path, part, faces, checks, job.unit,
                                               job.tolerance_mm, outcome.notes);
  watch.lap("clearance");
  outcome.view = view_to_json(make_view(job, part, faces, outcome.tool, outcome.path, outcome.verify));
  watch.lap("view");
}

FitOutcome run_fit(const FitJob& job, const Progress& progress) {
  check_job(job);
  const ToolSpec spec = parse_tool_spec(job.tool);
  check_clearance_job(job.clearance, spec.tool ? &*spec.tool : nullptr);
  FitOutcome outcome;
  Stopwatch watch(outcome);
  progress.step("read", 0.0);
  const Part part = read_part(job.part, job.unit);
  const std::vector<int> faces = parse_face_list(part, job.faces);
  const std::vector<int> checks = faces_to_check(part, faces, job.check);
  outcome.notes = part.repairs;
  if (const std::string note = unchecked_note(part, faces, checks); !note.empty()) outcome.notes.push_back(note);
  require(!job.axis_length_mm || *job.axis_length_mm <= 1.5 * part.box.diagonal(),
          fmt::format("--axis-length {} mm is longer than the part ({:.1f} mm); lengths up to {:.1f} mm are accepted",
                      job.axis_length_mm.value_or(0.0), part.box.diagonal(), 1.5 * part.box.diagonal()));
  watch.lap("read");

  FitSearch search = search_fit(job, part, faces, checks, spec, bounds_of, progress);
  if (spec.free) lift_shank(job, part, faces, checks, search, outcome);
  outcome.fit = search.fit;
  outcome.diagonal_mm = search.targets.front().target->diagonal();
  outcome.notes.insert(outcome.notes.end(), search.fit.notes.begin(), search.fit.notes.end());
  outcome.complete = !progress.stop();
  watch.lap("fit");

  outcome.tool.radial = search.fit.tool;
  outcome.tool.name = spec.free ? "free" : std::string(family_name(search.fit.tool.family()));
  if (spec.tool) outcome.tool = *spec.tool;
  equip_tool(job.clearance, outcome.tool);
  const Legitimacy legitimacy = check_legitimacy(outcome.tool.radial);
  if (!legitimacy.legitimate) outcome.notes.push_back("the tool is not legitimate: " + legitimacy.reason);
  sample_path(job, search, outcome);
  if (outcome.largest_c >= 1.0)
    outcome.notes.push_back(
        fmt::format("the tool plunges: |c| = {:.3f} >= 1 somewhere along the path", outcome.largest_c));
  watch.lap("sample");

  progress.step("verify", 0.9);
  judge_outcome(job, part, faces, checks, outcome, watch);
  return outcome;
}

}  // namespace flank::internal
