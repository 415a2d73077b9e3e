#include "flank/trochoid/cycle_state.h"

#include "flank/motion/motion_record.h"

namespace flank::internal {
namespace {

void code(StepCodec& codec, Trial& trial) {
  codec.finite(trial.from_x);
  codec.finite(trial.to_x);
  code(codec, trial.back);
  code(codec, trial.front);
  for (double* value : {&trial.largest_rad, &trial.volume_mm3, &trial.way_mm}) codec.number(*value);
}

}  // namespace

void code(StepCodec& codec, LeastRejectedStep& step) {
  codec.finite(step.step_mm);
  codec.finite(step.largest_rad);
}

void code(StepCodec& codec, CycleState& state) {
  code(codec, state.last);
  for (double* share : state.shape.shares()) codec.finite(*share);
  for (double& span : state.span) codec.finite(span);
  code(codec, state.rest);
  code(codec, state.turn);
  code(codec, state.improved);
  code(codec, state.short_rest);
  for (double* value : {&state.excess_rad, &state.step_mm, &state.shape.lift_mm, &state.largest_front_mm3})
    codec.finite(*value);
  code(codec, state.sweeps);
  code(codec, state.refused);
}

}  // namespace flank::internal
