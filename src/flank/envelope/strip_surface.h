/// What a strip leaves, as surfaces for other programs: the envelope of the tool's flank, and the ruled surface of its axis.
#pragma once

#include <string>
#include <vector>

#include "flank/bspline_surface.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"

namespace flank::internal {

/// The part of a motion that became a strip.
struct StripMotion {
  int strip = 1;  ///< its id
  RuledMotion motion;
  double from_t = 0.0, to_t = 1.0;  ///< of its first and last pose
  int side = +1;                    ///< of the contact points that machine the target (envelope.h)
};

/// Parameters of both surfaces run over [0, 1] x [0, 1]: u from the first pose to the last in equal steps of t, v from
/// s = 0 to s = L.
struct StripSurface {
  std::string name;         ///< "strip 1"
  BSplineSurface envelope;  ///< through contact points, degree 5 by 5
  BSplineSurface axis;      ///< through axis points, degree 5 by 1
  /// Largest distance found, mm, between the surfaces and the exact points of the same parameters, at kStripPlaces places
  /// of every knot interval, a direction.
  double envelope_deviation_mm = 0.0, axis_deviation_mm = 0.0;
  bool towards_tool = true;  ///< (S_u x S_v) of the envelope points to the side that the tool is on
  int plunging =
      0;  ///< points that the envelope goes through where the tool plunges (|c| >= 1): there is no contact there
};

/// How far a strip's surfaces may be from the exact ones, mm. A surface that its largest grid does not bring so near says
/// so in its deviation.
inline constexpr double kStripSurfaceMm = 1e-3;
inline constexpr int kStripPlaces = 4;
/// A direction with more control points than this is not made finer.
inline constexpr int kMostStripPoints = 400;

[[nodiscard]] StripSurface strip_surface(const StripMotion& strip, const RadialFunction& radial);

/// A sentence for every strip whose surfaces are not what they should be: plunging, or farther off than kStripSurfaceMm.
void note_strip_surfaces(const std::vector<StripSurface>& strips, std::vector<std::string>& notes);

}  // namespace flank::internal
