/// What `flank fit` and the side fit of `flank trochoid` have in common: what they refuse, the tool that they return and what
/// they tell of the fit.
#pragma once

#include "flank/fit.h"
#include "flank/run.h"
#include "flank/tool_request/tool_spec.h"

namespace flank::internal {

/// Throws UsageError for a largest radius that is not above the least.
void check_radius(const RadiusRequest& radius);

/// Whether the tool will have anything above its flank: what is asked for, or what a given tool has of its own.
[[nodiscard]] bool has_body(const ToolSpec& spec, const ObstacleRequest& obstacles);

/// The given tool, or the radial function that was `found` under a name of its own; with the shank and the holder that are
/// asked for.
[[nodiscard]] Tool found_tool(const ToolSpec& spec, const RadialFunction& found, const ObstacleRequest& obstacles);

/// The figures of a fit and of its steps.
[[nodiscard]] FitSummary fit_summary(const FlankFitResult& fit);

/// The tools that were tried for a fit, by the planner's estimate. `reachable_share`: of the target's area, which that
/// estimate leaves out where the job avoids other faces.
[[nodiscard]] std::vector<StiffnessStep> stiffness_steps(const FlankFitResult& fit, const FitJob& job,
                                                         double reachable_share);
/// What the judge found of a tool.
[[nodiscard]] StiffnessStep judged_step(const RejectedTool& tool, const VerifyReport& verify);

/// What the estimate, a share of the target, should have promised beyond the demand, where the judge proves a little less than that
/// to be covered, finds nothing else, and a strip more may do it; 0: that is not what is wrong.
[[nodiscard]] double spare_needed(const FitJob& job, const VerifyReport& verify, double estimate);

}  // namespace flank::internal
