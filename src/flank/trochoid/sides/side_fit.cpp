#include "flank/trochoid/sides/side_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "flank/base/journal.h"
#include "flank/base/parallel.h"
#include "flank/fit/coverage.h"
#include "flank/fit/fit_record.h"
#include "flank/fit/polish.h"
#include "flank/fit/rejected.h"
#include "flank/fit/swept_polish.h"
#include "flank/motion/stagger.h"
#include "flank/trochoid/sides/axial_ends.h"
#include "flank/trochoid/sides/side_room.h"

namespace flank::internal {
namespace {

constexpr std::size_t kPolished = 2;  ///< of the starts of one radius
/// Of the target's size: mean error of an exact envelope, with room for what a free tool's spline leaves.
constexpr double kEnvelope = 3e-6;
/// In tolerances, at which a quick fit weighs error against axes that go together.
constexpr double kQuickParallel = 2.0;

struct Candidate {
  FitDraft draft;
  double score = -1.0;
  bool swapped = false;  ///< how its start lay on the left side's chart
};

/// The best few, the best first. Of those of a symmetric cavity that are each other's mirror image one is enough: its place is
/// for the best of those that lie across the others.
std::vector<Candidate> best_of(std::vector<Candidate> candidates) {
  constexpr double kAlike = 1e-6;
  std::erase_if(candidates, [](const Candidate& c) { return c.draft.motions.empty() || !has_values(c.draft); });
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  if (candidates.size() > kPolished && candidates[kPolished - 1].score > candidates.front().score - kAlike) {
    const auto other = std::find_if(candidates.begin() + kPolished, candidates.end(),
                                    [&](const Candidate& c) { return c.swapped != candidates.front().swapped; });
    if (other != candidates.end()) std::iter_swap(candidates.begin() + kPolished - 1, other);
  }
  candidates.resize(std::min(candidates.size(), kPolished));
  return candidates;
}

/// Score of a draft, less a price for axes that are not parallel across the cavity, which bounds the steps of all cycles; for
/// axes that lean along it, because the tool must then be longer, and at the ends of the cavity it is in one side long before
/// the other; and for axes that lie along it.
double worth(const FitDraft& draft, const CoverageEstimate& estimate, double tolerance) {
  constexpr double kStagger = 2.0, kLean = 0.1;        // of coverage: 12 degrees cost two fifths, and two percent
  constexpr double kMuchLean = 0.3, kSteepLean = 1.0;  // from 17 degrees on, another percent for each percent
  constexpr double kLying = 0.5;
  constexpr double kMostPrice = 0.5;
  const double lean = mean_lean(draft.motions);
  const double price = kStagger * mean_stagger(draft.motions) + kLean * lean +
                       kSteepLean * std::max(0.0, lean - kMuchLean) + kLying * lying(draft.motions);
  return estimate.score(tolerance) - std::min(kMostPrice, price);
}

std::vector<SurfaceSample> samples_of(const CavitySide& left, const CavitySide& right, const FlankFitOptions& options) {
  std::vector<SurfaceSample> samples = ranking_samples(*left.target, left.obstacles, options);
  const std::vector<SurfaceSample> more = ranking_samples(*right.target, right.obstacles, options);
  samples.insert(samples.end(), more.begin(), more.end());
  return samples;
}

/// The best that the starts of one radius give, polished.
struct RadiusFit {
  Polished polished;
  std::vector<IterationTrace> trace;
  int starts = 0;  ///< that were tried
};

void code(StepCodec& codec, RadiusFit& fit) {
  code(codec, fit.polished);
  code(codec, fit.trace);
  code(codec, fit.starts);
}

/// The draft is one of these sides, in turn.
void reattach_targets(FitDraft& draft, const CavitySide& left, const CavitySide& right) {
  draft.targets.clear();
  draft.obstacles.clear();
  for (std::size_t m = 0; m < draft.motions.size(); ++m) {
    const CavitySide& side = m % 2 == 0 ? left : right;
    draft.targets.push_back(side.target);
    draft.obstacles.push_back(side.obstacles);
  }
}

/// Whether an end of a motion was cut off because it is axial.
bool cut_axial_ends(FitDraft& draft) {
  bool cut = false;
  for (RuledMotion& motion : draft.motions) {
    RuledMotion rest = without_axial_ends(motion);
    cut = cut || rest.tip.knots != motion.tip.knots;
    motion = std::move(rest);
  }
  return cut;
}

Polished with_axial_ends_cut(Polished polished, const std::vector<SurfaceSample>& samples, const FlankFitOptions& fit) {
  if (!cut_axial_ends(polished.draft)) return polished;
  const bool exact = polished.exact;
  Polished out = assess(std::move(polished.draft), samples, fit);
  out.exact = exact;
  return out;
}

/// The same, without a bound on slenderness where even the thickest cylinder that is allowed does not keep it: between bounds that no
/// tool keeps a fit goes astray.
FlankFitOptions possible(FlankFitOptions fit, double axis_length) {
  const RadialFunction thickest(ToolFamily::kCylinder, axis_length, Eigen::VectorXd::Constant(1, fit.bounds.largest));
  if (slenderness_of(thickest, fit.bounds) > fit.bounds.slenderest) fit.bounds.slenderest = RadiusBounds{}.slenderest;
  return fit;
}

class SideFitter {
 public:
  SideFitter(const CavitySide& left, const CavitySide& right, const ToolModel& tool, const SideFitOptions& options)
      : left_(left),
        right_(right),
        tool_(tool),
        options_(options),
        left_chart_(*left.target),
        right_chart_(*right.target),
        samples_(samples_of(left, right, options.fit)) {
    FlankFitOptions coarse = options.fit;
    coarse.sample_share = kQuickSampleShare;
    few_ = samples_of(left, right, coarse);
  }

  [[nodiscard]] RadiusFit fit_radius(const RadiusStart& first) const;
  /// Whether another start is not needed.
  [[nodiscard]] bool is_done(const Polished& polished) const;
  [[nodiscard]] const std::vector<SurfaceSample>& samples() const { return samples_; }

 private:
  [[nodiscard]] Candidate quick(const SideStart& start, const FlankFitOptions& asked) const;
  void rank(FitDraft draft, Candidate& candidate) const;

  const CavitySide &left_, &right_;
  const ToolModel& tool_;
  const SideFitOptions& options_;
  Chart left_chart_, right_chart_;
  std::vector<SurfaceSample> samples_, few_;
};

/// A draft takes the candidate's place if it is worth more.
void SideFitter::rank(FitDraft draft, Candidate& candidate) const {
  if (!has_values(draft)) return;
  cut_axial_ends(draft);
  const double tolerance = kQuickTolerances * options_.fit.tolerance_mm;
  CoverageEstimate estimate = estimate_coverage(few_, draft.motions, draft.tool, tolerance, kQuickPoses);
  estimate.gouge_mm = flank_gouge(draft.motions, draft.obstacles, draft.tool, options_.fit.bounds, kQuickPoses);
  const double score = worth(draft, estimate, tolerance);
  if (!candidate.draft.motions.empty() && candidate.score >= score) return;
  candidate.draft = std::move(draft);
  candidate.score = score;
}

Candidate SideFitter::quick(const SideStart& start, const FlankFitOptions& asked) const {
  Candidate candidate;
  candidate.swapped = start.swapped;
  const auto length = [this](double wanted) { return tool_.length_for(wanted, options_.fit.axis_length_mm); };
  const std::vector<FitTask> tasks =
      side_tasks(left_, right_, left_chart_, right_chart_, start, options_.layers, length, options_.up);
  if (tasks.empty()) return candidate;
  const FlankFitOptions fit = possible(asked, tasks.front().motion.axis_length);
  if (!options_.slender && fit.bounds.slenderest != asked.bounds.slenderest) return candidate;
  const double tip = std::min(start.radius_mm, start.tip_mm);
  const double slope = std::clamp((start.radius_mm - tip) / tasks.front().motion.axis_length, 0.0, 1.0);
  FitDraft draft = start_draft(tasks, tool_, tip, slope);
  draft.facing = options_.facing;
  FitStage stage = quick_stage(robust_scale(*left_.target, fit));
  if (draft.facing) set_motion_weights(stage, kQuickParallel * fit.tolerance_mm, left_.target->diagonal());
  rank(draft, candidate);
  // A start may be nearly done, as along the lines of ruled walls, and a coarse pass then only does harm.
  rank(run_stage(draft, fit.bounds, stage), candidate);
  return candidate;
}

RadiusFit SideFitter::fit_radius(const RadiusStart& first) const {
  constexpr double kDegree = std::numbers::pi / 180.0;
  constexpr std::array<double, 5> kSkews = {0.0, 12.0, -12.0, 25.0, -25.0};
  const double radius = first.radius_mm;
  FlankFitOptions fit = options_.fit;
  if (tool_.free()) fit.bounds.smallest = std::max(fit.bounds.smallest, first.least_share * radius);
  std::vector<SideStart> all;
  for (const bool swapped : {false, true})
    for (const double skew : kSkews) all.push_back({swapped, skew * kDegree, radius, first.tip_share * radius});
  std::vector<Candidate> candidates(all.size());
  parallel_for(all.size(), [&](std::size_t k) { candidates[k] = quick(all[k], fit); });
  RadiusFit out;
  out.starts = static_cast<int>(all.size());
  candidates = best_of(std::move(candidates));
  std::vector<Polished> polished(candidates.size());
  std::vector<std::vector<IterationTrace>> traces(candidates.size());
  parallel_for(candidates.size(), [&](std::size_t k) {
    const FlankFitOptions here = possible(fit, candidates[k].draft.tool.axis_length());
    polished[k] = with_axial_ends_cut(polish(candidates[k].draft, samples_, here, &traces[k]), samples_, here);
  });
  const auto value = [&](std::size_t k) {
    return worth(polished[k].draft, polished[k].estimate, options_.fit.tolerance_mm);
  };
  std::size_t best = 0;
  for (std::size_t k = 1; k < polished.size(); ++k)
    if (value(k) > value(best)) best = k;
  if (polished.empty()) return out;
  out.trace = std::move(traces[best]);
  fit = possible(std::move(fit), polished[best].draft.tool.axis_length());
  out.polished = last_passes(polished[best], samples_, fit, &out.trace);
  // The passes for envelopes do not look across the cavity. A true envelope is not given away for its stagger; what is only
  // near to one is.
  const bool envelope = out.polished.estimate.rms_mm <= kEnvelope * left_.target->diagonal();
  if (options_.facing && out.polished.exact && !envelope)
    out.polished = reduce_stagger(out.polished, options_.least_coverage, samples_, fit, &out.trace);
  out.polished = with_axial_ends_cut(std::move(out.polished), samples_, fit);
  return out;
}

bool SideFitter::is_done(const Polished& polished) const {
  // A term that is soft leaves its allowance by a hair, and a stout tool is not worth that.
  constexpr double kHair = 1.01;
  const CoverageEstimate& e = polished.estimate;
  if (std::max(e.overcut_mm, e.gouge_mm) > kHair * options_.fit.tolerance_mm) return false;
  const double asked = options_.fit.reach_radius_mm;
  return covers_reachable(left_, right_, e.at_tolerance, options_.least_coverage,
                          asked > 0.0 ? asked : polished.draft.tool.smallest());
}

/// Whether sides cover clearly less than is asked for of what a tool like this reaches: the last passes do not make up for that.
bool falls_short(const CavitySide& left, const CavitySide& right, const Polished& best, const SideFitOptions& options) {
  constexpr double kClearly = 0.95;
  const RadialFunction& tool = best.draft.tool;
  const double asked = options.fit.reach_radius_mm;
  const double reach = std::min(reachable_share(left, right, asked > 0.0 ? asked : tool.smallest()),
                                reach_of_tool(left, right, best.draft.motions, tool));
  return best.estimate.at_tolerance < kClearly * options.least_coverage * reach;
}

/// The best of all radii that are tried.
SideFit search_radii(const CavitySide& left, const CavitySide& right, const ToolModel& tool,
                     const SideFitOptions& options, const Progress& progress) {
  constexpr double kFree = 1.1;
  SideFit out;
  const SideFitter fitter(left, right, tool, options);
  Polished best;
  const double tolerance = options.fit.tolerance_mm;
  double free_radius = 0.0;  // start with which no radius came near to its least one
  for (const RadiusStart& start : options.starts) {
    // With a lower one it would come to the same.
    if (start.radius_mm == free_radius && start.tip_share == 1.0) continue;
    if (!best.draft.motions.empty() &&
        covers_reachable(left, right, best.estimate.at_tolerance, start.unless_covered, best.draft.tool.smallest()))
      continue;
    progress.step("sides", 0.5 * out.tried_radii / static_cast<double>(options.starts.size()));
    if (progress.stop() && !best.draft.motions.empty()) break;
    RadiusFit tried = journaled(
        progress, "radius", [&] { return fitter.fit_radius(start); }, start);
    reattach_targets(tried.polished.draft, left, right);
    ++out.tried_radii;
    out.fit.candidates += tried.starts;
    if (tried.polished.draft.motions.empty()) continue;
    const bool better = best.draft.motions.empty() || worth(tried.polished.draft, tried.polished.estimate, tolerance) >
                                                          worth(best.draft, best.estimate, tolerance);
    const bool done = fitter.is_done(tried.polished);
    if (start.tip_share == 1.0 && tried.polished.draft.tool.smallest() > kFree * start.least_share * start.radius_mm)
      free_radius = start.radius_mm;
    if (better) {
      best = std::move(tried.polished);
      out.fit.trace = std::move(tried.trace);
      out.start = start;
    }
    if (done) break;
  }
  if (best.draft.motions.empty()) {
    out.fit.status = FitStatus::kNoStart;
    out.fit.message = "every position of the axis that touches both sides collides";
    return out;
  }
  const FlankFitOptions fit = possible(options.fit, best.draft.tool.axis_length());
  out.settled = !tool.free() || !falls_short(left, right, best, options);
  out.facing = options.facing;
  const Polished close =
      out.settled ? repair_closely(without_overcut(best, fitter.samples(), fit), fit) : std::move(best);
  out.fit = make_result(close, fit, std::move(out.fit));
  return out;
}

}  // namespace

void code(StepCodec& codec, RadiusStart& start) {
  for (double* value : {&start.radius_mm, &start.least_share, &start.unless_covered, &start.tip_share})
    codec.number(*value);
}

void code(StepCodec& codec, SideFit& sides) {
  code(codec, sides.fit);
  code(codec, sides.start);
  code(codec, sides.tried_radii);
  code(codec, sides.settled);
  code(codec, sides.facing);
  codec.require(sides.fit.motions.size() % 2 == 0, "expected a motion for each side");
}

CavityWidth width_between(const CavitySide& left, const CavitySide& right) {
  constexpr double kSmallBall = 0.1;  // of the width there: it would be free at a wall that no other face covers
  std::vector<double> widths;
  for (const SurfaceSample& sample : left.target->samples(std::sqrt(left.target->area()) / 30.0)) {
    const double width = (right.target->closest(sample.point).point - sample.point).norm();
    if (left.obstacles == nullptr ||
        left.obstacles->reachable(sample, kSmallBall * width, left.obstacles->allowance_mm()))
      widths.push_back(width);
  }
  if (widths.empty()) return {};
  std::sort(widths.begin(), widths.end());
  return {widths.front(), widths[widths.size() / 2]};
}

double reachable_share(const CavitySide& left, const CavitySide& right, double radius_mm) {
  int reached = 0, all = 0;
  for (const CavitySide* side : {&left, &right}) {
    for (const SurfaceSample& sample : side->target->samples(std::sqrt(side->target->area()) / 30.0)) {
      ++all;
      if (side->obstacles == nullptr || side->obstacles->reachable(sample, radius_mm, side->obstacles->allowance_mm()))
        ++reached;
    }
  }
  return all > 0 ? static_cast<double>(reached) / all : 1.0;
}

bool covers_reachable(const CavitySide& left, const CavitySide& right, double covered, double least_coverage,
                      double radius_mm) {
  return covered >= least_coverage || covered >= least_coverage * reachable_share(left, right, radius_mm);
}

double facing(const Target& left, const Target& right) {
  double sum = 0.0, area = 0.0;
  for (const SurfaceSample& sample : left.samples(std::sqrt(left.area()) / 15.0)) {
    const Footpoint foot = right.closest(sample.point);
    sum += sample.area * sample.normal.dot(foot.normal);
    area += sample.area;
  }
  return area > 0.0 ? sum / area : 1.0;
}

SideFit fit_sides(const CavitySide& left, const CavitySide& right, const ToolModel& tool, const SideFitOptions& options,
                  const Progress& progress) {
  return journaled(
      progress, "sides", [&] { return search_radii(left, right, tool, options, progress); }, options.fit,
      options.layers, options.starts, tool, options.slender, options.facing);
}

SideFit settle_sides(const CavitySide& left, const CavitySide& right, SideFit sides, const SideFitOptions& options,
                     const Progress& progress) {
  if (sides.settled || sides.fit.motions.empty()) return sides;
  const auto settle = [&] {
    Polished polished;
    polished.draft.motions = sides.fit.motions;
    polished.draft.tool = sides.fit.tool;
    polished.draft.free_tool = true;
    polished.draft.facing = sides.facing;
    polished.estimate = sides.fit.after;
    reattach_targets(polished.draft, left, right);
    const FlankFitOptions fit = possible(options.fit, sides.fit.tool.axis_length());
    SideFit out = sides;
    out.fit = make_result(flank::internal::repair_closely(polished, fit), fit, std::move(out.fit));
    out.settled = true;
    return out;
  };
  return journaled(progress, "settle", settle, options.fit, sides.facing);
}

}  // namespace flank::internal
