/// What a strip leaves, as surfaces for other programs: the envelope of the tool's flank, and the ruled surface of its axis.
#pragma once

#include <string>
#include <vector>

#include "flank/bspline_surface.h"
#include "flank/envelope/true_stretch.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"

namespace flank::internal {

/// Parameters of both surfaces run over [0, 1] x [0, 1]: of the axis u from the first pose to the last in equal steps of t, v from
/// s = 0 to s = L; of the envelope over `stretch` of that.
struct StripSurface {
  std::string name;  ///< "strip 1"
  Stretch
      stretch;  ///< of the strip, whose envelope is true; of no area where none was found: then there is no envelope
  BSplineSurface envelope;  ///< through contact points, degree 5 by 5
  BSplineSurface axis;      ///< through axis points, degree 5 by 1
  /// Largest distance found, mm, between the surfaces and the exact points of the same parameters, at kFittedPlaces places
  /// of every knot interval, a direction. Of an envelope at most strip_surface_limit.
  double envelope_deviation_mm = 0.0, axis_deviation_mm = 0.0;
  bool towards_tool = true;  ///< (S_u x S_v) of the envelope points to the side that the tool is on
  [[nodiscard]] bool has_envelope() const { return stretch.area() > 0.0; }
  /// "strip 4", or "strip 4, 12.5 to 100 % of its way, s 0 to 20.1 mm".
  [[nodiscard]] std::string title(double axis_length) const;
};

/// How near a strip's surfaces are brought to the exact ones, mm.
inline constexpr double kStripSurfaceMm = 1e-3;
/// How far an envelope may be from what the strip leaves, mm: a surface that is farther is not written.
[[nodiscard]] double strip_surface_limit(double tolerance_mm);

/// The envelope is that of the largest stretch, in time and along the axis, on which it is what the strip leaves: there is a contact,
/// no other pose of the strip takes it away, and a spline comes near enough.
[[nodiscard]] StripSurface strip_surface(const StripMotion& strip, const RadialFunction& radial, double tolerance_mm);

/// A sentence for every strip whose envelope is not written, or in part.
void note_strip_surfaces(const std::vector<StripSurface>& strips, double axis_length, std::vector<std::string>& notes);

}  // namespace flank::internal
