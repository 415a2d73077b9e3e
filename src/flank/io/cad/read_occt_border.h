/// How well the border of a face fits its surface and itself. Private to io: no Open CASCADE type leaves this folder.
#pragma once

#include <TopoDS_Face.hxx>

namespace flank::internal {

/// The most that the parts of a face's border, or its curves in space and in the surface's parameters, are apart, mm; 0 where that is no
/// more than programs leave. Asked at the ends of every edge, and between them wherever a control point that went astray would show:
/// one of the parts is not what was meant then, and the kernel made something of both.
[[nodiscard]] double border_gap(const TopoDS_Face& face);

/// How many edges of the border have no curve in the surface's parameters; on a plane the kernel makes one of the curve in space. It drops
/// a curve that it cannot read and says nothing.
[[nodiscard]] int border_without_curves(const TopoDS_Face& face);

/// By which factor a weight of a curve of the border stands out of those beside it (stray_curve_weight); 0 if none does. In space or in the
/// surface's parameters: what a border that is thin by itself moves by then may be less than programs leave.
[[nodiscard]] double border_stray_weight(const TopoDS_Face& face);

}  // namespace flank::internal
