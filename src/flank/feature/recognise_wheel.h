/// Recognition of a wheel: from the faces of a part to their roles (docs/wheel.md).
#pragma once

#include "flank/feature/wheel_roles.h"

namespace flank::internal {

/// Throws InputError for what is no wheel, with what is missing, and UsageError for faces that the part does not have.
[[nodiscard]] WheelRoles recognise_wheel(const Part& part, const WheelChoice& choice = {});

}  // namespace flank::internal
