/// How an operation is done: once, timed, and not again where an earlier run has done it.
#pragma once

#include <functional>
#include <string>

#include "flank/wheel/wheel_work.h"

namespace flank::internal {

/// A file in the wheel's folder.
[[nodiscard]] std::string in_folder(const WheelWork& work, const std::string& name);
/// tools/T1.json, absolute.
[[nodiscard]] std::string tool_file(const WheelWork& work, const std::string& tool = "T1");

/// Makes the operation's result, unless a finished one of the same key lies in its folder. `make` throws, or gives a result.
[[nodiscard]] WheelOperation perform(const WheelWork& work, WheelOperation operation, const std::string& decides,
                                     const std::function<Result()>& make);

/// Whether a reason is the lack of a proof, and nothing that was found.
[[nodiscard]] bool is_proof(const Shortfall& reason);

/// Whether a result is what its operation was to do, and else why not.
void settle(const Result& result, WheelOperation& operation);

/// Strips of an operation that is done go into the finishing path.
void take(WheelWork& work, const WheelOperation& operation);

}  // namespace flank::internal
