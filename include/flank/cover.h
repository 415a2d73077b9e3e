/// A given tool: the strips with which it finishes a target (MATH section 8; docs/algorithms/cover.md).
///
/// What is guaranteed of a result, by the planner's own certificate (strip/certify.h):
/// - no strip enters the target or an obstacle by more than the tolerance; one that would is cut short or dropped
/// - strips stand in the order and the direction of machining
/// - the same bytes for any number of threads; a cancelled cover has fewer strips, all of them certified
///
/// Nothing is thrown for a target that cannot be covered: status and message say it. The verdict is the judge's (judge.h),
/// which shares no code with this.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "flank/cover_options.h"
#include "flank/obstacles.h"
#include "flank/progress.h"
#include "flank/ruled_motion.h"
#include "flank/target.h"
#include "flank/tool.h"

namespace flank {

enum class CoverStatus {
  kNotRun,
  kCovered,  ///< strips were found, and they cover something; how much is in `coverage`
  kNoLine,   ///< no line touches the target within the tolerance over its whole length
  kNoStrip,  ///< lines do, but none can move, or every strip would enter another face
};

struct CoverResult {
  CoverStatus status = CoverStatus::kNotRun;
  std::string message;               ///< what limits the coverage (reasons.h); empty if nothing does
  std::vector<RuledMotion> motions;  ///< one per strip, in the order and the direction of machining
  /// Area share where a ball of the tool's smallest radius enters no obstacle (MATH section 9).
  double reachable = 1.0;
  /// Area share of the reachable part that is within tolerance before smoothing, by the planner's own estimate.
  double coverage_before = 0.0;
  double coverage = 0.0;                ///< the same of `motions`; `reachable` times this is the share of the whole
  double overlap = 0.0;                 ///< sum of the strips' covered areas over that of their union, minus 1
  double overcut_mm = 0.0;              ///< largest depth of a strip in the target, by the planner's own estimate
  int seeds = 0, lines = 0, grown = 0;  ///< lines: seeds that refine to within tolerance; grown: candidates
  std::vector<std::string> notes;       ///< for the user, besides the message
  std::vector<std::pair<std::string, double>> seconds;  ///< wall time of the stages; differs from run to run
};

/// Finds the strips. The tool enters no obstacle by more than the tolerance; a strip that would is cut short or
/// dropped. Same result for any number of threads. A cover that is cancelled returns what it has, still certified.
/// Nothing is thrown for a target that cannot be covered: status and message say it.
[[nodiscard]] CoverResult cover(const Target& target, const Tool& tool, const Obstacles& obstacles,
                                const CoverOptions& options, const Progress& progress);

}  // namespace flank
