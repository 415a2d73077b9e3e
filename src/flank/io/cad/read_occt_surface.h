/// Open CASCADE surfaces and curves as clamped B-splines. Private to io: no Open CASCADE type leaves this folder.
#pragma once

#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <string>
#include <vector>

#include "flank/bspline_curve.h"
#include "flank/io/cad/read_occt_face.h"

namespace flank::internal {

/// The part of a surface over [u0, u1] x [v0, v1] of its own parameters.
struct ParameterWindow {
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
};

struct ConvertedSurface {
  BSplineSurface surface;
  ParameterMap map_u, map_v;
  double approximation_mm = 0.0;  ///< 0: exact; else the bound of the approximation (offset surfaces and the like)
};

struct ConvertedCurve {
  BSplineCurve3 curve;
  ParameterMap map;
};

[[nodiscard]] std::string surface_type(const Handle(Geom_Surface) & surface);

/// Exact where the surface has an exact form (all elementary, swept, Bezier and B-spline surfaces), else approximated
/// with the same parameters. Periodic surfaces are cut at u0, v0. Throws Standard_Failure.
[[nodiscard]] ConvertedSurface convert_surface(const Handle(Geom_Surface) & surface, const ParameterWindow& box);

/// The part of a curve over [a, b] of its own parameter; periodic curves are cut at a. Throws Standard_Failure.
[[nodiscard]] ConvertedCurve convert_curve(const Handle(Geom_Curve) & curve, double a, double b);

}  // namespace flank::internal
