#include "flank/pipeline/fit_shank.h"

#include <fmt/format.h>

#include <algorithm>

#include "flank/base/tolerance_budget.h"
#include "flank/fit/lengthen.h"
#include "flank/pipeline/auto_shank.h"
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

/// Whether what `tried` has beyond the flank enters nothing by more than is allowed: nobody else asks.
bool added_is_clear(const ClearanceScene& scene, const RadialFunction& flank, const RadialFunction& tried,
                    const Path& path) {
  constexpr int kPieces = 16;
  const double from = flank.axis_length(), to = tried.axis_length();
  if (!(to > from)) return true;
  Tool tool;
  tool.radial = flank;
  for (int k = 0; k <= kPieces; ++k) tool.shank.push_back(meridian_point(tried, from + (to - from) * k / kPieces));
  ClearanceOptions options = scene.options;
  options.required_mm = -1.0;
  return flank::keeps_clear(tool, path, scene.obstacles, options);
}

}  // namespace

void choose_shank(const FitJob& job, const Setup& setup, const ClearanceScene& scene, const FitSearch& search,
                  const Tool& flank, ObstacleRequest& obstacles) {
  const Path path = sampled(search.motions_of(search.fit), search.options.tolerance_mm);
  const double slenderest = search.tool.free() ? job.radius.slenderness_max : 1e300;
  choose_clear_shank(scene, path, setup.part.box, slenderest, flank, obstacles);
}

void lift_shank(const FitJob& job, const ClearanceScene& scene, FitSearch& search, std::vector<std::string>& notes) {
  if (job.tool.axis_length_mm || (!job.obstacles.shank_length_mm && !job.obstacles.holder)) return;
  const auto clear = [&](const FlankFitResult& tried) {
    Tool tool;
    tool.radial = tried.tool;
    equip_tool(job.obstacles, tool);
    const Path path = sampled(search.motions_of(tried), *job.tolerance_mm);
    return added_is_clear(scene, search.fit.tool, tried.tool, path) && keeps_clear(scene, tool, path);
  };
  const double more = lengthen_until_clear(search.fit, std::max(1.0, job.obstacles.clearance_mm.value_or(0.0)), clear);
  if (more > 0.0)
    notes.push_back(fmt::format("the flank was lengthened by {} mm to keep shank and holder clear", more));
}

}  // namespace flank::internal
