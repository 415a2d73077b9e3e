/// tool.dxf (docs/schema/dxf.md): half profile, centreline and dimensions for the tool grinder, as ASCII DXF of AutoCAD R12.
#pragma once

#include <string>

#include "flank/tool.h"

namespace flank::internal {

/// How far the polyline of the flank may be from the meridian, mm.
inline constexpr double kDxfChordMm = 1e-4;
/// How far its arcs may be, mm.
inline constexpr double kDxfArcsMm = 1e-3;

/// The whole file: x along the axis (s = 0 at x = 0, holder towards +x), y the radius; millimetres. Layers FLANK
/// (polyline), TIP (arc of the sphere of s = 0), SHANK and HOLDER (polylines), CENTRELINE (a line of line type CENTER),
/// TEXT (length, radii, tip, hollow arcs, shank), TITLE (name, overall length without the holder, blank, units), DIMENSION
/// (linear dimensions: of flank, axis, whole tool, shank and holder the lengths, of both ends of the flank, shank and
/// holder the diameters, and the flank's largest radius).
/// The flank is a polyline of arcs and lines without corners, within kDxfArcsMm of the meridian; without `arcs` a polygon
/// within kDxfChordMm.
[[nodiscard]] std::string tool_to_dxf(const Tool& tool, bool arcs = true);

}  // namespace flank::internal
