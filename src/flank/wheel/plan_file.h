/// plan.json: the operations of a wheel as a file, and those that an earlier run has finished.
#pragma once

#include <map>
#include <string>

#include "flank/wheel/wheel_job.h"

namespace flank::internal {

/// The operations of a plan.json that are done, by id; none where there is no such file, or one of another kind.
[[nodiscard]] std::map<std::string, WheelOperation> finished_operations(const std::string& file);

/// plan.json (docs/schema/plan.md), and a table for people.
[[nodiscard]] std::string plan_json(const WheelResult& result);
[[nodiscard]] std::string wheel_text(const WheelResult& result);

}  // namespace flank::internal
