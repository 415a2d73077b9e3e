/// The tools of the examples.
#pragma once

#include <array>
#include <string_view>

#include "flank/tool.h"

namespace flank::internal {

inline constexpr std::array<std::string_view, 4> kExampleTools = {"barrel", "hyperbolic", "cone", "spline"};

/// 36 to 50 mm long, radii 3 to 9 mm. The spline has one polynomial piece (S-shaped, in no other family), so that it
/// lies in the space of every free-spline fit, whatever its knots. Throws InternalError for a name that is not in
/// kExampleTools.
[[nodiscard]] Tool example_tool(std::string_view name);

}  // namespace flank::internal
