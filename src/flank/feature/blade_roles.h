/// What each face is on its blade: side, edge, tip or root fillet.
#pragma once

#include <vector>

#include "flank/feature/blade_faces.h"
#include "flank/feature/wheel_roles.h"

namespace flank::internal {

/// What each face is on its blade.
[[nodiscard]] WheelBlade blade_roles(const BladeFaces& blade, const std::vector<const WheelFace*>& hub,
                                     const WheelAxis& axis, double size_mm);

}  // namespace flank::internal
