#include "flank/io/kernel/occt_space_curve.h"

#include <GCPnts_AbscissaPoint.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <gp_Vec.hxx>

namespace flank::internal {

SpaceCurve::SpaceCurve(const Handle(Geom_Curve) & curve, double first, double last)
    : curve_(curve), first_(first), last_(last), places_(places_on<Geom_BSplineCurve>(curve, first, last)) {
  for (const double t : places_) points_.push_back(curve->Value(t));
}

double SpaceCurve::distance(const gp_Pnt& p, double enough) const {
  constexpr int kSteps = 5;
  const auto nearest = std::min_element(points_.begin(), points_.end(), [&](const gp_Pnt& a, const gp_Pnt& b) {
    return a.SquareDistance(p) < b.SquareDistance(p);
  });
  double best = nearest->Distance(p), t = places_[static_cast<std::size_t>(nearest - points_.begin())];
  for (int i = 0; i < kSteps && best > enough; ++i) {
    gp_Pnt c;
    gp_Vec d;
    curve_->D1(t, c, d);
    best = std::min(best, c.Distance(p));
    if (!(d.SquareMagnitude() > 0.0)) break;
    t = std::clamp(t + gp_Vec(c, p).Dot(d) / d.SquareMagnitude(), first_, last_);
  }
  return best;
}

double SpaceCurve::length() const {
  constexpr double kTolerance = 1e-3;
  return GCPnts_AbscissaPoint::Length(GeomAdaptor_Curve(curve_, first_, last_), kTolerance);
}

}  // namespace flank::internal
