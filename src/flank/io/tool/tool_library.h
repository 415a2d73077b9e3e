/// Tools and holders of other programs: FreeCAD's tool bits and holders, and tool libraries of Fusion.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "flank/io/text/json_input.h"
#include "flank/io/tool/tool_outline.h"

namespace flank::internal {

/// A tool bit of FreeCAD 0.20 (shape by file) or 1.x (shape by type, too): end mill, ball end, bull nose, chamfer, V-bit and tapered
/// ball nose. Sizes with their units (mm, cm, in, degrees, rad). Throws InputError that names what is missing, or the
/// shape that does not cut with its flank.
[[nodiscard]] ToolReading tool_from_fctb(std::string_view text, const std::string& file);

/// A tool of a library of Fusion, or a single one of it: flat, ball and bull nose end mills, tapered and chamfer mills, with shaft
/// and holder. `which`: description, product number or tool number; empty: the only one. Throws InputError that lists
/// what there is.
[[nodiscard]] ToolReading tool_from_fusion(const JsonInput& document, const std::string& which,
                                           const std::string& file);

/// Does the document look like one of Fusion's?
[[nodiscard]] bool is_fusion(const JsonInput& document);

/// A holder as (height above the face out of which the tool comes, radius): FreeCAD's .fcholder (pairs of radius and height,
/// mm), or a holder of a library of Fusion. Points on the axis at the lower end are left out. Throws InputError.
[[nodiscard]] std::vector<Vec2> holder_from_fcholder(std::string_view text, const std::string& file);
[[nodiscard]] std::vector<Vec2> holder_from_fusion(const JsonInput& document, const std::string& which,
                                                   const std::string& file);

}  // namespace flank::internal
