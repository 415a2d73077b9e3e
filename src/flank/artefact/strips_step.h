/// strips.step (docs/schema/step.md): what every strip leaves, for other programs.
#pragma once

#include <string>
#include <vector>

#include "flank/envelope/strip_surface.h"

namespace flank::internal {

/// The objects "strip 1", ... and then "strip 1 axis", ..., each of one face.
[[nodiscard]] std::string strips_to_step(const std::vector<StripSurface>& strips);

}  // namespace flank::internal
