#include "flank/pipeline/cavity_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

constexpr double kRadian = 180.0 / std::numbers::pi;

std::string ends_of(const CavityProgram& program) {
  if (program.walled_start)
    return "walls close the cavity at both ends: cycles start and end in front of them, entered from above";
  if (program.walled_end)
    return "a wall closes the cavity at the end: cycles start outside of the blank and end before it";
  return "the cavity is taken as open at both ends: cycles start and end outside of the blank";
}

/// Up to two digits, not below the value.
double rounded_up(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::ceil(value / unit - 1e-9) * unit;
}

std::string stuck_sentence(const TrochoidJob& job, const LayerCycles& cycles) {
  const double most = job.cycles.most_engagement_deg;
  const LeastRejectedStep& refused = cycles.stuck;
  if (cycles.cycles.empty() && refused.largest_rad > 0.0)
    return fmt::format("the first cut cannot stay within {} degrees of engagement: the smallest found is {:.2f}", most,
                       refused.largest_rad * kRadian);
  if (!(refused.largest_rad > 0.0))
    return fmt::format("no step within {} degrees of engagement is free of gouges", most);
  return fmt::format(
      "no step stays within {} degrees of engagement: nearest comes a step of {:.4f} mm with {:.2f} degrees; "
      "--max-engagement {:.0f} gets past this place",
      most, refused.step_mm, refused.largest_rad * kRadian, std::ceil(refused.largest_rad * kRadian + 0.5));
}

/// Some were cancelled while a way past the place where they were stuck was looked for.
bool got_stuck(const LayerCycles& cycles) {
  return cycles.status == CycleStatus::kStuck || (cycles.status == CycleStatus::kCancelled && cycles.ends_stuck);
}

/// Cycles go forward across the axis; where the sides lead along it they hardly do.
std::string along_axis_sentence(const PlannedLayer& layer) {
  return fmt::format(
      "there the sides run only {:.0f} degrees off the tool's axis: a step along them moves the flank sideways by only "
      "{:.0f} % of the step's length",
      layer.off_axis_rad * kRadian, 100.0 * std::sin(layer.off_axis_rad));
}

/// A search for another tool ends there (ends_search).
std::string before_sides_sentence(const PlannedLayer& layer) {
  return fmt::format("all {} cutting moves end before one of the sides begins: they do not get into the cavity",
                     layer.cycles.cycles.size());
}

std::string rest_sentence(const TrochoidJob& job, const PlannedLayer& layer) {
  const double cleared = 100.0 * layer.share, before = layer.cycles.before_wall_mm;
  if (!(before > 0.0))
    return fmt::format("roughed and finished over {:.1f} % of the length of its sides; the rest is not machined",
                       cleared);
  return fmt::format(
      "roughed and finished over {:.1f} % of the length of its sides; the cycles end {:.2f} mm before the place that "
      "the wall allows, because nearer to it a step is too thin to be measured, or exceeds {} degrees of engagement in "
      "the corners",
      cleared, before, job.cycles.most_engagement_deg);
}

std::string no_cycles_clause(const WhyNoCycles& why) {
  if (why.why == NoCycles::kFarOff)
    return "no cycles make up for sides with less than half of the required share, or deeper than four tolerances";
  if (why.why == NoCycles::kNarrow)
    return fmt::format(
        "where the way across is shortest it is {:.2f} diameters of the tool long, and the cycles would crawl",
        why.way_across);
  return fmt::format("the search ended after the sides of {} upper limit{} of the radius, before any cycle", why.tools,
                     why.tools == 1 ? "" : "s");
}

/// Whether a looser request of coverage and tolerance is all that is missing.
bool misses_by_figures(const Result& result, const Acceptance& acceptance) {
  const StockReport* stock = result.verify.stock ? &*result.verify.stock : nullptr;
  std::ptrdiff_t others = 0;
  for (const Shortfall& reason : acceptance.reasons)
    if (!reason.figure.starts_with("coverage") && !reason.figure.starts_with("overcut") &&
        !reason.figure.starts_with("gouge"))
      ++others;
  const bool entered = stock != nullptr && stock->entered_mm > result.verify.tolerance_mm;
  const auto of_stock = std::count_if(acceptance.reasons.begin(), acceptance.reasons.end(),
                                      [](const Shortfall& reason) { return reason.figure == "stock"; });
  return others == 0 || (others == 1 && of_stock == 1 && entered);
}

double deepest_of(const VerifyReport& report) {
  const double depth = std::max(report.overcut_bound_mm, report.gouge_bound_mm);
  return report.stock ? std::max(depth, report.stock->entered_mm) : depth;
}

}  // namespace

void note_what_is_open(const TrochoidJob& job, const CavityProgram& program, std::vector<std::string>& notes) {
  for (std::size_t k = 0; k < program.layers.size(); ++k) {
    const PlannedLayer& layer = program.layers[k];
    const auto add = [&](const std::string& text) { notes.push_back(fmt::format("layer {}: {}", k + 1, text)); };
    if (layer.no_way_in)
      add(fmt::format("no {} between the sides is free of gouges: the layer cannot be entered",
                      job.cycles.entry == "plunge" ? "row of plunges" : "ramp"));
    else if (got_stuck(layer.cycles))
      add(stuck_sentence(job, layer.cycles));
    if (layer.stuck_along_axis()) add(along_axis_sentence(layer));
    if (layer.stuck_before_sides()) add(before_sides_sentence(layer));
    if (layer.share < 1.0) add(rest_sentence(job, layer));
    if (layer.entered_mm() > *job.tolerance_mm)
      add(fmt::format("a move gouges a face by {:.4f} mm, by the planner's samples", layer.entered_mm()));
  }
  if (!program.layers.empty()) notes.push_back(ends_of(program));
}

std::string why_not_done(const TrochoidJob& job, const PlannedLayer& layer, const CoverageEstimate& sides) {
  if (layer.cycles.status == CycleStatus::kDone) return {};
  std::string why;
  if (got_stuck(layer.cycles) && !layer.no_way_in)
    why = stuck_sentence(job, layer.cycles) + "; ";
  else if (layer.cycles.status == CycleStatus::kCancelled)
    why = "the search ended there; ";
  return why + rest_sentence(job, layer) +
         fmt::format("; the passes along the sides finish {:.1f} % of both, by the planner's samples",
                     100.0 * sides.at_tolerance);
}

void note_limit_of_work(Result& result) {
  result.notes.push_back(
      "the search reached its limit of work; this is the best found. `--effort thorough` has no limit");
  auto* cavity = std::get_if<TrochoidSummary>(&result.plan);
  if (cavity == nullptr) return;
  for (LayerSummary& layer : cavity->layers)
    if (layer.status == "cancelled") layer.why += "; the search reached its limit of work";
}

std::string no_cycles_sentence(const TrochoidJob& job, const CoverageEstimate& sides, const WhyNoCycles& why) {
  return fmt::format(
      "the best passes along the sides finish {:.1f} % of both and gouge by {:.4f} mm, by the planner's samples; "
      "required: {:.4g} % of the accessible area, and {:.4g} mm; {}",
      100.0 * sides.at_tolerance, std::max(sides.overcut_mm, sides.gouge_mm), 100.0 * job.judge.least_coverage,
      *job.tolerance_mm, no_cycles_clause(why));
}

void note_own_reach(const TrochoidJob& job, const std::function<double()>& reach, Result& result) {
  const VerifyReport& report = result.verify;
  if (!result.complete || report.coverage_reachable >= job.judge.least_coverage || job.judge.reach_radius_mm) return;
  const double own_reach = reach();
  if (own_reach >= report.reachable_share || own_reach <= 0.0) return;
  result.notes.push_back(
      fmt::format("this tool has radii from {:.4g} to {:.4g} mm: its flank reaches {:.1f} % of the sides without "
                  "gouging other faces, and finishes {:.1f} % of that; a ball of its smallest radius reaches {:.1f} %",
                  result.tool.radial.smallest(), result.tool.radial.largest(), 100.0 * own_reach,
                  100.0 * std::min(1.0, report.coverage / own_reach), 100.0 * report.reachable_share));
}

void note_nearest(Result& result) {
  const VerifyReport& report = result.verify;
  const Acceptance acceptance = result.acceptance();
  if (!result.complete || acceptance.pass() || !misses_by_figures(result, acceptance)) return;
  const bool deep = deepest_of(report) > report.tolerance_mm;
  const double proved =
      deep ? report.coverage_reachable : report.coverage_reachable_bound.value_or(report.coverage_reachable);
  const bool covers_less = std::any_of(acceptance.reasons.begin(), acceptance.reasons.end(),
                                       [](const Shortfall& reason) { return reason.figure.starts_with("coverage"); });
  std::string text = "this result would meet the request with";
  if (covers_less) text += fmt::format(" --coverage {:.2f}", std::floor(100.0 * proved) / 100.0);
  if (deep) text += fmt::format(" --tolerance {:.4g}", rounded_up(deepest_of(report)));
  result.notes.push_back(text);
}

}  // namespace flank::internal
