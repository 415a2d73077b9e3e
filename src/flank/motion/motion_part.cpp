#include "flank/motion/motion_part.h"

#include <utility>

#include "flank/geom/spline_segment.h"

namespace flank::internal {

RuledMotion motion_part(const RuledMotion& motion, double first, double last) {
  RuledMotion out = motion;
  for (BSplineCurve3* rail : {&out.tip, &out.direction}) {
    SplineRows rows = spline_segment({rail->degree, rail->knots, rail->poles}, first, last);
    for (double& knot : rows.knots) knot = (knot - first) / (last - first);
    rail->knots = std::move(rows.knots);
    rail->poles = rows.poles;
  }
  return out;
}

}  // namespace flank::internal
