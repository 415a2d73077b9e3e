/// Which lines of a drawing are the outline of a tool, and where its axis, tip, flank and shank are.
#pragma once

#include <string>
#include <vector>

#include "flank/io/tool/dxf_curves.h"
#include "flank/io/tool/tool_outline.h"

namespace flank::internal {

/// The outline of a tool in a drawing of any origin, direction and side (docs/schema/dxf.md):
///   axis    a line of line type CENTER or on a layer that is called so; else the x axis, or the y axis if the drawing is
///           longer along that and keeps to one side of it
///   half    what lies on the side of the axis with more of the drawing
///   chain   layer FLANK (with SHANK and HOLDER), else the longest chain of lines and arcs that meet
///   tip     the end with a ball about the axis, else the thinner end of an outline that reaches the axis, else towards -x
///   flank   from the ball, flat or corner radius of the tip to the first corner; the shank is above it
/// Throws InputError that begins with `file`.
[[nodiscard]] ToolOutline outline_of_drawing(const std::vector<DxfCurve>& curves, const std::string& file);

/// A holder's outline in such a drawing, (height, radius) from its lowest end, which is the thinner one.
[[nodiscard]] std::vector<Vec2> holder_of_drawing(const std::vector<DxfCurve>& curves, const std::string& file);

}  // namespace flank::internal
