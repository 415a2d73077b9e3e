/// The flank fit: from a target (and, if the user gives one, a start) to a tool and its motions (docs/algorithms/fit.md).
///
/// What every result has, whatever its status but kNoStart:
/// - one tool; one motion for each strip or task, with clamped cubic rails over [0, 1], all of the tool's axis length
/// - a free tool whose radii are clamped to RadiusBounds::smallest and largest at the end of each pass; a given tool has the
///   shape it was given. The other bounds are soft: `after` says what they came to (`legitimate`, `slenderness`)
/// - figures that are estimates of the planner (`before`, `after`). They are no proof: judge.h has the verdict
/// - passes that gained: one whose result does not score better on the samples that rank is dropped
/// - the same bytes for any number of threads, and for a run that was stopped and resumed
///
/// A fit that is cancelled returns its best so far. Nothing is thrown for a target that cannot be fitted: status and message
/// say it. Notation: r(s) is the radius at s of the axis, f the signed distance from target to swept tool (MATH section 9; minus is a
/// gouge), c the axial slip (MATH section 3). Lengths in mm.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "flank/obstacle_field.h"
#include "flank/progress.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"
#include "flank/target.h"

namespace flank {

/// One motion and the target that its envelope is to be. The pointers are not owned and must outlive the fit.
struct FitTask {
  const Target* target = nullptr;
  RuledMotion motion;                        ///< the start
  const ObstacleField* obstacles = nullptr;  ///< what its flank must not enter; null: nothing
};

/// Bounds on the tool, kept by one-sided terms in the fit; a spline's radii are clamped exactly at the end of a pass.
struct RadiusBounds {
  /// mm, >= 0: least r(s), and so the core radius that gives the tool its stiffness. Raise it if the tool comes out too
  /// slender: an exact envelope does not determine the radius (1 to 10 mm fit the same face to 1e-4 mm).
  double smallest = 0.0;
  /// mm, > smallest: largest r(s). 1e300 is "no bound". fit_automatic spreads its radii between the two bounds, so it
  /// needs a finite one, about what fits between the target and its neighbours, unless the tool's radius is known.
  double largest = 1e300;
  /// Largest |r'|, no unit, in (0, 1): spheres stay inscribed only below 1 (MATH section 1). 0.95 is a cone of 72
  /// degrees half angle; lower it for a tool that is to be ground easily.
  double steepest = 0.95;
  /// > 0, no unit: largest slenderness (Stiffness, tool.h) of flank and shank. 1e300 is "no bound". An error alone
  /// chooses thin tools, which fit anywhere and cannot be used: 8 is what a machinist clamps without a second thought.
  double slenderest = 1e300;
  /// In [0, 1], no unit: going up from the tip, r falls below what it was farther down by at most this share. 0: it
  /// never falls; 1: any profile.
  double neck = 1.0;
  /// mm, >= 0: a concave part of the meridian has at least this radius of curvature, that of the grinding wheel which
  /// is to get into it. 0: any.
  double wheel_radius = 0.0;
  /// mm, >= 0: a cylindrical shank above the flank bends too, as `slenderest` counts. Radius 0: that of the flank's
  /// upper end.
  double shank_length = 0.0, shank_radius = 0.0;
  /// Whether the fit keeps that shank out of obstacles as it does the flank. It narrows a search that mostly ends with room for a shank all the
  /// same.
  bool shank_in_the_way = false;
};

/// What one iteration did, over samples whose footpoint is inside the target (of a SweptModel: points to be touched).
struct IterationTrace {
  double cost = 0.0;        ///< mm^2: weighted squares and regularisers, under the weights in force at that iteration
  double rms_mm = 0.0;      ///< of the residuals, unweighted, without dead zone
  double largest_mm = 0.0;  ///< |residual|, unweighted
  double damping = 0.0;     ///< for the next step; no unit
};

/// Residuals e = d - r over samples inside the target. These are errors at the axis: on a target that is no envelope
/// the real error can be 20 times larger (MATH section 7). All zero if no sample is inside.
struct ResidualSummary {
  double rms_mm = 0.0;              ///< root mean square of e
  double largest_mm = 0.0;          ///< |e|
  double inside_share = 0.0;        ///< of all samples, in [0, 1]; of a SweptModel: 1
  double largest_overcut_mm = 0.0;  ///< max(0, -e)
};
/// What is known of the tool and what may change.
struct ToolModel {
  /// Radial function for an axis length and a typical radius (used if the radius is open). Empty: a free spline that
  /// the fit starts from a cylinder. Called from several threads at once.
  std::function<RadialFunction(double axis_length, double radius)> make;
  std::vector<int> free_parameters;    ///< of what `make` returns; empty: the tool is given
  std::optional<double> radius;        ///< typical radius, mm, if it is known: starts then try this one alone
  std::optional<double> axis_length;   ///< mm, if the tool fixes it; goes before FlankFitOptions::axis_length_mm
  std::optional<double> longest_axis;  ///< mm: a start whose contact lines are longer takes so much of them
  /// Of a free tool: the spline that fit_from_starts begins with. None: the mean distances of the starts' axes.
  std::optional<RadialFunction> first;
  /// A spline that may take any form within the bounds (not a family with free parameters).
  [[nodiscard]] bool free() const { return !make; }
  /// mm, where a start's contact lines ask for `wanted` and the options for `asked`.
  [[nodiscard]] double length_for(double wanted, const std::optional<double>& asked) const {
    if (axis_length) return *axis_length;
    if (asked) return *asked;
    return longest_axis && *longest_axis < wanted ? *longest_axis : wanted;
  }
};

/// 15 degrees: a motion that turns more sharply has a kink.
inline constexpr double kMostTurnRad = 0.2617993877991494;

struct FlankFitOptions {
  /// mm, > 0: the |f| that counts as finished. It sets dead zones, robust scales and the score, so a fit at 0.1 is not
  /// a coarser fit at 0.01 but another one.
  double tolerance_mm = 0.01;
  /// mm, > 0. None: 1.02 times the longest offset contact line of the start (1.03 times the longest free stretch beside
  /// walls). Set it if the tool's flank has a length to keep.
  std::optional<double> axis_length_mm;
  /// Of the radial function; the smallest radius is also the default of reach_radius_mm.
  RadiusBounds bounds;
  /// >= 1: motions side by side on one target, one tool. More if one strip covers too little; time grows in proportion.
  int strips = 1;
  /// >= 1: of 50 starts, how many are polished at most, and how many of those get the last passes (the second at most
  /// the first). Raise them if another start is suspected to win after all; most of the time goes into the last passes.
  int polished_candidates = 6, finalists = 3;
  /// Covered share (estimate) that is asked for, in (0, 1]: with less a result does not meet the request.
  double least_coverage = 0.99;
  /// Covered share (estimate) at which a candidate that cuts and enters nothing too deep ends the search. Above 1: all
  /// that are kept are tried to the end.
  double enough_coverage = 0.999;
  /// Radians that a motion may turn within 1 % of its target's diagonal (judge.h, TurnFigure), and the window of six numbers in which it
  /// is asked, mm (path/turning.h); 0: that of each motion's target. Where targets are pieces of one face it is the face's.
  double most_turn_rad = kMostTurnRad, turn_window_mm = 0.0;
  /// Beside walls, where a fit that avoids them from the start falls short: try other ways, too (fit/ways.h).
  bool search_without_obstacles = true;
  /// Covered share in [0, 1]: if the best candidate covers less than this after the polish, the last passes are
  /// skipped. 0: never. For a caller that would try more strips in that case anyway.
  double least_coverage_for_last_passes = 0.0;
  /// Covered share in [0, 1]: fit_automatic returns what covers less without the close check, which costs as much as a pass. 0:
  /// never. For a caller that mostly takes another result then, and asks with_close_look() where it does not.
  double least_coverage_for_close_look = 0.0;
  /// fit_automatic: what the flank must not enter; outlives the call. Null: nothing is in the way. fit_from_starts
  /// takes it from its tasks instead.
  const ObstacleField* obstacles = nullptr;
  /// Whether a line, from a place on in a direction, is free of everything: what holds the tool comes along its axis. Called from several
  /// threads at once. Empty: it always is.
  std::function<bool(const Vec3& from, const Vec3& direction)> is_free_line;
  /// mm, >= 0; with obstacles: only what a ball of this radius can touch without entering them counts as target. 0: the
  /// smallest radius. Raise it to the radius of the tool that will be used.
  double reach_radius_mm = 0.0;
  /// > 0: spacing of the samples that rank candidates, as a share of the square root of the area: 1/45 gives about
  /// 2,000 samples, so coverage is known to about a tenth of a percent. Lower it for a face that is long and thin.
  double sample_share = 1.0 / 45.0;
  /// Places of the targets that count for overcut besides the samples: where somebody else found a cut between them.
  std::vector<Vec3> extra_overcut_points;
};

/// How much of the target a state covers, by the planner's own estimate of the swept distance f. An estimate: the judge
/// decides, and it is stricter.
struct CoverageEstimate {
  double at_tolerance = 0.0;        ///< area share with |f| <= tolerance, in [0, 1]
  double at_four_tolerances = 0.0;  ///< area share with |f| <= 4 tolerances
  double of_whole = 0.0;            ///< like at_tolerance, of all samples, in reach or not
  double overcut_mm = 0.0;          ///< largest max(0, -f), rim included
  double gouge_mm = 0.0;            ///< deepest that the flank enters an obstacle; estimate_coverage leaves it 0
  double undercut_mm = 0.0;         ///< largest material left anywhere on the target, max(0, f)
  double rms_mm = 0.0;              ///< root mean square of f, by area, over samples within four tolerances
  /// |c| where the flank touches the target: it plunges from 1 on. estimate_coverage leaves it 0.
  double largest_c = 0.0;
  /// Share of the motion, by samples, at which the axis beyond the flank's upper end runs into something: nothing could hold the tool there.
  /// estimate_coverage leaves it 0.
  double unheld = 0.0;
  /// By which the motion turns, in FlankFitOptions::most_turn_rad: it has a kink above 1. estimate_coverage leaves it 0.
  double turn = 0.0;
  /// Of a free tool and its shank, and of the thickest one that its bounds allow; 0 of others. estimate_coverage leaves them 0.
  double slenderness = 0.0, least_slenderness = 0.0;
  /// Of motions over the facing sides of a cavity: how far the ends of their axes lie apart along the way, as a share of
  /// the axis length, which the tool must make up for on its way across. Else 0.
  double stagger = 0.0;
  /// The tool is one (check_legitimacy); asked of what is looked at closely, and of no draft before that.
  bool legitimate = true;
  /// What candidates are ranked by, larger is better, at most 1.2; no unit. Coverage, less a price for overcut and
  /// gouge (10 % of coverage for the first tolerance of excess), for plunging and for stagger, with the mean error as
  /// tie-break.
  [[nodiscard]] double score(double tolerance_mm) const;
};

/// A tool that a search polished and did not choose, and what it does, by the planner's estimate.
struct RejectedTool {
  double slenderness = 0.0;  ///< of flank and shank, as RadiusBounds::slenderest counts; infinite for what is no tool
  double axis_length_mm = 0.0, largest_radius_mm = 0.0;
  int strips = 0;
  CoverageEstimate estimate;
};

enum class FitStatus {
  kNotRun,
  kWithinTolerance,  ///< by the estimate it meets what was asked (fit/rank.h)
  kPartial,  ///< a motion was found, but it covers less, cuts or enters something deeper, has a kink or too slender a tool
  kNoStart,  ///< no start gave a motion; the result has none
};

/// Beside walls: whether other ways than to avoid them from the start were tried (FlankFitOptions::search_without_obstacles), and what came of it.
enum class UnobstructedSearch { kNotTried, kBeaten, kBest };

struct FlankFitResult {
  FitStatus status = FitStatus::kNotRun;
  std::string message;  ///< one line for the user
  RadialFunction tool;
  std::vector<RuledMotion> motions;
  CoverageEstimate before, after;      ///< of the chosen start, of the result
  ResidualSummary residuals;           ///< on a grid of its own with cold footpoints: no sample of a pass is among them
  std::vector<IterationTrace> trace;   ///< of the chosen candidate, all passes from the polish on
  std::vector<std::string> notes;      ///< for the user, added by callers
  int candidates = 0;                  ///< starts that were tried
  std::vector<RejectedTool> rejected;  ///< what was polished and not chosen, in its order
  UnobstructedSearch unobstructed_search = UnobstructedSearch::kNotTried;
  bool closely_measured = true;  ///< closely: false as FlankFitOptions::least_coverage_for_close_look says
};

/// Automatic start: many ruled candidates across the target, each fitted briefly, ranked by swept coverage, the best
/// polished (MATH section 7). One target; options.strips motions. Needs tool.radius or a finite options.bounds.largest.
/// The same bytes for any number of threads.
[[nodiscard]] FlankFitResult fit_automatic(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                                           const Progress& progress);

/// Polishes given starts: one motion and one target per task (at least one; all of one axis length), one tool for all.
/// Ranks by all their targets, each beside the obstacles of its first task.
[[nodiscard]] FlankFitResult fit_from_starts(const std::vector<FitTask>& tasks, const ToolModel& tool,
                                             const FlankFitOptions& options, const Progress& progress);

/// Motions on several targets with one tool, as they were found. `found`: the tool, of the motions' axis length.
[[nodiscard]] FlankFitResult fit_as_found(const std::vector<FitTask>& tasks, const RadialFunction& found,
                                          const ToolModel& tool, const FlankFitOptions& options);

/// The same if they do what is asked (options.enough_coverage), else polished together, from the mean distances of their axes; the
/// better of both.
[[nodiscard]] FlankFitResult fit_together(const std::vector<FitTask>& tasks, const RadialFunction& found,
                                          const ToolModel& tool, const FlankFitOptions& options,
                                          const Progress& progress);

/// A result that has gone without the last look, with it. `tasks`: its targets and what is in the way of each of its motions.
[[nodiscard]] FlankFitResult with_close_look(const std::vector<FitTask>& tasks, const FlankFitResult& found,
                                             const ToolModel& tool, const FlankFitOptions& options);

/// A result that turns out to cut deeper than the tolerance at options.extra_overcut_points, between the samples that it was looked at
/// with, led out of what it cuts. `tasks`: its targets and what is in the way of each of its motions. Notes and rejected
/// tools stay. None if nothing better is found.
[[nodiscard]] std::optional<FlankFitResult> mend_fit(const std::vector<FitTask>& tasks, const FlankFitResult& found,
                                                     const ToolModel& tool, const FlankFitOptions& options);

}  // namespace flank
