/// The flank fit: from a target (and, if the user gives one, a start) to a tool and its motions.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "flank/fit/model/fit_model.h"
#include "flank/fit/model/minimise.h"
#include "flank/progress.h"

namespace flank::internal {

/// What is known of the tool and what may change.
struct ToolModel {
  /// Radial function for an axis length and a typical radius (used where the radius is open). Empty: a free spline that
  /// the fit starts from a cylinder.
  std::function<RadialFunction(double axis_length, double radius)> make;
  std::vector<int> free_parameters;   ///< of what `make` returns; empty: the tool is fixed
  std::optional<double> radius;       ///< typical radius, where it is known
  std::optional<double> axis_length;  ///< where the tool fixes it
  [[nodiscard]] bool free() const { return !make; }
};

struct FlankFitOptions {
  double tolerance_mm = 0.01;
  std::optional<double> axis_length_mm;  ///< none: 1.02 times the longest offset contact line of the start
  RadiusBounds bounds;
  int strips = 1;                                   ///< motions side by side on one target, one tool
  int kept_after_quick = 6, kept_after_polish = 3;  ///< candidates
  double promising = 0.0;  ///< the last passes are left out where the best candidate covers less before them
  const FlankChecks* checks = nullptr;  ///< fit_automatic: what the flank must not enter; outlives the call
  double reach_radius_mm =
      0.0;  ///< with checks: the target is what a ball of this radius reaches; 0: the smallest radius
  double sample_share =
      1.0 / 45.0;  ///< spacing of the samples that rank candidates, as a share of the square root of the area
};

/// How much of the target a state covers, by the planner's own estimate of the swept distance.
struct CoverageEstimate {
  double at_tolerance = 0.0, at_four_tolerances = 0.0;  ///< area shares
  double overcut_mm = 0.0;
  double gouge_mm = 0.0;     ///< deepest that the flank enters a check face
  double undercut_mm = 0.0;  ///< largest material left anywhere on the target
  double rms_mm = 0.0;       ///< of f over samples within four tolerances
  [[nodiscard]] double score(double tolerance_mm) const;
};

enum class FitStatus {
  kNotRun,
  kWithinTolerance,  ///< estimated coverage >= 99 % and overcut <= tolerance
  kPartial,          ///< a motion was found, but it covers less or cuts deeper
  kNoStart,          ///< no candidate touched the target
};

struct FlankFitResult {
  FitStatus status = FitStatus::kNotRun;
  std::string message;
  RadialFunction tool;
  std::vector<RuledMotion> motions;
  CoverageEstimate before, after;  ///< of the chosen start, of the result
  ResidualSummary residuals;       ///< on a 3 times denser grid with fresh cold footpoints
  std::vector<IterationTrace> trace;
  std::vector<std::string> notes;
  int candidates = 0;
};

/// Automatic start: many ruled candidates across the target, each fitted briefly, ranked by swept coverage, the best
/// polished (MATH section 7). One target; options.strips motions.
[[nodiscard]] FlankFitResult fit_automatic(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                                           const Progress& progress);

/// Polishes given starts: one motion and one target per task, one tool for all.
[[nodiscard]] FlankFitResult fit_from_starts(const std::vector<FitTask>& tasks, const ToolModel& tool,
                                             const FlankFitOptions& options, const Progress& progress);

/// The estimate for a set of motions over one target's samples.
[[nodiscard]] CoverageEstimate estimate_coverage(const std::vector<SurfaceSample>& samples,
                                                 const std::vector<RuledMotion>& motions, const RadialFunction& tool,
                                                 double tolerance_mm, int poses);

/// The deepest that the flank enters a check face, mm; checks as in FitDraft.
[[nodiscard]] double flank_gouge(const std::vector<RuledMotion>& motions, const std::vector<const FlankChecks*>& checks,
                                 const RadialFunction& tool, int poses);

/// Residuals on a grid of count_t x count_s with fresh cold footpoints; samples beyond the border are left out.
[[nodiscard]] ResidualSummary validate(const std::vector<FitTask>& tasks, const RadialFunction& tool, int count_t,
                                       int count_s);

}  // namespace flank::internal
