/// Open CASCADE trims as loops of 2D B-splines. Private to io: no Open CASCADE type leaves this folder.
#pragma once

#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <optional>
#include <string>
#include <vector>

#include "flank/face.h"
#include "flank/io/cad/read_occt_surface.h"

namespace flank::internal {

/// The largest distance in mm between a converted trim and the file's own trim on the surface.
inline constexpr double kTrimConversionErrorMm = 1e-7;
/// Trims closer than this to the border of the parameter rectangle count as lying on it.
inline constexpr double kBorderMm = 1e-5;

/// The rule by which trims follow the surface: parameters of the file -> parameters of the B-spline surface, and what
/// one unit of either parameter is at most in mm.
struct TrimFrame {
  ParameterMap map_u, map_v;
  double mm_per_u = 1.0, mm_per_v = 1.0;

  [[nodiscard]] Eigen::Vector2d map(const Eigen::Vector2d& q) const { return {map_u.value(q.x()), map_v.value(q.y())}; }
  [[nodiscard]] double length_mm(const Eigen::Vector2d& d) const {
    return Eigen::Vector2d(d.x() * mm_per_u, d.y() * mm_per_v).norm();
  }
};

/// The trim of one edge on `face`, running as the edge is oriented. Exact (or within kTrimConversionErrorMm where a
/// surface parameter is mapped). Empty where the edge has no trim on this surface.
[[nodiscard]] std::optional<BSplineCurve2> convert_edge(const TopoDS_Edge& edge, const TopoDS_Face& face,
                                                        const TrimFrame& frame);

/// The frame for a converted surface.
[[nodiscard]] TrimFrame trim_frame(const BSplineSurface& surface, ParameterMap map_u, ParameterMap map_v);

/// The loop of one wire of `face` (oriented forward), edges end to start; a gap that the file leaves is closed by a
/// straight edge. Exact (or within kTrimConversionErrorMm where a surface parameter is mapped). Empty where an edge has
/// no trim on this surface.
[[nodiscard]] std::optional<TrimLoop> convert_wire(const TopoDS_Wire& wire, const TopoDS_Face& face,
                                                   const TrimFrame& frame);

/// Throws InputError, beginning with `name`, unless the loop's numbers are finite, its weights > 0, and no control point is
/// farther beyond the surface's parameters than these are long: a surface goes on past its end by its last polynomial,
/// which means nothing far away.
void require_usable_trim(const TrimLoop& loop, const BSplineSurface& surface, const std::string& name);

/// True if the loop runs once around the parameter rectangle of `surface`, within kBorderMm.
[[nodiscard]] bool is_natural_border(const TrimLoop& loop, const BSplineSurface& surface, const TrimFrame& frame);

}  // namespace flank::internal
