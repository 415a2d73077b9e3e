/// The one rule that says whether a result meets its request: exit codes, summaries, verify.json and the report all take
/// it from here.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>

#include "flank/run.h"

namespace flank::internal {

/// Everything that a verdict can be about. A reason or a caution is made of one of these and of nothing else, so whoever shows
/// verdicts (and whoever tests that) has the whole list.
enum class Figure {
  kComplete,       ///< the work was not stopped
  kLegitimate,     ///< the tool's profile
  kVerdict,        ///< it was judged at all
  kOvercut,        ///< found on a target
  kGouge,          ///< found on a check surface
  kBuried,         ///< strips inside the material
  kOvercutBound,   ///< proved of a target
  kGougeBound,     ///< proved of a check surface
  kCoverage,       ///< of what is reachable
  kCoverageBound,  ///< the same, proved
  kClearance,      ///< shank, holder, fixtures, links
  kStock,          ///< the replay of a cavity's program
  kBendRadius,     ///< of the path's ends
  kEngagement,     ///< of the planned cycles
  kCycles,         ///< all cycles are there
  kTravel,         ///< a program leaves the travel of a joint
  kAxisSpeed,      ///< a program asks a joint for more than its speed
  kMachineBodies,  ///< table and head come too near
  kUnreadFaces,    ///< faces that are in the file and could not be read
  kWholeCoverage,  ///< share of the whole face, whatever is reachable
  kHold,           ///< the axis above the flank runs through the part: nothing could hold the tool
  kBodyUnknown,    ///< no shank or no holder was given, so none was checked
  kSheetSide,      ///< which side of an open sheet is machined
  kRounding,       ///< what a program's digits add
  kRapid,          ///< a rapid move touches material
  kWorkOffset,     ///< a program's work offset is not that of the set-up
  kToolLength,     ///< a program's tool length is not that of the set-up
  kToolNumber,     ///< a program cuts with another tool
  kSpindle,        ///< a program cuts while the spindle stands still
  kMachine,        ///< a program is for another machine
  kSetup,          ///< what a program's header says of the set-up contradicts itself
  kProgramPath,    ///< a program does not run the path that it was made of
  kTurn,           ///< the motion has a kink
  kBending,        ///< what a tool that bends leaves, where a load is known
  kCount
};

/// The names in verify.json, in the order of Figure.
inline constexpr std::array<std::string_view, static_cast<std::size_t>(Figure::kCount)> kFigureNames{
    "complete",
    "legitimate",
    "verdict",
    "overcut_mm",
    "gouge_mm",
    "buried",
    "overcut_bound_mm",
    "gouge_bound_mm",
    "coverage_reachable",
    "coverage_bound",
    "clearance",
    "stock",
    "bend_radius",
    "engagement",
    "cycles",
    "travel",
    "axis_speed",
    "machine_bodies",
    "unread_faces",
    "coverage",
    "hold",
    "shank_and_holder",
    "sheet_side",
    "rounding_mm",
    "rapid",
    "work_offset",
    "tool_length",
    "tool_number",
    "spindle",
    "machine",
    "setup",
    "program_path",
    "turn",
    "bending"};

/// "overcut_mm".
[[nodiscard]] constexpr std::string_view figure_name(Figure figure) {
  return kFigureNames[static_cast<std::size_t>(figure)];
}

/// Adds a reason why the request is not met.
void add_reason(Acceptance& acceptance, Figure figure, std::string text);
/// Adds what the verdict says nothing about.
void add_caution(Acceptance& acceptance, Figure figure, std::string text);

/// Passes: the work is complete, the tool legitimate, overcut on every target and every check face surely at most the
/// report's tolerance (its bound is; samples alone give one, too), coverage of what is reachable, and of the whole where that is
/// asked for, at least the request's (its bound, where there is one), every clearance kept, and nothing in the way of whatever
/// holds the tool. Cautions: a part of the whole face that is left, a shank or holder that was not given.
[[nodiscard]] Acceptance accept(const Tool& tool, const VerifyReport& report, const JudgeRequest& request,
                                bool complete = true);

/// Adds what the replay of a cavity's program finds against it: engagement above the limit by more than its resolution (but
/// for strips that cut a slot to get in), material of more than kMostUncutMm (and two cells) left between the sides, faces
/// entered by more than the tolerance and a tenth of a cell.
inline constexpr double kMostUncutMm = 0.1;
/// `where` names a pose of a strip, both 0-based; none: by the strip's number.
void accept_stock(const StockReport& stock, double most_engagement_deg, double tolerance_mm, Acceptance& acceptance,
                  const std::function<std::string(std::size_t strip, std::size_t pose)>& where = {});

/// Adds what is not as asked of a cavity's cycles: their engagement, and that they are all there.
void accept_cavity(const TrochoidSummary& cavity, Acceptance& acceptance);

/// Adds that the path of tip or holder end bends more sharply than the job lets it (FitJob::min_bend_radius_mm).
void accept_bends(const PlanJob& job, const BendRadii& bends, Acceptance& acceptance);

/// "              F88 is entered ..." a line for each reason, then one for each caution.
[[nodiscard]] std::string reason_lines(const Acceptance& acceptance);

}  // namespace flank::internal
