/// The tool of a drawing.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flank/io/tool/tool_outline.h"

namespace flank::internal {

/// Points (z, rho) of the flank in a DXF (outline_of_drawing), its arcs as chords of 1e-4 mm. Throws InputError naming the
/// file, and its line where one is wrong.
[[nodiscard]] std::vector<Vec2> profile_from_dxf(std::string_view text, const std::string& file);

/// The tool of such a drawing, with shank and holder, and what must be known of how it was read. `axis_length`: as in
/// tool_from_outline. Throws InputError.
[[nodiscard]] ToolReading read_tool_drawing(std::string_view text, const std::string& file,
                                            std::optional<double> axis_length = {});

/// The tool alone.
[[nodiscard]] Tool tool_from_dxf(std::string_view text, const std::string& file,
                                 std::optional<double> axis_length = {});

}  // namespace flank::internal
