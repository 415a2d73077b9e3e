/// Exact envelopes as B-spline faces.
#pragma once

#include "flank/face.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"

namespace flank::internal {

struct EnvelopeFace {
  Face face;              ///< u = t, v = s / L; S_u x S_v towards the axis
  double error_mm = 0.0;  ///< largest |S(u, v) - contact point(t = u, s = v L)| on a grid 3 times denser
  double diagonal_mm = 0.0;
};

/// Envelope (contact side +1) as a surface of degree 5 that interpolates exact contact points; the grid grows in t and
/// in s until the error is below relative_accuracy times the diagonal. Motion and radial function must be smooth (one
/// polynomial piece) for that to be reached with a modest grid. Throws InternalError if the envelope does not exist
/// somewhere or 300 points a direction are not enough.
[[nodiscard]] EnvelopeFace envelope_face(const RuledMotion& motion, const RadialFunction& radial,
                                         double relative_accuracy);

/// The surface with a bump of height `height_mm` along its normal S_u x S_v (negative: away from the axis): the largest
/// in the middle of the parameter rectangle, falling as (1 - d^2)^4 to nothing at d = 1, d the distance from the middle
/// in units of 0.4 of the parameter range. Degree 5 through a grid of 81 x 61 points.
[[nodiscard]] BSplineSurface with_bump(const BSplineSurface& surface, double height_mm);

}  // namespace flank::internal
