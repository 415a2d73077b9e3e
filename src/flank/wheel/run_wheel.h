/// `flank wheel PART`: the operations that finish a wheel, one sector computed and the others turned, and one verdict.
#pragma once

#include "flank/progress.h"
#include "flank/wheel/plan_file.h"
#include "flank/wheel_request.h"

namespace flank::internal {

/// Plans, judges and writes: plan.json, wheel.json, tools/, ops/ and, of the whole, the files of a result folder, which verify,
/// report and post take as any other. Throws UsageError and InputError.
[[nodiscard]] WheelResult run_wheel(const WheelRequest& job, const Progress& progress = {});

}  // namespace flank::internal
