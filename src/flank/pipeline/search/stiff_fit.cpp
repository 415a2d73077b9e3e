#include "flank/pipeline/search/stiff_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "flank/base/assert.h"
#include "flank/fit/rank.h"
#include "flank/fit/rejected.h"
#include "flank/fit/ways.h"

namespace flank::internal {
namespace {

/// The tool with all radii in one ratio, such that its slenderness is this; clamped into the bounds.
RadialFunction thickened(const RadialFunction& tool, double slenderness, const RadiusBounds& bounds) {
  const Eigen::VectorXd radii = tool.parameters() * (slenderness_of(tool, bounds) / slenderness);
  return tool.with_parameters(radii.cwiseMax(bounds.smallest).cwiseMin(bounds.largest));
}

/// The same motions again within narrower bounds. The tool keeps them from the beginning: a start that breaks them but
/// covers more would be kept.
FlankFitResult refit(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                     const FlankFitResult& fit, double slenderest, const Progress& progress) {
  FlankFitOptions narrower = options;
  narrower.bounds.slenderest = slenderest;
  narrower.bounds.neck = 1.0;
  std::vector<FitTask> tasks;
  for (const RuledMotion& motion : fit.motions) tasks.push_back({&target, motion, options.obstacles});
  ToolModel from = tool;
  from.first = thickened(fit.tool, slenderest, narrower.bounds);
  FlankFitResult result = fit_from_starts(tasks, from, narrower, progress);
  result.candidates = fit.candidates;
  result.before = fit.before;
  return result;
}

/// Brings the slenderness of a fit down in steps, as far as the fit stays as good.
FlankFitResult stiffened(const Target& target, const ToolModel& tool, const FlankFitOptions& options, double slenderest,
                         const FlankFitResult& open, const Progress& progress) {
  /// Of the slenderness that is too much, in logarithm: halving the rest of the way three times leaves an eighth.
  constexpr int kTrials = 3;
  constexpr double kSoft = 1.02;  // times the bound, which is a soft one
  FlankFitResult best = open;
  const double length = open.tool.axis_length() + options.bounds.shank_length;
  // No tool is thicker than it may be.
  double low = std::max(slenderest, 0.5 * length / options.bounds.largest);
  double high = slenderness_of(open.tool, options.bounds);
  for (int trial = 0; trial < kTrials && high > kSoft * low && !progress.stop(); ++trial) {
    const double middle = std::sqrt(high * low);
    const Progress part = progress.part(static_cast<double>(trial) / kTrials, (trial + 1.0) / kTrials);
    FlankFitResult stiffer = refit(target, tool, options, best, middle, part);
    const double reached = slenderness_of(stiffer.tool, options.bounds);
    if (reached <= kSoft * middle && !is_better(best.after, stiffer.after, options)) {
      high = reached;
      add_rejected(stiffer, best, options.bounds);
      best = std::move(stiffer);
      low = std::min(low, high);
    } else {
      add_rejected(best, stiffer, options.bounds);
      low = middle;
    }
  }
  return best;
}

/// Of the ladder, from the most slender tool that anybody would clamp to one as thick as it is long.
constexpr std::array kRungs = {16.0, 12.0, 8.0, 6.0, 5.0, 4.0, 3.0, 2.5, 2.0, 1.6, 1.25, 1.0};
/// Of the slenderness: a rung that is nearer to the chosen tool would be that tool again.
constexpr double kSameRung = 0.05;

/// The rungs on one side of a slenderness, the nearest first.
std::vector<double> rungs_beside(double slenderness, bool stiffer) {
  std::vector<double> rungs;
  for (const double rung : kRungs)
    if (stiffer ? rung < (1.0 - kSameRung) * slenderness : rung > (1.0 + kSameRung) * slenderness)
      rungs.push_back(rung);
  // They fall already.
  if (!stiffer) std::reverse(rungs.begin(), rungs.end());
  return rungs;
}

/// The bounds of a rung: no more slender than it, and hardly stiffer. None if no cylinder keeps the tool's own bounds too.
std::optional<RadiusBounds> bounds_of(double rung, double axis_length, bool stiffer, RadiusBounds bounds) {
  /// Times: where nothing draws a tool to be thin, it would stay as thick as it may be.
  constexpr double kThicker = 1.15;
  const double radius = 0.5 * (axis_length + bounds.shank_length) / rung;
  if (radius < bounds.smallest || radius > bounds.largest) return {};
  bounds.slenderest = rung;
  if (!stiffer) bounds.largest = std::min(bounds.largest, kThicker * radius);
  return bounds;
}

/// What a rung is fitted from, and with.
struct LadderSetup {
  const std::vector<FitTask>& tasks;
  const ToolModel& tool;
  const FlankFitOptions& options;
  const Progress& progress;
};

FlankFitResult fit_rung(const LadderSetup& setup, const std::vector<RuledMotion>& from, const RadiusBounds& bounds) {
  FlankFitOptions narrower = setup.options;
  narrower.bounds = bounds;
  std::vector<FitTask> tasks = setup.tasks;
  for (std::size_t m = 0; m < tasks.size(); ++m) tasks[m].motion = from[m];
  Progress quiet = setup.progress;
  quiet.report = nullptr;
  quiet.found = nullptr;
  return fit_from_starts(tasks, setup.tool, narrower, quiet);
}

/// Where a rung covers less than the one behind it, it may only have lost its way from the one before: once more from
/// behind.
void refit_dips(const LadderSetup& setup, const std::vector<RadiusBounds>& bounds, std::vector<FlankFitResult>& rungs) {
  constexpr double kDip = 0.005;  // of coverage
  for (std::size_t k = rungs.size(); k-- > 1;) {
    FlankFitResult& rung = rungs[k - 1];
    if (setup.progress.stop() || rungs[k].after.at_tolerance < rung.after.at_tolerance + kDip) continue;
    FlankFitResult again = fit_rung(setup, rungs[k].motions, bounds[k - 1]);
    if (is_better(again.after, rung.after, setup.options)) rung = std::move(again);
  }
}

/// The rungs on one side of the tool that was found, the nearest first.
std::vector<FlankFitResult> fit_ladder_side(const LadderSetup& setup, const FlankFitResult& found, bool stiffer) {
  /// Of the coverage of its start: a rung that keeps less has lost its way, and is no start for the next.
  constexpr double kKept = 0.8;
  const double slenderness = slenderness_of(found.tool, setup.options.bounds);
  std::vector<FlankFitResult> rungs;
  std::vector<RadiusBounds> bounds;
  std::vector<RuledMotion> start = found.motions;
  double covered = found.after.at_tolerance;
  for (const double rung : rungs_beside(slenderness, stiffer)) {
    const auto own = bounds_of(rung, found.tool.axis_length(), stiffer, setup.options.bounds);
    if (!own || setup.progress.stop()) continue;
    setup.progress.step("stiffness curve", static_cast<double>(rungs.size()) / kRungs.size());
    FlankFitResult fit = fit_rung(setup, start, *own);
    if (fit.motions.size() != start.size()) continue;
    if (fit.after.at_tolerance >= kKept * covered) {
      start = fit.motions;
      covered = fit.after.at_tolerance;
    }
    rungs.push_back(std::move(fit));
    bounds.push_back(*own);
  }
  refit_dips(setup, bounds, rungs);
  return rungs;
}

}  // namespace

std::vector<FlankFitResult> stiffness_ladder(const std::vector<FitTask>& tasks, const FlankFitResult& found,
                                             const ToolModel& tool, const FlankFitOptions& options,
                                             const Progress& progress) {
  FLANK_ASSERT(tasks.size() == found.motions.size());
  std::vector<FlankFitResult> ladder = fit_ladder_side({tasks, tool, options, progress.part(0.0, 0.5)}, found, true);
  for (FlankFitResult& rung : fit_ladder_side({tasks, tool, options, progress.part(0.5, 1.0)}, found, false))
    ladder.push_back(std::move(rung));
  return ladder;
}

void note_slenderness(const ToolModel& tool, const FlankFitOptions& options, FlankFitResult& fit) {
  constexpr double kRounding = 0.005;  // of the slenderness: less is not seen in the figure that is shown
  if (!tool.free() || fit.motions.empty()) return;
  const double found = slenderness_of(fit.tool, options.bounds), asked = options.bounds.slenderest;
  if (!(found > (1.0 + kRounding) * asked)) return;
  double most = 0.0;
  for (const RejectedTool& rejected : fit.rejected)
    if (rejected.slenderness <= asked && is_clean(rejected.estimate, options.tolerance_mm))
      most = std::max(most, rejected.estimate.at_tolerance);
  const std::string covers = fmt::format("{:.1f} % of the face", 100.0 * fit.after.at_tolerance);
  fit.notes.push_back(most > 0.0 ? fmt::format("L:D {:.2f} exceeds --slenderness-max {:.1f}: this tool finishes {}, "
                                               "the best stiffer one tried {:.1f} %",
                                               found, asked, covers, 100.0 * most)
                                 : fmt::format("L:D {:.2f} exceeds --slenderness-max {:.1f}: this tool finishes {}, "
                                               "and every stiffer one tried gouges",
                                               found, asked, covers));
}

FlankFitResult relax_stiffness_bounds(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                                      FlankFitResult within, const Progress& progress) {
  const bool bounded = options.bounds.slenderest < 1e300 || options.bounds.neck < 1.0;
  if (!tool.free() || !bounded || progress.stop()) return within;
  FlankFitOptions lifted = options;
  lifted.bounds.slenderest = 1e300;
  lifted.bounds.neck = 1.0;
  lifted.least_coverage_for_last_passes = least_to_win(within.after, options);
  const FlankFitResult open = fit_automatic(target, tool, lifted, progress.part(0.0, 0.6));
  // What enters other faces is no reason to take a thinner tool.
  const bool needed = !open.motions.empty() && is_better(open.after, within.after, lifted);
  if (!needed) {
    add_rejected(within, open, options.bounds);
    note_slenderness(tool, options, within);
    return within;
  }
  FlankFitResult result = stiffened(target, tool, lifted, options.bounds.slenderest, open, progress.part(0.6, 1.0));
  add_rejected(result, within, options.bounds);
  result.notes.push_back(
      fmt::format("L:D {:.1f} is the lowest found that meets the request: a tool limited to {:.1f} finishes {:.1f} % "
                  "of the face, this one {:.1f} %",
                  slenderness_of(result.tool, options.bounds), options.bounds.slenderest,
                  100.0 * within.after.at_tolerance, 100.0 * result.after.at_tolerance));
  return result;
}

}  // namespace flank::internal
