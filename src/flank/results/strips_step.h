/// strips.step (docs/schema/step.md): what every strip leaves, for other programs.
#pragma once

#include <string>
#include <vector>

#include "flank/envelope/strip_surface.h"

namespace flank::internal {

/// The objects "strip 1", ... (StripSurface::title; those that have an envelope) and then "strip 1 axis", ..., each of one face. The
/// title in the header names the strips that are left out.
[[nodiscard]] std::string strips_to_step(const std::vector<StripSurface>& strips, double axis_length);

}  // namespace flank::internal
