/// A program judged as its machine runs it.
#pragma once

#include "flank/run.h"

namespace flank::internal {

/// `flank verify --nc`: part, tool and faces from a folder, or as they are given. Nothing is written. A joint beyond its
/// travel, or driven faster than it can be, is a reason not to pass. Throws UsageError and InputError.
[[nodiscard]] Verification judge_program(const VerifyJob& request);

}  // namespace flank::internal
