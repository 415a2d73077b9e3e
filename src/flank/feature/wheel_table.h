/// The roles of a wheel's faces as text.
#pragma once

#include <string>

#include "flank/feature/recognise_wheel.h"

namespace flank::internal {

/// For people, one line a blade; and wheel.json, schema "openflank/wheel/1" (docs/schema/wheel.md).
[[nodiscard]] std::string wheel_table(const WheelRoles& roles);
[[nodiscard]] std::string wheel_json(const WheelRoles& roles);

}  // namespace flank::internal
