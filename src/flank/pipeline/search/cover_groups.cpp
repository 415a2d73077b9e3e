#include "flank/pipeline/search/cover_groups.h"

#include <algorithm>
#include <numbers>

#include "flank/base/tolerance_budget.h"
#include "flank/error.h"
#include "flank/setup/make_obstacles.h"

namespace flank::internal {

CoverOptions options_of(const CoverJob& job) {
  CoverOptions options;
  options.strategy = job.strategy == "curves" ? CoverStrategy::kCurves : CoverStrategy::kGrow;
  options.places = job.seeds == "shape" ? SeedPlaces::kShape : SeedPlaces::kGrid;
  options.tolerance_mm = job.tolerance_mm.value_or(options.tolerance_mm);
  options.most_turn_rad = job.judge.most_turn_deg * std::numbers::pi / 180.0;
  if (job.most_strips) options.most_strips = *job.most_strips;
  if (job.strip_price) options.strip_price = *job.strip_price;
  if (job.seed && options.strategy != CoverStrategy::kCurves) throw UsageError("seed", "needs `strategy` curves");
  if (job.seed) options.curves.seed = *job.seed;
  return options;
}

ToolExtent extent_of(const Tool& tool) {
  ToolExtent extent;
  const double length = tool.radial.axis_length();
  for (int j = 0; j <= 16; ++j)
    extent.reach_mm = std::max(extent.reach_mm, length + 2.0 * tool.radial.at(length * j / 16.0).r);
  for (const auto* profile : {&tool.shank, &tool.holder}) {
    for (const Vec2& p : *profile) extent.reach_mm = std::max(extent.reach_mm, p.x() + 2.0 * p.y());
  }
  return extent;
}

Obstacles obstacles_of(const CoverJob& job, const Setup& setup, const TargetGroup& group, const ToolExtent& extent) {
  const double tolerance_mm = *job.tolerance_mm;
  ObstacleChoice choice = choose_obstacles(group.indices, setup.targets, setup.checks);
  choice.fixtures = setup.fixtures;
  choice.clearance_mm = job.obstacles.clearance_mm;
  choice.tolerance_mm = tolerance_mm;
  choice.allowance_mm = setup.allowance_mm;
  ObstacleDetail detail;
  detail.meshes_within_mm = std::max(extent.reach_mm, setup.part.box.diagonal());
  detail.deviation_mm = std::clamp(kToleranceBudget.others.triangles * tolerance_mm, 1e-3, 0.05);
  detail.own_deviation_mm = std::clamp(kToleranceBudget.shank.triangles * tolerance_mm, 1e-3, 0.02);
  detail.own_spare_mm = kToleranceBudget.shank.spare * tolerance_mm;
  return make_obstacles(setup.part, *group.target, choice, detail);
}

}  // namespace flank::internal
