/// The judge of the plans of a cavity's search: what it finds of the one that is taken is kept for the result.
#pragma once

#include <map>
#include <optional>

#include "flank/pipeline/cavity/cavity_search.h"
#include "flank/pipeline/finish.h"
#include "flank/run.h"
#include "flank/setup/clearance_scene.h"
#include "flank/verify/program_stock.h"

namespace flank::internal {

class PlanJudge {
 public:
  /// All must outlive it. `take`: puts tool, path and figures of a plan into a result.
  PlanJudge(const Setup& setup, const ClearanceScene& scene, const TrochoidJob& job,
            std::function<void(const CavityPlan&, Result&)> take, Stopwatch& watch);

  /// See CavityJudge.
  [[nodiscard]] std::optional<CavityFinding> find(const CavityPlan& plan);

  /// The verdict and what is drawn, of a result that has been given this plan.
  void finish(const CavityPlan& plan, Result& result) const;

 private:
  struct Known {
    VerifyReport report;
    std::optional<ProgramStock> stock;
  };
  [[nodiscard]] ProgramStock replayed(const CavityPlan& plan, const Result& result) const;

  const Setup& setup_;
  const ClearanceScene& scene_;
  const TrochoidJob& job_;
  std::function<void(const CavityPlan&, Result&)> take_;
  Stopwatch& watch_;
  std::map<int, Known> known_;  ///< by CavityFinding::number
};

}  // namespace flank::internal
