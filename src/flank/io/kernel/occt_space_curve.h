/// A curve of the CAD kernel in space and the distances of points from it. Private to io: no Open CASCADE type leaves this folder and io/cad.
#pragma once

#include <Geom_BSplineCurve.hxx>
#include <Geom_Curve.hxx>
#include <algorithm>
#include <gp_Pnt.hxx>
#include <vector>

namespace flank::internal {

/// Adds the knots in ]first, last[ and what is in the middle of each span: a control point moves the curve most near one of these.
template <class Spline>
void add_knots(const Handle(Spline) & spline, double first, double last, std::vector<double>& places) {
  if (spline.IsNull()) return;
  double before = first;
  for (int i = 1; i <= spline->NbKnots(); ++i) {
    const double knot = std::min(spline->Knot(i), last);
    if (knot <= before) continue;
    places.push_back(0.5 * (before + knot));
    places.push_back(knot);
    before = knot;
  }
}

/// Parameters at which a curve over [first, last] is looked at.
template <class Spline, class Curve>
std::vector<double> places_on(const Curve& curve, double first, double last) {
  constexpr int kPlaces = 8;
  std::vector<double> places;
  for (int k = 0; k <= kPlaces; ++k) places.push_back(first + (last - first) * k / kPlaces);
  add_knots(Handle(Spline)::DownCast(curve), first, last, places);
  return places;
}

/// The curve of an edge in space, with the points that a search on it begins at.
class SpaceCurve {
 public:
  SpaceCurve(const Handle(Geom_Curve) & curve, double first, double last);
  [[nodiscard]] const std::vector<double>& places() const { return places_; }
  /// At the places.
  [[nodiscard]] const std::vector<gp_Pnt>& points() const { return points_; }
  /// From the nearest of the points by the method of Gauss and Newton; any distance that is no more than `enough` if there is one.
  [[nodiscard]] double distance(const gp_Pnt& p, double enough) const;
  /// mm, to a thousandth of it.
  [[nodiscard]] double length() const;

 private:
  Handle(Geom_Curve) curve_;
  double first_, last_;
  std::vector<double> places_;
  std::vector<gp_Pnt> points_;
};

}  // namespace flank::internal
