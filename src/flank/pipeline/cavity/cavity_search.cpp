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
/// Diameters of way across, least_way_across: below, cycles crawl and get stuck, however wide the cavity is elsewhere.
constexpr double kLeastWay = 0.3;

/// Tolerances: deeper sides are hopeless. Of the share that is asked for: so are those that cover less.
constexpr double kHopelesslyDeep = 4.0, kHopelesslyShort = 0.5;

/// What a search is about.
struct Search {
  CavityDemand demand;
  const ToolModel& tool;
  const CavityJudge& judge;
  const Progress& progress;
  const SideFitOptions& options;  ///< but for what a bound of the radius says
  CavitySide left = side_of(demand.faces.sides[0]), right = side_of(demand.faces.sides[1]);
};

/// A bound of the radius. A thinner one may be tried after it: what hardly has a way across, or covers too little, gets no cycles then.
struct Bound {
  double mm = 0.0;
  bool thinner = false;
  int fewest_layers = 1;
};

/// The tip of a cone, where a cylinder that is all but as thick as the bound leaves more than may be left of what the ball reaches that
/// is asked for: in fillets, or where the sides come together.
std::optional<double> tip_under(const Search& search, double bound) {
  const auto& [job, faces] = search.demand;
  const double radius = kBegin * bound, ball = job.judge.reach_radius_mm.value_or(faces.ball_mm);
  const double tip = std::max(kBegin * ball, job.radius.min_mm.value_or(0.0));
  if (tip >= radius) return {};
  const double reached = reachable_share(search.left, search.right, radius),
               asked = reachable_share(search.left, search.right, ball);
  if (reached >= job.judge.least_coverage * asked) return {};
  return tip;
}

SideFitOptions options_under(const Search& search, double bound) {
  const TrochoidJob& job = search.demand.job;
  SideFitOptions here = search.options;
  here.fit.bounds.largest = bound;
  const std::optional<double> tip = search.tool.free() ? tip_under(search, bound) : std::nullopt;
  if (!job.radius.min_mm)
    here.fit.bounds.smallest = std::min(here.fit.bounds.smallest, tip ? kEven * *tip : 0.5 * bound);
  here.starts = starts_under(bound, here.fit.bounds.smallest, tip);
  if (search.tool.free()) return here;
  here.starts.resize(1);
  if (search.tool.radius) here.starts.front().radius_mm = *search.tool.radius;
  return here;
}

double reach_of(const SideFit& sides, const CavityFaces& faces) {
  return reach_of_tool(side_of(faces.sides[0]), side_of(faces.sides[1]), sides.fit.motions, sides.fit.tool);
}

/// Whether sides cover the share that is asked for of what the ball reaches that says what of them counts.
bool covers_asked(const SideFit& sides, const CavityDemand& demand) {
  const auto& [job, faces] = demand;
  return covers_reachable(side_of(faces.sides[0]), side_of(faces.sides[1]), sides.fit.after.at_tolerance,
                          job.judge.least_coverage, asked_ball(job, faces, sides.fit.tool));
}

double deepest_of(const SideFit& sides) { return std::max(sides.fit.after.overcut_mm, sides.fit.after.gouge_mm); }

/// A tool that has hardly any way across: its cycles would crawl.
bool is_narrow(const SideFit& sides) { return least_way_across(sides.fit.motions, sides.fit.tool) < kLeastWay; }

int layers_of(const SideFit& sides) { return static_cast<int>(sides.fit.motions.size()) / 2; }

/// A bound for which the narrowest place has no room: where sides are far from what is asked under it, that is the room's, which more
/// layers do not make.
bool is_wide(double bound, const CavityDemand& demand) {
  return !demand.job.radius.max_mm && bound > kMostOfWidth * demand.faces.width.narrowest_mm * (1.0 + 1e-9);
}

/// All cycles, and none of them enters a face.
bool gets_through(const CavityPlan& plan, const CavityDemand& demand) {
  return plan.program.done() &&
         plan.program.entered_mm() <= kToleranceBudget.cavity.through() * *demand.job.tolerance_mm;
}

/// Of the way of the sides, how much the cycles cleared: mean over the layers.
double cleared(const CavityPlan& plan) {
  double sum = 0.0;
  for (const PlannedLayer& layer : plan.program.layers) sum += layer.share;
  return sum / std::max(1, layers_of(plan.sides));
}

CavityPlan plan_without_cycles(SideFit sides, double bound) { return {std::move(sides), {}, bound, 0, {}}; }

/// Whether sides are better than others, or there are no others: more layers or another lean are worth that.
bool gains(const SideFit& sides, const SideFit& other, const CavityDemand& demand) {
  return other.fit.motions.empty() ||
         rank(plan_without_cycles(sides, 0.0), demand) > rank(plan_without_cycles(other, 0.0), demand);
}

/// Whether sides do what can be asked of them. Where a start is a cone, its tip reaches what a thicker one leaves: that is asked for, too.
bool do_enough(const SideFit& sides, const SideFitOptions& options, const CavityDemand& demand) {
  if (!fills_reach(sides, demand)) return false;
  const bool cone = std::any_of(options.starts.begin(), options.starts.end(),
                                [](const RadiusStart& start) { return start.tip_share < 1.0; });
  return !cone || covers_asked(sides, demand);
}

/// As many layers as the tolerance needs, not those that cannot help; or as many as are asked for. `before`: sides that are there
/// already; more layers than the fewest only for what gains on them.
SideFit search_sides(const Search& search, SideFitOptions options, const Bound& bound, const SideFit& before) {
  const CavityDemand& demand = search.demand;
  const int asked_layers = demand.job.cycles.layers;
  const int last = asked_layers > 0 ? asked_layers : kMostLayers;
  SideFit best;
  options.layers = asked_layers > 0 ? asked_layers : bound.fewest_layers;
  while (true) {
    // More layers make a shorter tool, which is less slender.
    options.slender = options.layers == last;
    SideFit tried = fit_sides(search.left, search.right, search.tool, options, search.progress);
    const bool some = !tried.fit.motions.empty(),
               better = gains(tried, best.fit.motions.empty() ? before : best, demand);
    const double asked = some ? demand.job.judge.least_coverage * reach_of(tried, demand.faces) : 1.0;
    const bool far = is_wide(bound.mm, demand) && some && tried.fit.after.at_four_tolerances < asked;
    // More layers make no way across.
    const bool ends = far || do_enough(tried, options, demand) || (bound.thinner && is_narrow(tried));
    const int next = some ? layers_after(options.layers, tried.fit.after, asked) : options.layers + 1;
    if (better || best.fit.motions.empty()) best = std::move(tried);
    if (ends || !better || options.layers == last || search.progress.stop()) return best;
    options.layers = std::min(last, next);
  }
}

CycleStrategy strategy_of(const std::string& name) {
  return name == "plain" ? CycleStrategy::kPlain : name == "paper" ? CycleStrategy::kAdjusted : CycleStrategy::kVolume;
}

EntryMethod entry_of(const std::string& name) {
  if (name == "open") return EntryMethod::kOpen;
  if (name == "ramp") return EntryMethod::kRamp;
  return name == "plunge" ? EntryMethod::kPlunge : EntryMethod::kAuto;
}

CavityProgram plan(const CavityDemand& demand, const SideFit& sides, const PlanEffort& effort,
                   const Progress& progress) {
  const auto& [job, faces] = demand;
  if (is_hopeless(sides, demand) || !check_legitimacy(sides.fit.tool).legitimate) return {};
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

/// With cycles, and judged if they get through.
CavityPlan planned(SideFit sides, const Search& search, double bound, const PlanEffort& effort = kTry) {
  CavityPlan out = plan_without_cycles(
      settle_sides(search.left, search.right, std::move(sides), options_under(search, bound), search.progress), bound);
  out.program = plan(search.demand, out.sides, effort, search.progress);
  if (search.judge && gets_through(out, search.demand) && !search.progress.stop()) out.finding = search.judge(out);
  return out;
}

/// The same; without cycles where a thinner tool is the better bet.
CavityPlan planned_under(const Bound& bound, SideFit sides, const Search& search) {
  const bool waits = bound.thinner && (is_narrow(sides) || !fills_reach(sides, search.demand));
  return waits ? plan_without_cycles(std::move(sides), bound.mm) : planned(std::move(sides), search, bound.mm);
}

const CavityPlan& best_of(const std::vector<CavityPlan>& plans, const CavityDemand& demand) {
  return *std::max_element(plans.begin(), plans.end(),
                           [&](const CavityPlan& a, const CavityPlan& b) { return rank(a, demand) < rank(b, demand); });
}

/// Adds sides whose axes lean alike, whose cycles are fewer and shorter; where they do not do what is asked, or cycles get stuck
/// between them, sides as they come.
void add_leans(const Search& search, SideFitOptions options, Bound bound, std::vector<CavityPlan>& plans) {
  const CavityDemand& demand = search.demand;
  const CavityPlan& alike = plans.emplace_back(planned_under(bound, search_sides(search, options, bound, {}), search));
  if (search.progress.stop() || (bound.thinner && is_narrow(alike.sides))) return;
  // What all cycles get past, but enters a face, is not the leans', nor is what ends the search, nor the want of room.
  if (alike.program.done() && fills_reach(alike.sides, demand)) return;
  if (ends_search(alike.program, bound.thinner)) return;
  if (bound.thinner && is_wide(bound.mm, demand) && alike.program.layers.empty()) return;
  // Fewer layers than the tool of these has are too few for it either way: they were too slender, or covered less. So is another start.
  const SideFit before = alike.sides;
  const bool through = gets_through(alike, demand);
  bound.fewest_layers = std::max(bound.fewest_layers, layers_of(before));
  if (layers_of(before) > 0) options.starts = {before.start};
  options.facing = false;
  SideFit sides = search_sides(search, options, bound, before);
  // Cycles cannot make up for sides that cover no more.
  if (!through || gains(sides, before, demand)) plans.push_back(planned_under(bound, std::move(sides), search));
}

/// All that is tried under a bound of the radius: at last a tool that is nearly as thick everywhere, if that is what is missing.
std::vector<CavityPlan> plans_under(const Search& search, Bound bound) {
  std::vector<CavityPlan> plans;
  SideFitOptions options = options_under(search, bound.mm);
  add_leans(search, options, bound, plans);
  const CavityPlan& best = best_of(plans, search.demand);
  if (!search.tool.free() || !wants_even_tool(best, search.demand) || search.progress.stop()) return plans;
  options.starts = {{options.starts.front().radius_mm, kEven}};
  add_leans(search, options, {bound.mm, true, layers_of(best.sides)}, plans);
  return plans;
}

}  // namespace

std::vector<RadiusStart> starts_under(double bound_mm, double least_mm, const std::optional<double>& tip_mm) {
  const double radius = std::max(kBegin * bound_mm, least_mm);
  std::vector<RadiusStart> starts;
  if (tip_mm) starts.push_back({radius, kEven * *tip_mm / radius, 2.0, *tip_mm / radius});
  starts.insert(starts.end(), {{radius, kStout}, {radius, kThin}});
  if (kSlim * bound_mm > least_mm) starts.push_back({kSlim * bound_mm, kThin, kCoversLittle});
  return starts;
}

int layers_after(int layers, const CoverageEstimate& found, double asked) {
  constexpr double kUnsure = 0.7;  // of a layer: one that is hardly asked for is not counted on
  constexpr double kMost = 2.0;    // doublings: what asks for more is far off, and not for want of layers
  const double gained = found.at_four_tolerances - found.at_tolerance, missing = asked - found.at_tolerance;
  if (missing > kMost * gained || !(gained > 0.0)) return layers + 1;
  const double wanted = layers * std::exp2(std::max(0.0, missing) / gained);
  return std::max(layers + 1, static_cast<int>(wanted + 1.0 - kUnsure));
}

bool fills_reach(const SideFit& sides, const CavityDemand& demand) {
  const auto& [job, faces] = demand;
  if (sides.fit.motions.empty() || deepest_of(sides) > *job.tolerance_mm) return false;
  return covers_asked(sides, demand) ||
         sides.fit.after.at_tolerance >= job.judge.least_coverage * reach_of(sides, faces);
}

bool is_hopeless(const SideFit& sides, const CavityDemand& demand) {
  const auto& [job, faces] = demand;
  if (sides.fit.motions.empty() || deepest_of(sides) > kHopelesslyDeep * *job.tolerance_mm) return true;
  const double some = kHopelesslyShort * job.judge.least_coverage, covered = sides.fit.after.at_tolerance;
  return covered < some && covered < some * reach_of(sides, faces);
}

bool meets(const CavityPlan& plan, const CavityDemand& demand) {
  const auto& [job, faces] = demand;
  if (plan.finding) return plan.finding->meets;
  if (!gets_through(plan, demand) || !fills_reach(plan.sides, demand)) return false;
  const FlankFitResult& fit = plan.sides.fit;
  const CavitySide left = side_of(faces.sides[0]), right = side_of(faces.sides[1]);
  const double radius = asked_ball(job, faces, fit.tool);
  const double in_reach = covered_in_reach(left, right, fit.motions, fit.tool, *job.tolerance_mm, radius);
  return covers_reachable(left, right, in_reach * cleared(plan) * fit.after.at_tolerance, job.judge.least_coverage,
                          radius);
}

CavityRank rank(const CavityPlan& plan, const CavityDemand& demand) {
  constexpr double kThousandths = 1e3, kDepthStep = 0.2, kScoreStep = 0.002;
  const double tolerance = *demand.job.tolerance_mm;
  const double covered = plan.finding ? plan.finding->covered : cleared(plan) * plan.sides.fit.after.at_tolerance;
  // What the tolerance allows is no depth.
  const double depth = std::max(plan.program.entered_mm(), deepest_of(plan.sides)) / tolerance;
  const int steps = static_cast<int>(std::ceil(std::log(std::clamp(depth, 1.0, 1e9)) / std::log1p(kDepthStep)));
  return {plan.finding && plan.finding->meets,
          !plan.sides.fit.motions.empty(),
          gets_through(plan, demand),
          plan.program.done(),
          static_cast<int>(std::lround(kThousandths * covered)),
          -steps,
          fills_reach(plan.sides, demand),
          static_cast<int>(std::lround(std::max(-1e6, plan.sides.fit.after.score(tolerance)) / kScoreStep))};
}

bool ends_search(const CavityProgram& program, bool thinner) {
  return program.stuck_along_axis() || (thinner && program.stuck_before_sides());
}

bool wants_even_tool(const CavityPlan& plan, const CavityDemand& demand) {
  return !demand.job.judge.reach_radius_mm && gets_through(plan, demand) && !meets(plan, demand) &&
         fills_reach(plan.sides, demand);
}

WhyNoCycles why_no_cycles(const CavityPlan& plan, const CavityDemand& demand) {
  const FlankFitResult& fit = plan.sides.fit;
  if (is_hopeless(plan.sides, demand)) return {NoCycles::kFarOff, 0.0, plan.tools};
  const double way = least_way_across(fit.motions, fit.tool);
  return {way < kLeastWay ? NoCycles::kNarrow : NoCycles::kEnded, way, plan.tools};
}

bool is_in_vain(int in_a_row, bool through) { return in_a_row >= (through ? 1 : 2); }

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

CavityPlan search_cavity(const TrochoidJob& job, const CavityFaces& faces, const ToolModel& tool,
                         const SideFitOptions& options, const CavityJudge& judge, const Progress& progress) {
  const Search search{{job, faces}, tool, judge, progress, options};
  const CavityDemand& demand = search.demand;
  CavityPlan best, uncut;  // the latter: of those that got no cycles the one that covers most
  const bool given = !tool.free() && tool.radius;
  const auto covered = [](const CavityPlan& plan) { return plan.sides.fit.after.at_tolerance; };
  const std::vector<double> bounds = bounds_of(job, faces.width);
  bool ends = false;
  int tools = 0, fewest = 1, in_vain = 0;
  for (const double bound : bounds) {
    const bool thinner = !given && bound != bounds.back();
    const double most_uncut = covered(uncut);
    std::vector<CavityPlan> plans = plans_under(search, {bound, thinner, fewest});
    for (const CavityPlan& plan : plans)
      if (plan.program.layers.empty() && covered(plan) > covered(uncut) && !is_narrow(plan.sides) &&
          check_legitimacy(plan.sides.fit.tool).legitimate)
        uncut = plan;
    CavityPlan tried = best_of(plans, demand);
    // A tool that has hardly any way across got no cycles, and says nothing of thinner ones.
    const bool narrow = tried.program.layers.empty() && is_narrow(tried.sides);
    // How many layers sides need is theirs. Where they fell short, that may have been the thick tool's.
    if (!narrow) fewest = std::max(fewest, layers_of(tried.sides) - (fills_reach(tried.sides, demand) ? 0 : 1));
    const bool better = ++tools == 1 || rank(tried, demand) > rank(best, demand), done = meets(tried, demand);
    if (better || done) best = std::move(tried);
    if (!narrow) in_vain = better || covered(uncut) > most_uncut ? 0 : in_vain + 1;
    ends = ends_search(best.program, thinner);
    if (done || given || is_in_vain(in_vain, best.program.done()) || ends || progress.stop()) break;
  }
  const auto replace = [&](CavityPlan plan) {
    if (rank(plan, demand) > rank(best, demand)) best = std::move(plan);
  };
  // Sides that cover a hair without a cut say less than those that cover most.
  if (best.program.layers.empty() && covered(uncut) > covered(best)) best = uncut;
  // Where no tool does it, the sides without cycles may be those that leave least.
  if (!meets(best, demand) && covered(uncut) > cleared(best) * covered(best) && !progress.stop())
    replace(planned(uncut.sides, search, uncut.largest_radius_mm));
  // The long search for a way past a place where cycles get stuck comes last: another tool may have no such place. So do the layers
  // below it.
  const bool some = !best.program.layers.empty();
  const bool cut_short = some && static_cast<int>(best.program.layers.size()) < layers_of(best.sides);
  if (some && !best.program.done() && (!ends || cut_short) && !progress.stop())
    replace(planned(best.sides, search, best.largest_radius_mm, ends ? kWrite : kUtmost));
  best.tools = tools;
  return best;
}

}  // namespace flank::internal
