/// What fit and cover do alike once they have motions: strips of a path, the verdict, what is drawn.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "flank/envelope/strip_surface.h"
#include "flank/run.h"
#include "flank/setup/clearance_scene.h"
#include "flank/setup/targets.h"

namespace flank::internal {

/// Wall time of one stage after another, into result.seconds; of a stage that comes again the sum.
class Stopwatch {
 public:
  explicit Stopwatch(Result& result) : result_(result) {}
  void lap(const std::string& stage);

 private:
  Result& result_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Samples result.motions (groups[m]: what motion m machines) as strips of the path, each cut to the time in which it
/// machines, and returns their surfaces. result.tool must be there, and the path empty.
[[nodiscard]] std::vector<StripSurface> add_strips(double tolerance_mm, const std::vector<const TargetGroup*>& groups,
                                                   Result& result);

/// Judges tool and path of the result and measures clearances. result.job must be there. Throws Stopped.
[[nodiscard]] VerifyReport judged(const Setup& setup, const ClearanceScene& scene, const Result& result,
                                  Stopwatch& watch);

/// The same into result.verify, unless `known` has it, and makes what is drawn.
void judge_result(const Setup& setup, const ClearanceScene& scene, std::vector<StripSurface> surfaces, Result& result,
                  Stopwatch& watch, std::optional<VerifyReport> known = {});

}  // namespace flank::internal
