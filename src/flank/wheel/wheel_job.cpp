#include "flank/wheel/wheel_job.h"

namespace flank::internal {

Acceptance WheelResult::acceptance() const {
  Acceptance out;
  if (whole) out = whole->acceptance();
  WheelPlan plan;
  plan.left_out = roles.debris;
  for (const WheelOperation& o : operations)
    plan.steps.push_back({.id = o.id, .kind = o.kind, .folder = o.folder, .done = o.done, .problem = o.problem});
  accept_steps(plan, roughing, out);
  if (!whole) out.reasons.push_back({"complete", "no operation has a result"});
  return out;
}

}  // namespace flank::internal
