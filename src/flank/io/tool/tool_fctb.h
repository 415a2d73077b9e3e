/// tool.fctb (docs/schema/fctb.md): a tool bit of FreeCAD's Path workbench.
#pragma once

#include <string>

#include "flank/tool.h"

namespace flank::internal {

/// How far a shape of FreeCAD's may be from the tool to count as the tool itself, mm.
inline constexpr double kFctbExactMm = 1e-4;

/// The whole file, of version 2. FreeCAD has a few shapes only: it is the ball end where that is the tool, else the one
/// of ball end, end mill and truncated cone (chamfer) that encloses the cutting part with the least volume, and `note`
/// says so. Lowest point at z = 0 there. Throws InputError for a radial function that is not legitimate.
[[nodiscard]] std::string tool_to_fctb(const Tool& tool);

}  // namespace flank::internal
