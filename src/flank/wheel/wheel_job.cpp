#include "flank/wheel/wheel_job.h"

namespace flank::internal {

Acceptance WheelResult::acceptance() const {
  Acceptance out;
  if (whole) out = whole->acceptance();
  for (const WheelOperation& operation : operations)
    if (!operation.done)
      out.reasons.push_back(
          {"complete", "operation " + operation.id + " (" + operation.kind + ") has no result: " + operation.problem});
  if (!whole) out.reasons.push_back({"complete", "no operation has a result"});
  return out;
}

}  // namespace flank::internal
