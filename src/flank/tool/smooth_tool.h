/// A free spline that is no tool somewhere, made one by as little as that takes.
#pragma once

#include <optional>

#include "flank/tool.h"

namespace flank::internal {

/// The spline, smoothed where it breaks a condition of check_legitimacy until it breaks none. None if a radius would change
/// by more than `most_mm`, or if the function is no spline.
[[nodiscard]] std::optional<RadialFunction> smoothed_to_tool(const RadialFunction& radial, double most_mm);

}  // namespace flank::internal
