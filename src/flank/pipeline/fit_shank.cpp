#include "flank/pipeline/fit_shank.h"

#include <fmt/format.h>

#include <algorithm>

#include "flank/base/tolerance_budget.h"
#include "flank/fit/lengthen.h"
#include "flank/setup/shank_reach.h"
#include "flank/setup/tool_body.h"

namespace flank::internal {
namespace {

Path sampled(const std::vector<RuledMotion>& motions, double tolerance_mm) {
  SamplingOptions options;
  options.chord_tolerance_mm = kToleranceBudget.chord * tolerance_mm;
  Path path;
  for (const RuledMotion& motion : motions) {
    path.strips.push_back({});
    path.strips.back().poses = sample_motion(motion, options).poses;
  }
  return path;
}

}  // namespace

void choose_shank(const Setup& setup, const FitSearch& search, const Tool& flank, ObstacleRequest& obstacles) {
  const Path path = sampled(search.motions_of(search.fit), search.options.tolerance_mm);
  choose_shank(flank, path, setup.part.box, obstacles);
  obstacles.shank = "given";
}

/// Lifts a shank or holder that comes too near, if the flank's length is open (lengthen.h).
void lift_shank(const FitJob& job, const ClearanceScene& scene, FitSearch& search, std::vector<std::string>& notes) {
  if (job.tool.axis_length_mm || (!job.obstacles.shank_length_mm && !job.obstacles.holder)) return;
  const auto clear = [&](const FlankFitResult& tried) {
    Tool tool;
    tool.radial = tried.tool;
    equip_tool(job.obstacles, tool);
    return measure_clearance(scene, tool, sampled(search.motions_of(tried), *job.tolerance_mm)).kept();
  };
  const double more = lengthen_until_clear(search.fit, std::max(1.0, job.obstacles.clearance_mm.value_or(0.0)), clear);
  if (more > 0.0)
    notes.push_back(fmt::format("the flank was lengthened by {} mm to keep shank and holder clear", more));
}

}  // namespace flank::internal
