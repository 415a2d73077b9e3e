/// The commands as functions: a job in (job.h), a result out, and the folder that holds it.
///
/// What is guaranteed of a result:
/// - its verdict (`verify`, `acceptance()`) comes from tool, path and part alone, by code that the planner does not share
/// - it is the same for any number of threads, and for a run that was stopped and resumed, byte by byte
/// - it is written whole or not at all, beside a manifest that ties its files to each other and to the part
/// - a job that cannot be done throws UsageError or InputError before any work; a result that falls short is a result
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "flank/job.h"
#include "flank/judge.h"
#include "flank/path.h"
#include "flank/progress.h"
#include "flank/ruled_motion.h"
#include "flank/tool.h"

namespace flank {

/// What is not as requested, and in which figure it shows.
struct Shortfall {
  /// Name of the figure in verify.json ("overcut_mm", "gouge_mm", ...), "legitimate" or "complete".
  std::string figure;
  std::string text;  ///< one line for people: face, place, depth, strip
};

/// Whether a result meets its request. Exit codes, summaries, verify.json and the report all go by this.
struct Acceptance {
  std::vector<Shortfall> reasons;   ///< why it does not meet the request; empty: it does
  std::vector<Shortfall> cautions;  ///< what the verdict says nothing about, though a shop must know it: shown in amber
  [[nodiscard]] bool pass() const { return reasons.empty(); }
};

/// What a planner estimates of a state of its work. The judge's figures are the ones that count.
struct PlannedShare {
  double coverage = 0.0;  ///< area share within tolerance
  double overcut_mm = 0.0;
};

/// One iteration of a fit: over samples whose footpoint is inside the target.
struct FitStep {
  double cost = 0.0, rms_mm = 0.0, largest_mm = 0.0, damping = 0.0;
};

/// A tool that a fit tried, or was asked to try, and what it costs to have it as stiff.
struct StiffnessStep {
  double slenderness = 0.0;  ///< of flank and shank
  double axis_length_mm = 0.0, largest_radius_mm = 0.0;
  int strips = 0;
  double coverage = 0.0;                          ///< share of the whole target's area within tolerance
  std::optional<double> coverage_reachable = {};  ///< of what is reachable; none: not known
  double overcut_mm = 0.0;                        ///< deepest in the target
  double gouge_mm = 0.0;                          ///< deepest in other faces
  double rms_mm = 0.0;                            ///< of the swept distance where the path touches
  bool judged = false;                            ///< by the judge's samples; else the planner's estimates
  bool chosen = false;                            ///< the result's own tool
};

/// How a fit went.
struct FitSummary {
  int candidates = 0;                     ///< starts that were tried
  PlannedShare before, after;             ///< of the chosen start, of the result
  double rms_mm = 0.0, largest_mm = 0.0;  ///< of the residuals, on a denser grid
  double inside_share = 0.0;              ///< of that grid: samples whose footpoint is inside the target
  std::vector<FitStep> trace;
  std::vector<StiffnessStep> stiffness;  ///< of a free tool: the tools that were tried, the stiffest first
};

/// How one target was covered.
struct TargetCover {
  std::string faces;      ///< "F1" or "F1,F2"
  double area_mm2 = 0.0;  ///< of the target
  int seeds = 0;          ///< where lines were begun
  int lines = 0;          ///< seeds that touch within tolerance
  int grown = 0;          ///< candidates for strips
  int strips = 0;
  double reachable = 0.0;            ///< share of the area
  double before = 0.0, after = 0.0;  ///< covered share of what is reachable, before and after the strips are smoothed
  double overlap = 0.0;              ///< sum of the strips' covered areas over that of their union, minus 1
  double links_mm = 0.0, overcut_mm = 0.0;  ///< way between the strips; deepest in the target
};

/// How a cover went.
struct CoverSummary {
  std::vector<TargetCover> targets;
  /// All targets as one: counts and ways are sums, shares are weighted by the areas that they are shares of.
  [[nodiscard]] TargetCover whole() const;
};

/// One layer of a cavity, by the planner's measure (docs/algorithms/trochoid.md).
struct LayerSummary {
  int cycles = 0;
  std::string status;  ///< done, stuck, short (where the layer above got stuck), cancelled
  std::string why;     ///< not done: what ended it, with its figure, and how far it got
  double fronts_mm = 0.0, backs_mm = 0.0, sides_mm = 0.0, links_mm = 0.0;
  double volume_mm3 = 0.0;  ///< removed by fronts and backs
  double side_volume_mm3 = 0.0;
  double front_deg = 0.0, back_deg = 0.0;  ///< largest engagement
  /// How it begins: open, before the blank, ramp or plunge. The largest engagement of a ramp or a plunge is held to no limit:
  /// it cuts a slot.
  std::string entry = "open";
  double entry_deg = 0.0, entry_mm = 0.0, entry_mm3 = 0.0;  ///< of a ramp or a plunge: engagement, way, removed volume
  double entry_depth_mm = 0.0;    ///< along the axis: how much a pass of a ramp sinks, how deep a plunge goes
  double entry_slope_deg = 0.0;   ///< of a ramp
  double entry_width_mm = 0.0;    ///< of all plunges but the first
  double side_deg = 0.0;          ///< of the finishing sweeps
  double entered_mm = 0.0;        ///< deepest that the entry or a half enters a face
  std::vector<double> cycle_deg;  ///< largest engagement of each cycle
  std::vector<double> cycle_mm3;  ///< removed volume of each cycle
  std::vector<double> cycle_mm;   ///< way of each cycle
};

/// How a cavity went.
struct TrochoidSummary {
  FitSummary sides;
  double most_engagement_deg = 60.0;
  double narrowest_mm = 0.0;  ///< between the sides
  double minutes = 0.0;       ///< at the job's rates
  std::vector<LayerSummary> layers;
  std::string no_cycles;                     ///< without layers: why, with the figures of the sides
  [[nodiscard]] double largest_deg() const;  ///< of fronts and backs
  [[nodiscard]] double way_mm() const;       ///< of entries, fronts, backs and sides
  [[nodiscard]] bool done() const;           ///< every layer is
};

/// One tool of a ranking.
struct RankedChoice {
  std::string tool;   ///< how it is asked for: a name in the catalogue, or a family with its parameters
  std::string name;   ///< of the tool itself
  std::string stage;  ///< how far it came: screened, quick, thorough, full
  ToolFamily family = ToolFamily::kSpline;
  double axis_length_mm = 0.0;
  bool works = false;
  double reachable_share = 0.0, coverage_reachable = 0.0, coverage = 0.0;  ///< of the area of all targets
  int strips = 0;
  double strips_mm = 0.0, links_mm = 0.0, minutes = 0.0;
  double fits = 0.0, accepted = 0.0, open = 0.0;  ///< of the screen (docs/algorithms/catalogue.md)
  std::string reason;                             ///< why it cannot work
};

/// The tools that were compared, best first (docs/schema/ranking.md).
struct Ranking {
  std::string source;  ///< "catalogue FOLDER", or what was searched
  double tolerance_mm = 0.0, strip_price = 0.0, feed_mm_min = 0.0, rapid_mm_min = 0.0;
  std::vector<RankedChoice> tools;
};

/// A file, or a folder of files, that a job names beside its part, as it was when the job began.
struct InputStamp {
  std::string file;    ///< as the job names it
  std::string sha256;  ///< of its bytes; of a folder: of the names and bytes of its files
};

/// What fit and cover make.
struct Result {
  PlanJob job;
  std::string part_sha256;         ///< Part::sha256 of the part that was read
  std::vector<InputStamp> inputs;  ///< tool, guide, fixtures, holder, catalogue, as far as they are files
  Tool tool;
  Path path;
  std::vector<RuledMotion> motions;  ///< motion k is strip k of the path; of a cavity: the side paths
  std::variant<FitSummary, CoverSummary, TrochoidSummary> plan;
  VerifyReport verify;
  std::optional<Ranking> ranking;  ///< if the tool was chosen
  double chord_bound_mm = 0.0;     ///< between the motions and the joined poses
  double largest_c = 0.0;          ///< of the envelope where it touches a target, along the written path; < 1 needed
  BendRadii bends;                 ///< of the path's two ends, within each strip
  double diagonal_mm = 0.0;        ///< of the first target
  std::vector<std::string> notes;  ///< repairs of the part, warnings
  std::vector<std::pair<std::string, double>> seconds;  ///< stage, wall time
  bool complete = true;                                 ///< false: cancelled, what is here is unfinished
  /// The steps that were finished, of a result that is not complete; write_result keeps them for read_journal.
  std::shared_ptr<const Progress::Journal> journal;
  struct Drawings;
  std::shared_ptr<const Drawings> drawings;  ///< surfaces of the strips and what a report shows

  [[nodiscard]] Acceptance acceptance() const;
};

/// `flank fit`. Throws UsageError and InputError before any work is done.
[[nodiscard]] Result run_fit(const FitJob& job, const Progress& progress = {});

/// `flank cover`. Throws likewise.
[[nodiscard]] Result run_cover(const CoverJob& job, const Progress& progress = {});

/// `flank trochoid`. Throws likewise.
[[nodiscard]] Result run_trochoid(const TrochoidJob& job, const Progress& progress = {});

/// The steps that a run into this folder had finished when it was stopped (docs/schema/resume.md). Handed to the same job
/// as Progress::journal, it goes on from there, and its result is that of a run that was never stopped, byte by byte. One
/// journal is for one run. Throws InputError if the folder has none or a damaged one; the run throws InputError for one of
/// another job, part or version.
[[nodiscard]] std::shared_ptr<Progress::Journal> read_journal(const std::string& folder);

/// Writes tool.json, tool.dxf, tool.step, tool.fctb, strips.step, path.json, path.cls, path.csv, verify.json, view.json,
/// summary.json and job.json to a folder, ranking.json if there is a ranking, and resume.json if it is not complete. A tool that is not legitimate has
/// neither tool.step nor tool.fctb. All of them take the place of an earlier result at once, with a manifest.json that ties
/// them together and to the part (docs/schema/manifest.md); other files in the folder stay. Throws InputError if the folder
/// cannot be written, holds under one of these names a file that the job reads or that no earlier result made, or another
/// process writes to it; what was there is whole then.
void write_result(const Result& result, const std::string& folder);

/// The result as a table for a terminal.
[[nodiscard]] std::string summary_text(const Result& result);
/// summary.json (docs/schema/summary.md).
[[nodiscard]] std::string summary_json(const Result& result);

/// What verify finds.
struct Verification {
  PlanJob job;  ///< of the folder, with what the request replaces
  VerifyReport report;
  Acceptance acceptance;
  std::vector<std::string> notes;
  /// Of a program of several operations: what each of them is, and its own verdict. `report` is empty then, and `acceptance` has all
  /// of their reasons.
  std::vector<std::string> operation_names = {};
  std::vector<Verification> operations = {};
};

/// `flank verify`: reads job.json, tool.json and path.json of a folder, judges, and writes verify.json and view.json. With
/// a program (VerifyJob::nc) that is judged instead of the path, as its machine runs it, and nothing is written.
[[nodiscard]] Verification run_verify(const VerifyJob& job);

/// The verdict as a table for a terminal.
[[nodiscard]] std::string verify_text(const Verification& outcome);
/// The same as verify.json (docs/schema/verify.md).
[[nodiscard]] std::string verify_json(const Verification& outcome);

/// The range that a joint uses, and how fast and how hard it is driven: mm or degrees, and seconds.
struct JointRange {
  std::string joint, unit;
  double low = 0.0, high = 0.0, speed = 0.0, acceleration = 0.0;
};

/// One operation of a program: a tool and its path.
struct PostOperation {
  std::string folder, name;
  int tool_number = 1;
  std::string tool;          ///< its name
  int copy = 1, copies = 1;  ///< which of the turned copies
  double spindle_rpm = 0.0;  ///< 0: it stands
  double minutes = 0.0, cutting_minutes = 0.0;
  std::string motion = {};  ///< motion.json: what the joints do over time, for the report (docs/schema/motion.md)
};

/// A program and what it does.
struct PostOutcome {
  std::string program;           ///< the text; empty where it does not pass and PostJob::force does not ask for it
  std::string machine, nesting;  ///< name; "table-table", "head-table" or "head-head"
  std::string setup;             ///< "x,y,z,a,b,c", as it was given or found
  bool setup_found = false;      ///< it was searched
  int strips = 0;
  std::size_t poses = 0, moves = 0, inserted = 0, left_out = 0;  ///< planned poses of strips; blocks; points
  double deviation_mm = 0.0;    ///< the control's motion is nowhere farther from the path: proved
  double rounding_mm = 0.0;     ///< the most that the program's digits add
  double least_tilt_deg = 0.0;  ///< between the tool and the first rotary axis
  double minutes = 0.0, cutting_minutes = 0.0;
  std::vector<JointRange> joints;
  Acceptance acceptance;  ///< collisions of links and of the machine, what the program's digits add
  std::vector<std::string> notes;
  std::string motion;  ///< motion.json of the first operation
  std::vector<PostOperation>
      operations;  ///< in the order of the program; the figures above are of all of them together
};

/// `flank post`: reads job.json, tool.json and path.json of a folder. Throws UsageError and InputError: also where the
/// machine cannot run the path, naming strip, pose and joint.
[[nodiscard]] PostOutcome run_post(const PostJob& job);

/// The figures as a table for a terminal, and as JSON (docs/schema/post.md).
[[nodiscard]] std::string post_text(const PostOutcome& outcome);
[[nodiscard]] std::string post_json(const PostOutcome& outcome);

}  // namespace flank
