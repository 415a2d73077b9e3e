#include "flank/pipeline/search/cavity_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/base/tolerance_budget.h"
#include "flank/tool.h"

namespace flank::internal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
/// Where a search begins below its bound, and the least radius there may be as a share of that: the engagement of a thin
/// end bounds the steps of the whole tool, so a stout one comes first.
constexpr double kBegin = 0.92, kStout = 0.55, kThin = 0.3;
constexpr int kMostLayers = 5;
/// How often cycles are taken back where none gets on (CycleOptions::most_rewinds).
constexpr int kFewRewinds = 3, kMostRewinds = 6;

bool sides_are_done(const SideFit& sides, const CavityFaces& faces, const TrochoidJob& job) {
  const CoverageEstimate& e = sides.fit.after;
  if (sides.fit.motions.empty()) return false;
  const double radius = job.judge.reach_radius_mm.value_or(sides.fit.tool.smallest());
  const double reachable = reachable_share(side_of(faces.sides[0]), side_of(faces.sides[1]), radius);
  return sides.fit.status == FitStatus::kWithinTolerance ||
         (e.at_tolerance >= job.judge.least_coverage * reachable && e.overcut_mm <= job.tolerance_mm &&
          e.gouge_mm <= job.tolerance_mm);
}

/// As many layers as the tolerance needs, or as many as are asked for.
SideFit search_sides(const TrochoidJob& job, const CavityFaces& faces, const ToolModel& tool, SideFitOptions options,
                     const Progress& progress) {
  const CavitySide left = side_of(faces.sides[0]), right = side_of(faces.sides[1]);
  SideFit best;
  const int first = job.cycles.layers > 0 ? job.cycles.layers : 1, last = job.cycles.layers > 0 ? first : kMostLayers;
  for (int layers = first; layers <= last; ++layers) {
    options.layers = layers;
    SideFit tried = fit_sides(left, right, tool, options, progress);
    const bool better = best.fit.motions.empty() ||
                        tried.fit.after.score(job.tolerance_mm) > best.fit.after.score(job.tolerance_mm) + 0.002;
    const bool done = sides_are_done(tried, faces, job);
    if (better) best = std::move(tried);
    if (done || !better || progress.stop()) break;
  }
  return best;
}

CycleStrategy strategy_of(const std::string& name) {
  return name == "plain" ? CycleStrategy::kPlain : name == "paper" ? CycleStrategy::kAdjusted : CycleStrategy::kVolume;
}

EntryMethod entry_of(const std::string& name) {
  if (name == "open") return EntryMethod::kOpen;
  if (name == "ramp") return EntryMethod::kRamp;
  return name == "plunge" ? EntryMethod::kPlunge : EntryMethod::kAuto;
}

CavityProgram plan(const TrochoidJob& job, const CavityFaces& faces, const SideFit& sides, int most_rewinds,
                   const Progress& progress) {
  if (sides.fit.motions.empty() || !check_legitimacy(sides.fit.tool).legitimate) return {};
  ProgramOptions options;
  options.cycles.largest_rad = job.cycles.most_engagement_deg * kDegree;
  options.cycles.tolerance_mm = job.tolerance_mm;
  options.cycles.most_rewinds = most_rewinds;
  options.cycles.strategy = strategy_of(job.cycles.strategy);
  options.entry.method = entry_of(job.cycles.entry);
  options.entry.slope_rad = job.cycles.ramp_angle_deg * kDegree;
  options.climb = job.cycles.cut == "climb";
  options.chord_mm = kToleranceBudget.chord * job.tolerance_mm;
  options.left = faces.sides[0].faces;
  options.right = faces.sides[1].faces;
  GuardedFaces guarded;
  for (const TargetGroup& side : faces.sides) {
    guarded.sides.push_back(side.target.get());
    guarded.others.push_back(side.obstacles.get());
  }
  return plan_program(sides.fit.motions, sides.fit.tool, *faces.sides[0].target, *faces.sides[1].target, guarded,
                      options, progress);
}

/// All cycles, and none of them enters a face.
bool gets_through(const CavityPlan& plan, double tolerance) {
  return plan.program.done() && plan.program.entered_mm() <= kToleranceBudget.cavity.through() * tolerance;
}

/// Of the way of the sides, how much the cycles cleared: mean over the layers.
double cleared(const CavityPlan& plan) {
  if (plan.program.done()) return 1.0;
  double sum = 0.0;
  for (const PlannedLayer& layer : plan.program.layers) sum += layer.share;
  return sum / static_cast<double>(std::max<std::size_t>(2, plan.sides.fit.motions.size()) / 2);
}

/// What is better comes first: cycles that get through, then what they let the sides cover, then sides.
bool is_better(const CavityPlan& a, const CavityPlan& b, double tolerance) {
  if (a.sides.fit.motions.empty() != b.sides.fit.motions.empty()) return b.sides.fit.motions.empty();
  if (gets_through(a, tolerance) != gets_through(b, tolerance)) return gets_through(a, tolerance);
  if (a.program.done() != b.program.done()) return a.program.done();
  const double finished_a = cleared(a) * a.sides.fit.after.at_tolerance;
  const double finished_b = cleared(b) * b.sides.fit.after.at_tolerance;
  if (!a.program.done() && finished_a != finished_b) return finished_a > finished_b;
  return a.sides.fit.after.score(tolerance) > b.sides.fit.after.score(tolerance);
}

bool is_done(const CavityPlan& plan, const CavityFaces& faces, const TrochoidJob& job) {
  return sides_are_done(plan.sides, faces, job) && gets_through(plan, job.tolerance_mm);
}

/// Of one bound of radii: sides whose axes lean alike, whose cycles are fewer and shorter, else sides as they come. The long
/// search for a way past a place where cycles get stuck comes last: the other sides may have no such place.
CavityPlan search_ways(const TrochoidJob& job, const CavityFaces& faces, const ToolModel& tool, SideFitOptions options,
                       const Progress& progress) {
  const auto sides = [&](bool facing) {
    options.facing = facing;
    return search_sides(job, faces, tool, options, progress);
  };
  const auto planned = [&](SideFit of, int most_rewinds) {
    CavityPlan out;
    out.program = plan(job, faces, of, most_rewinds, progress);
    out.sides = std::move(of);
    out.largest_radius_mm = options.fit.bounds.largest;
    return out;
  };
  CavityPlan facing = planned(sides(true), kFewRewinds);
  if (is_done(facing, faces, job) || progress.stop()) return facing;
  CavityPlan plain = planned(sides(false), kMostRewinds);
  const bool stuck = !facing.program.done() && sides_are_done(facing.sides, faces, job);
  if (stuck && !is_done(plain, faces, job) && !progress.stop()) facing = planned(std::move(facing.sides), kMostRewinds);
  return is_better(plain, facing, job.tolerance_mm) ? plain : facing;
}

}  // namespace

std::vector<double> bounds_of(const TrochoidJob& job, const CavityWidth& width) {
  constexpr double kMuchWider = 1.6;
  const double narrow = job.radius.max_mm.value_or(kMostOfWidth * width.narrowest_mm);
  const double wide = job.radius.max_mm ? 0.0 : kMostOfWidth * width.median_mm;
  std::vector<double> bounds;
  if (wide > kMuchWider * narrow) bounds = {wide, std::sqrt(wide * narrow)};
  for (const double share : {1.0, 0.75, 0.55, 0.4}) bounds.push_back(share * narrow);
  return bounds;
}

CavityPlan search_cavity(const TrochoidJob& job, const CavityFaces& faces, const ToolModel& tool,
                         const SideFitOptions& options, const Progress& progress) {
  CavityPlan best;
  const bool given = !tool.free() && tool.radius;
  int tools = 0;
  for (const double bound : bounds_of(job, faces.width)) {
    SideFitOptions here = options;
    here.fit.bounds.largest = bound;
    here.fit.bounds.smallest = std::min(here.fit.bounds.smallest, 0.5 * here.fit.bounds.largest);
    const double radius = given ? *tool.radius : kBegin * here.fit.bounds.largest;
    here.starts = {{radius, kStout}};
    if (tool.free()) here.starts.push_back({radius, kThin});
    CavityPlan tried = search_ways(job, faces, tool, here, progress);
    const bool done = is_done(tried, faces, job);
    const bool better = ++tools == 1 || is_better(tried, best, job.tolerance_mm);
    if (better) best = std::move(tried);
    best.tools = tools;
    // Thinner ones are slower, too: the search ends where they stop to gain.
    if (done || given || !better || progress.stop()) break;
  }
  return best;
}

}  // namespace flank::internal
