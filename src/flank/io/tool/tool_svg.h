/// Drawings of a tool's profile: SVG for a browser, characters for a terminal.
#pragma once

#include <string>

#include "flank/tool.h"

namespace flank::internal {

/// One SVG document, to scale (viewBox in millimetres): both sides of the profile with the round tip, shank, holder,
/// centreline and figures.
[[nodiscard]] std::string tool_to_svg(const Tool& tool);

/// Half profile in `columns` x `rows` characters, tip at the left, radius upwards from its least value; the factor
/// between the two scales is printed with it, and a table of a few (s, r, slope). columns >= 40, rows >= 6.
[[nodiscard]] std::string tool_to_ascii(const Tool& tool, int columns = 78, int rows = 16);

}  // namespace flank::internal
