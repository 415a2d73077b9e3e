/// `flank bound` without a tool: what no tool whose radii are large enough does better on a face (docs/algorithms/bound.md).
#pragma once

#include <string>
#include <vector>

#include "flank/job/bound_job.h"
#include "flank/limit/ball_bound.h"
#include "flank/progress.h"

namespace flank::internal {

/// One target: faces that are joined.
struct FreeBoundTarget {
  std::string faces;
  double diagonal_mm = 0.0, radius_mm = 0.0;  ///< no radius of the tool is smaller
  BallBound bound;
};

struct FreeBound {
  BoundJob job;  ///< with the tolerance that was used
  std::string part_sha256;
  std::vector<FreeBoundTarget> targets;
  std::vector<std::string> notes;
  bool complete = true;
  /// Every tool leaves or cuts at least this much on one of the targets, mm.
  [[nodiscard]] double bound_mm() const;
};

/// Is the tool of this request free?
[[nodiscard]] bool asks_for_free_tool(const BoundJob& job);

/// Reads the part and bounds every target. Throws UsageError and InputError before any work is done, Stopped without a site.
[[nodiscard]] FreeBound run_free_bound(const BoundJob& job, const Progress& progress);

/// bound.json (docs/schema/bound.md), and a few lines for people.
[[nodiscard]] std::string free_bound_json(const FreeBound& result);
[[nodiscard]] std::string free_bound_text(const FreeBound& result);
/// bound.json and bound.txt into the folder, which is made if there is none. Throws InputError, also for what the job reads.
void write_free_bound(const FreeBound& result, const std::string& folder);

}  // namespace flank::internal
