/// A whole wheel from one part: roles, operations, copies and one verdict (docs/wheel.md).
#pragma once

#include <string>

#include "flank/progress.h"
#include "flank/wheel_request.h"

namespace flank {

/// Plans, writes and judges it; the text of plan.json (docs/schema/wheel.md). Throws UsageError for what cannot be asked, and InputError
/// for a part that is no wheel, saying what is missing;
/// Stopped where progress says so: the finished operations lie in the folder.
[[nodiscard]] std::string mill_wheel(const WheelRequest& request, const Progress& progress = {});

}  // namespace flank
