/// `flank fit` as one function: part file in, tool, path and verdict out.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "flank/artefact/acceptance.h"
#include "flank/envelope/strip_surface.h"
#include "flank/fit.h"
#include "flank/judge.h"
#include "flank/part.h"
#include "flank/path.h"
#include "flank/progress.h"
#include "flank/setup/check_faces.h"
#include "flank/setup/clearance_job.h"
#include "flank/tool.h"

namespace flank::internal {

/// What the user asked for. Lengths in mm.
struct FitJob {
  std::string command = "fit";       ///< of the command line that asked for this
  std::string part;                  ///< file
  std::optional<std::string> unit;   ///< of a mesh
  std::string faces = "F1";          ///< "F1" or "F1,F3": one target
  std::optional<int> side;           ///< +1, -1: which side of an open sheet is machined; none: both are tried
  std::string tool = "free";         ///< tool spec: free, family[:name=value,...], or a tool.json
  std::optional<std::string> start;  ///< "x,y,z,x,y,z": tip and holder end of a first axis
  std::optional<std::string> guide;  ///< file of several such lines
  int strips = 1;                    ///< 0: as many as the tolerance needs, at most kMostStrips
  double tolerance_mm = 0.01;
  std::optional<double> axis_length_mm;
  std::optional<double> radius_min_mm, radius_max_mm;
  double slope_max = 0.95;                ///< of |r'|
  double least_coverage = 0.95;           ///< share of what is reachable of the target, within tolerance: done
  std::optional<double> sample_mm;        ///< spacing of the judge's samples
  std::optional<double> reach_radius_mm;  ///< of the ball that says what is reachable; none: the tool's smallest radius
  CheckFaceChoice check;                  ///< which other faces must not be entered
  bool avoid = true;       ///< the planner steers clear of the check faces; the judge looks at them anyway
  ClearanceJob clearance;  ///< shank, holder, fixtures
};
inline constexpr int kMostStrips = 12;

struct FitOutcome {
  Tool tool;
  Path path;
  FlankFitResult fit;
  std::vector<StripSurface> strip_surfaces;  ///< one a strip of the path
  VerifyReport verify;
  std::string view;             ///< view.json, for `flank report`
  std::string ranking;          ///< ranking.json, where tools were ranked; else empty
  std::string ranking_text;     ///< the same as a table
  double chord_bound_mm = 0.0;  ///< between the motion and the joined poses
  double largest_c = 0.0;       ///< regularity of the envelope along the written path, < 1 needed
  double diagonal_mm = 0.0;     ///< of the target
  std::vector<std::pair<std::string, double>> figures;  ///< name, value: what else a command has to say in summaries
  std::vector<std::string> notes;                       ///< repairs of the part, warnings
  std::vector<std::pair<std::string, double>> seconds;  ///< stage, wall time
  bool complete = true;                                 ///< false: cancelled, what is here is unfinished
  /// Whether this is what was asked for: the one rule (acceptance.h).
  [[nodiscard]] Acceptance acceptance(const FitJob& job) const;
};

/// Reads, fits, samples and judges. Throws UsageError and InputError before any work is done.
[[nodiscard]] FitOutcome run_fit(const FitJob& job, const Progress& progress);

/// Wall time of one stage after another, into outcome.seconds.
class Stopwatch {
 public:
  explicit Stopwatch(FitOutcome& outcome) : outcome_(outcome) {}
  void lap(const std::string& stage);

 private:
  FitOutcome& outcome_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

struct TargetGroup;
/// Samples the motions (groups[m]: what motion m machines) as strips of the path, each cut to the time in which it
/// machines, with their surfaces. outcome.tool must be there, and the path empty.
void add_strips(const FitJob& job, const std::vector<RuledMotion>& motions,
                const std::vector<const TargetGroup*>& groups, FitOutcome& outcome);
/// Judges tool and path of the outcome, measures clearances, makes the view. faces, checks: indices of targets and check
/// faces.
void judge_outcome(const FitJob& job, const Part& part, const std::vector<int>& faces, const std::vector<int>& checks,
                   FitOutcome& outcome, Stopwatch& watch);

/// Writes tool.json, tool.dxf, tool.step, tool.fctb, strips.step, path.json, path.cls, path.csv, verify.json, view.json,
/// summary.json and job.json to a folder, and ranking.json where tools were ranked. A tool that is not legitimate has neither
/// tool.step nor tool.fctb.
void write_fit(const FitJob& job, const FitOutcome& outcome, const std::string& folder);

/// Table for a terminal.
[[nodiscard]] std::string summary_text(const FitJob& job, const FitOutcome& outcome);
/// summary.json (schema openflank/summary/1).
[[nodiscard]] std::string summary_json(const FitJob& job, const FitOutcome& outcome);

}  // namespace flank::internal
