#include "flank/pipeline/cavity_judge.h"

#include <memory>
#include <utility>

#include "flank/base/stopping.h"
#include "flank/pipeline/judge/judge_job.h"
#include "flank/results/view.h"

namespace flank::internal {

PlanJudge::PlanJudge(const Setup& setup, const ClearanceScene& scene, const TrochoidJob& job,
                     std::function<void(const CavityPlan&, Result&)> take, Stopwatch& watch)
    : setup_(setup), scene_(scene), job_(job), take_(std::move(take)), watch_(watch) {}

ProgramStock PlanJudge::replayed(const CavityPlan& plan, const Result& result) const {
  constexpr double kMostTriangles = 3e5;
  return judge_stock(setup_, job_, result.tool, result.path, plan.program.blank, kMostTriangles);
}

std::optional<CavityFinding> PlanJudge::find(const CavityPlan& plan) {
  watch_.lap("cycles");
  Result result;
  result.job = job_;
  take_(plan, result);
  try {
    Known known;
    known.report = result.verify = judged(setup_, scene_, result, watch_);
    // What misses by its figures is not replayed.
    if (result.acceptance().pass()) {
      known.stock = replayed(plan, result);
      result.verify.stock = known.stock->report;
      watch_.lap("stock");
    }
    const CavityFinding finding{result.acceptance().pass(), known.report.coverage_reachable,
                                static_cast<int>(known_.size()) + 1};
    known_.emplace(finding.number, std::move(known));
    return finding;
  } catch (const Stopped&) {
    return {};
  }
}

void PlanJudge::finish(const CavityPlan& plan, Result& result) const {
  Known known;
  const bool judged_before = plan.finding && plan.finding->number > 0;
  if (judged_before) known = known_.at(plan.finding->number);
  judge_result(setup_, scene_, {}, result, watch_,
               judged_before ? std::optional<VerifyReport>(known.report) : std::nullopt);
  if (result.path.strips.empty() || !result.complete) return;
  try {
    if (!known.stock) known.stock = replayed(plan, result);
  } catch (const Stopped&) {
    result.complete = false;
    return;
  }
  result.verify.stock = std::move(known.stock->report);
  auto drawings = std::make_shared<Result::Drawings>(*result.drawings);
  drawings->blank = plan.program.blank;
  drawings->left = std::move(known.stock->left);
  drawings->engagement = std::move(known.stock->engagement);
  drawings->arcs = std::move(known.stock->arcs);
  result.drawings = std::move(drawings);
  watch_.lap("stock");
}

}  // namespace flank::internal
