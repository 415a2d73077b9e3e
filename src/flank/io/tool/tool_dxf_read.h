/// The profile of a tool in a DXF, and the tool of such a profile.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flank/tool.h"

namespace flank::internal {

/// Points (z, rho) of the profile in a DXF: the polyline on layer FLANK, else the only polyline in the file (POLYLINE
/// or LWPOLYLINE, ASCII, straight segments, millimetres). Throws InputError naming file and line.
[[nodiscard]] std::vector<Vec2> profile_from_dxf(std::string_view text, const std::string& file);

inline constexpr int kDxfCoefficients = 48;

/// The tool of such a profile (radial_from_meridian; kDxfCoefficients or as many as the points allow). `axis_length` as
/// there. Throws InputError.
[[nodiscard]] Tool tool_from_dxf(std::string_view text, const std::string& file,
                                 std::optional<double> axis_length = {});

}  // namespace flank::internal
