#include "flank/correct/aimed_result.h"

#include <utility>
#include <variant>

#include "flank/pipeline/finish.h"
#include "flank/pipeline/run_journal.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/tool_body.h"

namespace flank::internal {
namespace {

/// How it went, as a fit or a cover says it.
void add_summary(const TargetGroup& group, const AimedMotions& aimed, Result& result) {
  const PlannedShare share{result.verify.coverage, result.verify.overcut_mm};
  if (std::holds_alternative<FitJob>(result.job)) {
    FitSummary summary;
    summary.candidates = 1;
    summary.after = share;
    summary.rms_mm = aimed.rms_mm;
    summary.largest_mm = aimed.largest_mm;
    summary.inside_share = 1.0;
    result.plan = std::move(summary);
    return;
  }
  TargetCover cover;
  cover.faces = group.faces;
  cover.area_mm2 = group.target->area();
  cover.strips = cover.grown = static_cast<int>(result.motions.size());
  cover.reachable = result.verify.reachable_share;
  cover.after = result.verify.coverage_reachable;
  cover.overcut_mm = share.overcut_mm;
  CoverSummary summary;
  summary.targets.push_back(std::move(cover));
  result.plan = std::move(summary);
}

}  // namespace

Result aimed_result(const PlanJob& job, const Tool& tool, AimedMotions aimed) {
  Result result;
  result.job = job;
  result.inputs = input_stamps(job);
  result.tool = tool;
  result.motions = aimed.motions;
  Stopwatch watch(result);
  const auto judge = [&](auto& plan) {
    const Setup setup = read_setup(plan.part, plan.obstacles, plan.tolerance_mm, result.notes);
    result.part_sha256 = setup.part.sha256;
    const std::vector<TargetGroup> groups = make_targets(setup);
    result.diagonal_mm = groups.front().target->diagonal();
    const ClearanceScene scene = make_clearance_scene(setup, plan.obstacles, has_body(tool), result.notes);
    std::vector<StripSurface> surfaces =
        add_strips(setup.tolerance_mm, std::vector<const TargetGroup*>(result.motions.size(), &groups.front()), result);
    judge_result(setup, scene, std::move(surfaces), result, watch);
    add_summary(groups.front(), aimed, result);
  };
  if (auto* fit = std::get_if<FitJob>(&result.job)) judge(*fit);
  if (auto* cover = std::get_if<CoverJob>(&result.job)) judge(*cover);
  return result;
}

}  // namespace flank::internal
