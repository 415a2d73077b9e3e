/// The lines of a drawing: what a tool's profile is put together of.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "flank/io/tool/profile_arcs.h"

namespace flank::internal {

/// One entity as lines and arcs, in mm, x and y as in the drawing.
struct DxfCurve {
  std::string entity;     ///< "LINE", "ARC", "POLYLINE", "LWPOLYLINE", "SPLINE"
  std::string layer;      ///< as written
  std::string line_type;  ///< capitals; empty: by layer
  std::vector<ProfileArc> pieces;
};

/// Every LINE, ARC, POLYLINE and LWPOLYLINE (with bulges) and SPLINE of model space. A SPLINE becomes chords between points
/// of it, kSplinePieces in each of its knot spans. Entities that were mirrored (extrusion along -z) are mirrored. Texts,
/// dimensions, points and what else draws no line is passed over. Throws InputError, naming file and line, for numbers
/// that are none, arcs of more than a half circle in a polyline, an ELLIPSE, and splines without control points.
[[nodiscard]] std::vector<DxfCurve> read_dxf_curves(std::string_view text, const std::string& file);

inline constexpr int kSplinePieces = 64;

}  // namespace flank::internal
