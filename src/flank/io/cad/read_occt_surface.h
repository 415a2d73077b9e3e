/// Open CASCADE surfaces and curves as clamped B-splines. Private to io: no Open CASCADE type leaves this folder.
#pragma once

#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <string>
#include <vector>

#include "flank/bspline_curve.h"
#include "flank/bspline_surface.h"

namespace flank::internal {

/// How a parameter of the file's surface becomes the parameter of the B-spline that is exactly the same surface.
/// Circular sections become rational arcs, whose parameter is not the angle: on an arc of half angle h about its middle
/// m,
///   t = m + h tan((angle - m) / 2) / tan(h / 2)
/// (standard rational quadratic, Piegl and Tiller 7.3). Empty breaks: the parameters are the same.
struct ParameterMap {
  std::vector<double> breaks;  ///< the angles where the arcs join, ascending
  [[nodiscard]] bool identity() const { return breaks.empty(); }
  [[nodiscard]] double value(double t) const;
  [[nodiscard]] double derivative(double t) const;
};

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
