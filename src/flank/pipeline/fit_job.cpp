#include "flank/pipeline/fit_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "flank/base/error.h"
#include "flank/envelope/envelope.h"
#include "flank/pipeline/fit_search.h"
#include "flank/pipeline/targets.h"
#include "flank/pipeline/tool_model.h"
#include "flank/pipeline/verify_job.h"
#include "flank/pipeline/view.h"
#include "flank/pipeline/view_json.h"

namespace flank {
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

/// Poses before the first and after the last one that touches the target are cut off, but for one: they machine
/// nothing.
std::vector<Pose> touching_poses(const std::vector<Pose>& poses, const Target& target, double axis_length) {
  const auto touches = [&](const Pose& pose) {
    constexpr int kSamples = 24;
    for (int j = 0; j <= kSamples; ++j)
      if (target.closest(pose.at(axis_length * j / kSamples)).location == Location::kInside) return true;
    return false;
  };
  const auto first = std::find_if(poses.begin(), poses.end(), touches);
  if (first == poses.end()) return poses;
  const auto last = std::find_if(poses.rbegin(), std::make_reverse_iterator(first), touches).base();
  return {first == poses.begin() ? first : first - 1, last == poses.end() ? last : last + 1};
}

void sample_path(const FitJob& job, const FitSearch& search, FitOutcome& outcome) {
  for (std::size_t m = 0; m < search.fit.motions.size(); ++m)
    add_strip(job, search.fit.motions[m], search.targets[search.group_of_motion[m]], outcome);
}

}  // namespace

void Stopwatch::lap(const std::string& stage) {
  const auto now = std::chrono::steady_clock::now();
  outcome_.seconds.emplace_back(stage, std::chrono::duration<double>(now - last_).count());
  last_ = now;
}

void add_strip(const FitJob& job, const RuledMotion& motion, const TargetGroup& group, FitOutcome& outcome) {
  SamplingOptions options;
  options.chord_tolerance_mm = 0.02 * job.tolerance_mm;
  const SampledMotion sampled = sample_motion(motion, options);
  outcome.chord_bound_mm = std::max(outcome.chord_bound_mm, sampled.chord_bound_mm);
  Strip strip;
  strip.id = static_cast<int>(outcome.path.strips.size()) + 1;
  strip.face = group.faces;
  strip.poses = touching_poses(sampled.poses, *group.target, motion.axis_length);
  outcome.path.strips.push_back(std::move(strip));
  const Regularity regular = regularity(motion, outcome.tool.radial, 200, 40);
  outcome.largest_c = std::max(outcome.largest_c, regular.largest_c);
}

void judge_outcome(const FitJob& job, const Part& part, const std::vector<int>& faces, FitOutcome& outcome,
                   Stopwatch& watch) {
  const double spacing = job.sample_mm.value_or(default_spacing(part.box.diagonal()));
  JudgeOptions options;
  options.tolerance_mm = job.tolerance_mm;
  outcome.verify = judge(outcome.tool, outcome.path, judge_samples(part, faces, spacing, 2.0 * spacing), options);
  watch.lap("verify");
  outcome.verify.clearance = measure_clearance(job.clearance, outcome.tool, outcome.path, part, faces, job.unit,
                                               job.tolerance_mm, outcome.notes);
  watch.lap("clearance");
  outcome.view = view_to_json(make_view(job, part, faces, outcome.tool, outcome.path, outcome.verify));
  watch.lap("view");
}

int FitOutcome::exit_code(const FitJob& job) const {
  // A given tool has nothing to blame: its strips keep clear of every face of the part.
  const bool clean = job.command != "cover" || verify.gouge_mm <= job.tolerance_mm;
  const bool done = complete && clean && verify.overcut_mm <= job.tolerance_mm &&
                    verify.coverage >= job.least_coverage && verify.clearance.kept() &&
                    check_legitimacy(tool.radial).legitimate;
  return done ? 0 : 1;
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
  outcome.notes = part.repairs;
  require(!job.axis_length_mm || *job.axis_length_mm <= 1.5 * part.box.diagonal(),
          fmt::format("--axis-length {} mm is longer than the part ({:.1f} mm); lengths up to {:.1f} mm are accepted",
                      job.axis_length_mm.value_or(0.0), part.box.diagonal(), 1.5 * part.box.diagonal()));
  watch.lap("read");

  FitSearch search = search_fit(job, part, faces, spec, bounds_of, progress);
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
  judge_outcome(job, part, faces, outcome, watch);
  return outcome;
}

}  // namespace flank
