#include "flank/pipeline/stiff_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flank/fit/coverage.h"
#include "flank/fit/ways.h"
#include "flank/tool.h"

namespace flank::internal {
namespace {

/// Slenderness of flank and shank, as the bounds count it.
double slenderness_of(const RadialFunction& radial, const RadiusBounds& bounds) {
  Tool tool;
  tool.radial = radial;
  const double length = radial.axis_length();
  if (bounds.shank_length > 0.0) {
    const double radius = bounds.shank_radius > 0.0 ? bounds.shank_radius : radial.at(length).r;
    tool.shank = {{length, radius}, {length + bounds.shank_length, radius}};
  }
  return stiffness(tool).slenderness;
}

/// Does `stiffer` do what `fit` does, up to the share that stiffness may cost?
bool as_good(const FlankFitResult& stiffer, const FlankFitResult& fit, double tolerance_mm) {
  return stiffer.after.at_tolerance >= fit.after.at_tolerance - kStiffnessCost &&
         (is_clean(stiffer.after, tolerance_mm) || !is_clean(fit.after, tolerance_mm));
}

/// The same motions again within narrower bounds.
FlankFitResult refit(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                     const FlankFitResult& fit, double slenderest, const Progress& progress) {
  FlankFitOptions narrower = options;
  narrower.bounds.slenderest = slenderest;
  narrower.bounds.neck = 1.0;
  std::vector<FitTask> tasks;
  for (const RuledMotion& motion : fit.motions) tasks.push_back({&target, motion, options.obstacles});
  FlankFitResult result = fit_from_starts(tasks, tool, narrower, progress);
  result.candidates = fit.candidates;
  result.before = fit.before;
  return result;
}

/// Brings the slenderness of a fit down in steps, as far as the fit stays as good.
FlankFitResult stiffened(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                         const FlankFitResult& open, const Progress& progress) {
  /// Of the slenderness that is too much, in logarithm: halving the rest of the way five times leaves a thirtieth.
  constexpr int kTrials = 5;
  FlankFitResult best = open;
  double high = slenderness_of(open.tool, options.bounds), low = options.bounds.slenderest;
  for (int trial = 0; trial < kTrials && high > 1.02 * low && !progress.stop(); ++trial) {
    const double middle = std::sqrt(high * low);
    FlankFitResult stiffer = refit(target, tool, options, best, middle, progress);
    if (as_good(stiffer, open, options.tolerance_mm)) {
      high = std::min(middle, slenderness_of(stiffer.tool, options.bounds));
      best = std::move(stiffer);
      low = std::min(low, high);
    } else {
      low = middle;
    }
  }
  return best;
}

}  // namespace

FlankFitResult soften(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                      FlankFitResult within, const Progress& progress) {
  const bool bounded = options.bounds.slenderest < 1e300 || options.bounds.neck < 1.0;
  if (!tool.free() || !bounded || progress.stop()) return within;
  FlankFitOptions lifted = options;
  lifted.bounds.slenderest = 1e300;
  lifted.bounds.neck = 1.0;
  lifted.least_coverage_for_last_passes = least_to_win(within.after, options);
  const FlankFitResult open = fit_automatic(target, tool, lifted, progress);
  if (open.motions.empty() || as_good(within, open, options.tolerance_mm)) return within;
  // What enters other faces is no reason to take a thinner tool.
  if (!is_better(open.after, within.after, options.tolerance_mm)) return within;
  FlankFitResult result = stiffened(target, tool, options, open, progress);
  result.notes.push_back(
      fmt::format("a slenderness of {:.1f} is the least that was found here: within {:.1f}, {:.1f} % of the face is "
                  "covered, with it "
                  "{:.1f} %",
                  slenderness_of(result.tool, options.bounds), options.bounds.slenderest,
                  100.0 * within.after.at_tolerance, 100.0 * result.after.at_tolerance));
  return result;
}

}  // namespace flank::internal
