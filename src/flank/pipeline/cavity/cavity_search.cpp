#include "flank/pipeline/cavity/cavity_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/base/tolerance_budget.h"
#include "flank/tool.h"
#include "flank/trochoid/plan_program.h"
#include "flank/trochoid/sides/side_room.h"

namespace flank::internal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
/// Where a search begins below its bound, and the least radius there may be as a share of that: the engagement of a thin
/// end bounds the steps of the whole tool, so a stout one comes first.
constexpr double kBegin = 0.92, kStout = 0.55, kThin = 0.3;
/// The same of a tool that is nearly as thick everywhere.
constexpr double kEven = 0.85;
/// The same of a slimmer start, where the others cover less than this share of what they reach.
constexpr double kSlim = 0.7, kCoversLittle = 0.85;
constexpr int kMostLayers = 5;
/// How hard a way past a place is looked for where no cycle gets on.
struct PlanEffort {
  int most_rewinds = 3;      ///< CycleOptions::most_rewinds
  bool below_stuck = false;  ///< ProgramOptions::below_stuck
};
/// Of a plan that is compared with others; of what is written in the end, where the search is not over for another reason.
constexpr PlanEffort kTry = {}, kWrite = {3, true}, kUtmost = {6, true};
/// Depths in faces that differ by less than this share are alike.
constexpr double kSameDepth = 0.2;
/// Where no cycles get through, the search ends after so many tools in a row that do not get farther: one may be unlucky.
constexpr int kInVain = 2;
/// Diameters of way across, least_way_across: below, cycles crawl and get stuck, however wide the cavity is elsewhere.
constexpr double kLeastWay = 0.3;

/// What a search is about.
struct Search {
  const TrochoidJob& job;
  const CavityFaces& faces;
  const ToolModel& tool;
  const CavityJudge& judge;
  const Progress& progress;
  const SideFitOptions& options;  ///< but for what a bound of the radius says
};

/// Under a bound of the radius.
SideFitOptions options_under(const Search& search, double bound) {
  SideFitOptions here = search.options;
  here.fit.bounds.largest = bound;
  if (!search.job.radius.min_mm) here.fit.bounds.smallest = std::min(here.fit.bounds.smallest, 0.5 * bound);
  here.starts = starts_under(bound, here.fit.bounds.smallest);
  if (search.tool.free()) return here;
  here.starts.resize(1);
  if (search.tool.radius) here.starts.front().radius_mm = *search.tool.radius;
  return here;
}

double reach_of(const SideFit& sides, const CavityFaces& faces) {
  return reach_of_tool(side_of(faces.sides[0]), side_of(faces.sides[1]), sides.fit.motions, sides.fit.tool);
}

/// How far sides are from what is asked.
enum class SideState {
  kShort,       ///< another fit may cover more
  kObstructed,  ///< all but what other faces keep from a tool of these radii: no fit mends that
  kDone,
};

SideState state_of(const SideFit& sides, const CavityFaces& faces, const TrochoidJob& job) {
  const CoverageEstimate& e = sides.fit.after;
  if (sides.fit.motions.empty()) return SideState::kShort;
  if (e.overcut_mm > *job.tolerance_mm || e.gouge_mm > *job.tolerance_mm) return SideState::kShort;
  const double radius = asked_ball(job, faces, sides.fit.tool);
  const double least = job.judge.least_coverage;
  if (covers_reachable(side_of(faces.sides[0]), side_of(faces.sides[1]), e.at_tolerance, least, radius))
    return SideState::kDone;
  return e.at_tolerance >= least * reach_of(sides, faces) ? SideState::kObstructed : SideState::kShort;
}

/// A tool that has hardly any way across: its cycles would crawl.
bool is_narrow(const SideFit& sides) { return least_way_across(sides.fit.motions, sides.fit.tool) < kLeastWay; }

int layers_of(const SideFit& sides) { return static_cast<int>(sides.fit.motions.size()) / 2; }

double score_of(const SideFit& sides, const TrochoidJob& job) { return sides.fit.after.score(*job.tolerance_mm); }

/// A bound for which the narrowest place has no room: where sides are far from what is asked under it, that is the room's, which more
/// layers do not make.
bool is_wide(double bound, const CavityFaces& faces, const TrochoidJob& job) {
  return !job.radius.max_mm && bound > kMostOfWidth * faces.width.narrowest_mm * (1.0 + 1e-9);
}

/// From how many layers on sides are looked for, and what is there already.
struct Known {
  int fewest = 1;
  const SideFit* sides = nullptr;  ///< more layers than the fewest only if these gain on it
};

/// As many layers as the tolerance needs, not those that cannot help; or as many as are asked for. If a thinner tool may be tried, no
/// more layers for one that has hardly any way across: they make none.
SideFit search_sides(const Search& search, SideFitOptions options, const Known& known, bool thinner) {
  const TrochoidJob& job = search.job;
  const CavityFaces& faces = search.faces;
  const CavitySide left = side_of(faces.sides[0]), right = side_of(faces.sides[1]);
  SideFit best;
  const int first = job.cycles.layers > 0 ? job.cycles.layers : known.fewest;
  const int last = job.cycles.layers > 0 ? first : kMostLayers;
  const bool wide = is_wide(options.fit.bounds.largest, faces, job);
  for (int layers = first; layers <= last;) {
    options.layers = layers;
    // More layers make a shorter tool, which is less slender.
    options.slender = layers == last;
    SideFit tried = fit_sides(left, right, search.tool, options, search.progress);
    const SideFit* before = best.fit.motions.empty() ? known.sides : &best;
    const SideState state = state_of(tried, faces, job);
    const bool better = before == nullptr || is_gain(tried, *before, faces, job);
    const bool some = !tried.fit.motions.empty();
    const double asked = some ? job.judge.least_coverage * reach_of(tried, faces) : 1.0;
    const bool far = wide && some && tried.fit.after.at_four_tolerances < asked;
    const bool ends = far || state != SideState::kShort || (thinner && is_narrow(tried));
    const int next = some ? layers_after(layers, tried.fit.after, asked) : layers + 1;
    if (better || best.fit.motions.empty()) best = std::move(tried);
    if (ends || !better || layers == last || search.progress.stop()) break;
    layers = std::min(last, next);
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

CavityProgram plan(const TrochoidJob& job, const CavityFaces& faces, const SideFit& sides, const PlanEffort& effort,
                   const Progress& progress) {
  if (sides.fit.motions.empty() || !check_legitimacy(sides.fit.tool).legitimate) return {};
  ProgramOptions options;
  options.cycles.largest_rad = job.cycles.most_engagement_deg * kDegree;
  options.cycles.tolerance_mm = *job.tolerance_mm;
  options.cycles.most_rewinds = effort.most_rewinds;
  options.below_stuck = effort.below_stuck;
  options.cycles.strategy = strategy_of(job.cycles.strategy);
  options.entry.method = entry_of(job.cycles.entry);
  options.entry.slope_rad = job.cycles.ramp_angle_deg * kDegree;
  options.climb = job.cycles.cut == "climb";
  options.chord_mm = kToleranceBudget.chord * *job.tolerance_mm;
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
  double sum = 0.0;
  for (const PlannedLayer& layer : plan.program.layers) sum += layer.share;
  return sum / static_cast<double>(std::max<std::size_t>(2, plan.sides.fit.motions.size()) / 2);
}

CavityPlan uncut_plan(SideFit sides, double bound) {
  CavityPlan out;
  out.sides = std::move(sides);
  out.largest_radius_mm = bound;
  return out;
}

CavityPlan planned(SideFit sides, const Search& search, double bound, const PlanEffort& effort = kTry) {
  const CavitySide left = side_of(search.faces.sides[0]), right = side_of(search.faces.sides[1]);
  sides = settle_sides(left, right, std::move(sides), options_under(search, bound), search.progress);
  CavityProgram program = plan(search.job, search.faces, sides, effort, search.progress);
  CavityPlan out = uncut_plan(std::move(sides), bound);
  out.program = std::move(program);
  if (search.judge && gets_through(out, *search.job.tolerance_mm) && !search.progress.stop())
    out.finding = search.judge(out);
  return out;
}

/// Of one bound of radii: sides whose axes lean alike, whose cycles are fewer and shorter; where they do not do what is asked,
/// or cycles get stuck between them, sides as they come. If a thinner tool may be tried, no cycles for one that has hardly any
/// way across, nor between sides that cover too little, whatever cycles there are: such sides take the place of `uncut` if they
/// cover more.
CavityPlan search_ways(const Search& search, SideFitOptions options, int fewest, bool thinner, CavityPlan& uncut) {
  const TrochoidJob& job = search.job;
  const CavityFaces& faces = search.faces;
  const double bound = options.fit.bounds.largest;
  SideFit alike = search_sides(search, options, {fewest}, thinner);
  if (thinner && is_narrow(alike)) return uncut_plan(std::move(alike), bound);
  const auto plan_of = [&](SideFit fit) {
    if (!thinner || state_of(fit, faces, job) != SideState::kShort) return planned(std::move(fit), search, bound);
    const CavityPlan plan = uncut_plan(std::move(fit), bound);
    if (plan.sides.fit.after.at_tolerance > uncut.sides.fit.after.at_tolerance) uncut = plan;
    return plan;
  };
  CavityPlan facing = plan_of(std::move(alike));
  if (is_done(facing, faces, job) || search.progress.stop()) return facing;
  // What all cycles get past, but enters a face, is not the leans'.
  if (facing.program.done() && state_of(facing.sides, faces, job) != SideState::kShort) return facing;
  if (ends_search(facing.program, thinner)) return facing;
  if (thinner && is_wide(bound, faces, job) && facing.program.layers.empty()) return facing;
  // Fewer layers than the tool of these has are too few for it either way: they were too slender, or covered less. So is another start.
  const int layers = std::max(fewest, layers_of(facing.sides));
  if (layers_of(facing.sides) > 0) options.starts = {facing.sides.start};
  options.facing = false;
  SideFit as_they_come = search_sides(search, options, {layers, &facing.sides}, thinner);
  // Cycles cannot make up for sides that cover no more, where the others' get through all of the way.
  const double tolerance = *job.tolerance_mm;
  if (gets_through(facing, tolerance) && cleared(facing) == 1.0 &&
      as_they_come.fit.after.score(tolerance) <= facing.sides.fit.after.score(tolerance))
    return facing;
  CavityPlan plain = plan_of(std::move(as_they_come));
  return is_better(plain, facing, *job.tolerance_mm) ? plain : facing;
}

/// The same with a tool that is nearly as thick everywhere, if that is what is missing and it does more.
CavityPlan search_even(const Search& search, SideFitOptions options, CavityPlan tried, CavityPlan& uncut) {
  const TrochoidJob& job = search.job;
  const CavityFaces& faces = search.faces;
  if (!search.tool.free() || !wants_even_tool(tried, faces, job) || search.progress.stop()) return tried;
  options.starts = {{options.starts.front().radius_mm, kEven}};
  CavityPlan even = search_ways(search, options, layers_of(tried.sides), true, uncut);
  return is_done(even, faces, job) || is_better(even, tried, *job.tolerance_mm) ? even : tried;
}

/// Cycles between sides that got none, if more may be finished so than by the best.
void try_uncut(const Search& search, CavityPlan uncut, CavityPlan& best) {
  const double finished = cleared(best) * best.sides.fit.after.at_tolerance;
  if (!(uncut.sides.fit.after.at_tolerance > finished) || search.progress.stop()) return;
  CavityPlan tried = planned(std::move(uncut.sides), search, uncut.largest_radius_mm);
  tried.tools = best.tools;
  if (is_better(tried, best, *search.job.tolerance_mm)) best = std::move(tried);
}

}  // namespace

std::vector<RadiusStart> starts_under(double bound_mm, double least_mm) {
  const double radius = std::max(kBegin * bound_mm, least_mm);
  std::vector<RadiusStart> starts = {{radius, kStout}, {radius, kThin}};
  if (kSlim * bound_mm > least_mm) starts.push_back({kSlim * bound_mm, kThin, kCoversLittle});
  return starts;
}

bool is_gain(const SideFit& sides, const SideFit& other, const CavityFaces& faces, const TrochoidJob& job) {
  constexpr double kGain = 0.002;
  if (other.fit.motions.empty() || score_of(sides, job) > score_of(other, job) + kGain) return true;
  return state_of(sides, faces, job) != SideState::kShort && state_of(other, faces, job) == SideState::kShort;
}

int layers_after(int layers, const CoverageEstimate& found, double asked) {
  constexpr double kUnsure = 0.7;  // of a layer: one that is hardly asked for is not counted on
  constexpr double kMost = 2.0;    // doublings: what asks for more is far off, and not for want of layers
  const double gained = found.at_four_tolerances - found.at_tolerance, missing = asked - found.at_tolerance;
  if (missing > kMost * gained || !(gained > 0.0)) return layers + 1;
  const double wanted = layers * std::exp2(std::max(0.0, missing) / gained);
  return std::max(layers + 1, static_cast<int>(wanted + 1.0 - kUnsure));
}

bool is_better(const CavityPlan& a, const CavityPlan& b, double tolerance) {
  if (a.finding && b.finding) {
    if (a.finding->meets != b.finding->meets) return a.finding->meets;
    if (a.finding->covered != b.finding->covered) return a.finding->covered > b.finding->covered;
  }
  if (a.sides.fit.motions.empty() != b.sides.fit.motions.empty()) return b.sides.fit.motions.empty();
  if (gets_through(a, tolerance) != gets_through(b, tolerance)) return gets_through(a, tolerance);
  if (a.program.done() != b.program.done()) return a.program.done();
  const double finished_a = cleared(a) * a.sides.fit.after.at_tolerance;
  const double finished_b = cleared(b) * b.sides.fit.after.at_tolerance;
  if ((!a.program.done() || cleared(a) != cleared(b)) && finished_a != finished_b) return finished_a > finished_b;
  const double deep_a = a.program.entered_mm(), deep_b = b.program.entered_mm();
  // What has no cycles enters nothing, and gets no farther for that.
  const bool both_cut = !a.program.layers.empty() && !b.program.layers.empty();
  if (both_cut && !gets_through(a, tolerance) && std::abs(deep_a - deep_b) > kSameDepth * std::max(deep_a, deep_b))
    return deep_a < deep_b;
  return a.sides.fit.after.score(tolerance) > b.sides.fit.after.score(tolerance);
}

bool is_done(const CavityPlan& plan, const CavityFaces& faces, const TrochoidJob& job) {
  if (plan.finding) return plan.finding->meets;
  if (!gets_through(plan, *job.tolerance_mm) || state_of(plan.sides, faces, job) == SideState::kShort) return false;
  const FlankFitResult& fit = plan.sides.fit;
  const CavitySide left = side_of(faces.sides[0]), right = side_of(faces.sides[1]);
  const double radius = asked_ball(job, faces, fit.tool);
  const double in_reach = covered_in_reach(left, right, fit.motions, fit.tool, *job.tolerance_mm, radius);
  return covers_reachable(left, right, in_reach * cleared(plan) * fit.after.at_tolerance, job.judge.least_coverage,
                          radius);
}

bool ends_search(const CavityProgram& program, bool thinner) {
  return program.stuck_along_axis() || (thinner && program.stuck_before_sides());
}

bool wants_even_tool(const CavityPlan& plan, const CavityFaces& faces, const TrochoidJob& job) {
  return !job.judge.reach_radius_mm && gets_through(plan, *job.tolerance_mm) && !is_done(plan, faces, job) &&
         state_of(plan.sides, faces, job) != SideState::kShort;
}

std::vector<double> bounds_of(const TrochoidJob& job, const CavityWidth& width) {
  constexpr double kMuchWider = 1.6, kAboveLeast = 1.1;
  const double narrow = job.radius.max_mm.value_or(kMostOfWidth * width.narrowest_mm);
  const double wide = job.radius.max_mm ? 0.0 : kMostOfWidth * width.median_mm;
  std::vector<double> bounds;
  if (wide > kMuchWider * narrow) bounds = {wide, std::sqrt(wide * narrow)};
  for (const double share : {1.0, 0.75, 0.55, 0.4}) bounds.push_back(share * narrow);
  const double least = job.radius.min_mm.value_or(0.0);
  std::erase_if(bounds, [&](double bound) { return bound <= least; });
  // Who asks for a thick tool gets it where it has room.
  if (bounds.empty()) bounds.push_back(kAboveLeast * least);
  return bounds;
}

bool SearchPatience::ends_after(bool gained, bool through) {
  in_vain_ = gained ? 0 : in_vain_ + 1;
  return in_vain_ >= (through ? 1 : kInVain);
}

CavityPlan search_cavity(const TrochoidJob& job, const CavityFaces& faces, const ToolModel& tool,
                         const SideFitOptions& options, const CavityJudge& judge, const Progress& progress) {
  const Search search{job, faces, tool, judge, progress, options};
  CavityPlan best, uncut;
  const bool given = !tool.free() && tool.radius;
  bool ends = false;
  int tools = 0, fewest = 1;
  SearchPatience patience;
  const std::vector<double> bounds = bounds_of(job, faces.width);
  for (const double bound : bounds) {
    const SideFitOptions here = options_under(search, bound);
    const double most_uncut = uncut.sides.fit.after.at_tolerance;
    const bool thinner = !given && bound != bounds.back();
    CavityPlan tried = search_ways(search, here, fewest, thinner, uncut);
    tried = search_even(search, here, std::move(tried), uncut);
    const bool done = is_done(tried, faces, job);
    // A tool that has hardly any way across got no cycles, and says nothing of thinner ones.
    const bool narrow = tried.program.layers.empty() && is_narrow(tried.sides);
    // How many layers sides need is theirs. Where they fell short, that may have been the thick tool's.
    if (!narrow && !tried.sides.fit.motions.empty())
      fewest =
          std::max(fewest, layers_of(tried.sides) - (state_of(tried.sides, faces, job) == SideState::kShort ? 1 : 0));
    const bool covers_more = uncut.sides.fit.after.at_tolerance > most_uncut;
    const bool better = ++tools == 1 || is_better(tried, best, *job.tolerance_mm);
    if (better || done) best = std::move(tried);
    best.tools = tools;
    const bool in_vain = !narrow && patience.ends_after(better || covers_more, best.program.done());
    ends = ends_search(best.program, thinner);
    if (done || given || in_vain || ends || progress.stop()) break;
  }
  // Where no tool does it, the sides without cycles may be those that leave least.
  if (!is_done(best, faces, job)) try_uncut(search, std::move(uncut), best);
  // The long search for a way past a place where cycles get stuck comes last: another tool may have no such place. So do the layers
  // below it.
  const bool cut_short =
      static_cast<int>(best.program.layers.size()) < layers_of(best.sides) && !best.program.layers.empty();
  if (!best.program.done() && (!ends || cut_short) && !best.sides.fit.motions.empty() && !progress.stop()) {
    CavityPlan tried = planned(best.sides, search, best.largest_radius_mm, ends ? kWrite : kUtmost);
    if (is_better(tried, best, *job.tolerance_mm)) best.program = std::move(tried.program), best.finding = tried.finding;
  }
  return best;
}

}  // namespace flank::internal
