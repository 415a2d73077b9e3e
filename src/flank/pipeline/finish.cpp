#include "flank/pipeline/finish.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "flank/base/stopping.h"
#include "flank/base/tolerance_budget.h"
#include "flank/envelope.h"
#include "flank/envelope/path_regularity.h"
#include "flank/motion/written_path.h"
#include "flank/path/bend_radius.h"
#include "flank/pipeline/cut_direction.h"
#include "flank/pipeline/judge/judge_job.h"
#include "flank/results/view.h"
#include "flank/strip/used_times.h"
#include "flank/surface/ball_touch.h"

namespace flank::internal {
namespace {

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

const JudgeRequest& request_of(const Result& result) {
  return std::visit([](const auto& plan) -> const JudgeRequest& { return plan.judge; }, result.job);
}

/// How passes are to mill; nothing for the cycles of a cavity, which are planned so.
const std::string* cut_of(const PlanJob& job) {
  if (const auto* fit = std::get_if<FitJob>(&job)) return &fit->cut;
  if (const auto* cover = std::get_if<CoverJob>(&job)) return &cover->cut;
  return nullptr;
}

/// After a stop, seconds: for a verdict and its picture.
constexpr double kPatience = 2.5;

/// Of a result that was stopped: by a few samples, if they take no longer than anybody waits. Half a verdict is none.
VerifyReport quick_verdict(const Setup& setup, JudgeRequest request, const ClearanceScene& scene,
                           const Result& result) {
  constexpr double kFewSamples = 20000.0;  // coverage to a tenth of a percent
  request.sample_mm = std::max(request.sample_mm.value_or(0.0), coarse_spacing(setup, kFewSamples));
  try {
    VerifyReport report = judge_job(setup, request, result.tool, result.path, DepthProof::kSampled);
    measure_bodies(scene, result.tool, result.path, report);
    return report;
  } catch (const Stopped&) {
    VerifyReport none;
    none.tolerance_mm = setup.tolerance_mm;
    none.sheet_sides = setup.sides;
    return none;
  }
}

}  // namespace

void Stopwatch::lap(const std::string& stage) {
  const auto now = std::chrono::steady_clock::now();
  const auto known =
      std::find_if(result_.seconds.begin(), result_.seconds.end(), [&](const auto& lap) { return lap.first == stage; });
  const double seconds = std::chrono::duration<double>(now - last_).count();
  if (known == result_.seconds.end())
    result_.seconds.emplace_back(stage, seconds);
  else
    known->second += seconds;
  last_ = now;
}

std::vector<StripSurface> add_strips(double tolerance_mm, const std::vector<const TargetGroup*>& machined_groups,
                                     Result& result) {
  std::vector<const TargetGroup*> groups = machined_groups;
  if (const std::string* cut = cut_of(result.job)) run_as(*cut, result.motions, groups);
  const std::vector<RuledMotion>& motions = result.motions;
  std::vector<StripSurface> surfaces;
  std::vector<const Target*> targets;
  for (const TargetGroup* group : groups)
    if (std::find(targets.begin(), targets.end(), group->target.get()) == targets.end())
      targets.push_back(group->target.get());
  const RadialFunction& radial = result.tool.radial;
  const std::vector<TimeRange> used = used_times(motions, radial, targets, tolerance_mm);
  for (std::size_t m = 0; m < motions.size(); ++m) {
    const SampledMotion sampled = sample_motion(motions[m], written_path(tolerance_mm));
    result.chord_bound_mm = std::max(result.chord_bound_mm, sampled.chord_bound_mm);
    Strip strip;
    strip.id = static_cast<int>(m) + 1;
    strip.face = groups[m]->faces;
    const auto [first, last] = poses_between(sampled.t, used[m]);
    strip.poses.assign(sampled.poses.begin() + static_cast<std::ptrdiff_t>(first),
                       sampled.poses.begin() + static_cast<std::ptrdiff_t>(last));
    surfaces.push_back(strip_surface({strip.id, motions[m], sampled.t[first], sampled.t[last - 1],
                                      machining_contact(motions[m], radial, *groups[m]->target)},
                                     radial, tolerance_mm));
    result.path.strips.push_back(std::move(strip));
  }
  result.largest_c = largest_c(result.path, radial, [&](const Vec3& centre, double ball_mm) {
    return ball_touches(targets, centre, ball_mm, tolerance_mm);
  });
  result.bends = least_bend_radii(result.path, radial.axis_length(), kToleranceBudget.chord * tolerance_mm);
  note_strip_surfaces(surfaces, radial.axis_length(), result.notes);
  return surfaces;
}

VerifyReport judged(const Setup& setup, const ClearanceScene& scene, const Result& result, Stopwatch& watch) {
  stop_here();
  VerifyReport report = judge_job(setup, request_of(result), result.tool, result.path);
  watch.lap("verify");
  measure_bodies(scene, result.tool, result.path, report);
  watch.lap("clearance");
  return report;
}

void judge_result(const Setup& setup, const ClearanceScene& scene, std::vector<StripSurface> surfaces, Result& result,
                  Stopwatch& watch, std::optional<VerifyReport> known) {
  std::optional<StopGrace> grace;
  try {
    result.verify = known ? std::move(*known) : judged(setup, scene, result, watch);
  } catch (const Stopped&) {
    result.complete = false;
    grace.emplace(kPatience);
    result.verify = quick_verdict(setup, request_of(result), scene, result);
  }
  add_caveats(result.verify, result.notes);
  auto drawings = std::make_shared<Result::Drawings>();
  drawings->strips = std::move(surfaces);
  drawings->view = make_view(result.job, setup, result.tool, result.path, result.verify);
  result.drawings = std::move(drawings);
  watch.lap("view");
}

}  // namespace flank::internal
