/// The program of a whole wheel, judged as its machine runs it.
#pragma once

#include <vector>

#include "flank/machine/model/machine.h"
#include "flank/machine/nc/program.h"
#include "flank/pipeline/folder/wheel_plan.h"
#include "flank/run.h"

namespace flank::internal {

/// All operations of the plan with all of their copies: each is held against its own path and the machine; what they finish and cut together
/// is judged on the whole wheel, as the paths of the folder are. Throws UsageError and InputError; for a program that is not of these
/// operations, too.
[[nodiscard]] Verification judge_wheel_program(const VerifyJob& request, const WheelPlan& plan, const Machine& machine,
                                               const std::vector<NcProgram>& operations);

}  // namespace flank::internal
