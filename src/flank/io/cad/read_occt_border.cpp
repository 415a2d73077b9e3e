#include "flank/io/cad/read_occt_border.h"

#include <BRep_Tool.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "flank/vec.h"

namespace flank::internal {
namespace {

/// What the parts of a border may be apart, mm and of its size: programs leave hundredths.
constexpr double kGapMm = 0.05, kGapShare = 1e-3;
/// Along an edge it may be so many times as much: programs let its two curves run at different paces. One that runs there and back is
/// damaged.
constexpr double kAlong = 10.0;

/// How far the curve of an edge ends from the vertices of the edge.
double gap_at_ends(const TopoDS_Edge& edge) {
  double first = 0.0, last = 0.0, gap = 0.0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  if (curve.IsNull()) return gap;
  for (const auto& [t, vertex] :
       {std::pair(first, TopExp::FirstVertex(edge)), std::pair(last, TopExp::LastVertex(edge))})
    if (!vertex.IsNull() && !Precision::IsInfinite(t))
      gap = std::max(gap, curve->Value(t).Distance(BRep_Tool::Pnt(vertex)));
  return gap;
}

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
  SpaceCurve(const Handle(Geom_Curve) & curve, double first, double last)
      : curve_(curve), first_(first), last_(last), places_(places_on<Geom_BSplineCurve>(curve, first, last)) {
    for (const double t : places_) points_.push_back(curve->Value(t));
  }
  [[nodiscard]] const std::vector<double>& places() const { return places_; }

  /// From the nearest of the points by the method of Gauss and Newton; any distance that is no more than `enough` if there is one.
  [[nodiscard]] double distance(const gp_Pnt& p, double enough) const {
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

 private:
  Handle(Geom_Curve) curve_;
  double first_, last_;
  std::vector<double> places_;
  std::vector<gp_Pnt> points_;
};

/// How far a point is from the place of a curve that has its parameter; 0 where that is no more than `most`.
double gap_at(const Geom_Curve& curve, double t, const gp_Pnt& p, double most) {
  gp_Pnt c;
  gp_Vec d;
  curve.D1(t, c, d);
  const gp_Vec off(c, p);
  if (off.Magnitude() <= most) return 0.0;
  const double along = d.SquareMagnitude() > 0.0 ? std::abs(off.Dot(d)) / d.Magnitude() : 0.0;
  const double across = std::sqrt(std::max(0.0, off.SquareMagnitude() - along * along));
  return across > most || along > kAlong * most ? off.Magnitude() : 0.0;
}

/// How far the curve of an edge in space is from its curve in the parameters of the face; 0 where no more than `most`.
double gap_along(const TopoDS_Edge& edge, const TopoDS_Face& face, double most) {
  double first = 0.0, last = 0.0, on_first = 0.0, on_last = 0.0, gap = 0.0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  const Handle(Geom2d_Curve) on_face = BRep_Tool::CurveOnSurface(edge, face, on_first, on_last);
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  if (curve.IsNull() || on_face.IsNull() || surface.IsNull()) return gap;
  for (const double t : {first, last, on_first, on_last})
    if (Precision::IsInfinite(t)) return gap;
  const bool same = BRep_Tool::SameParameter(edge) && BRep_Tool::SameRange(edge);
  const SpaceCurve in_space(curve, first, last);
  const auto look = [&](double t) {
    const gp_Pnt2d at = on_face->Value(t);
    const gp_Pnt p = surface->Value(at.X(), at.Y());
    gap = std::max(gap, same ? gap_at(*curve, t, p, most) : in_space.distance(p, most));
  };
  std::vector<double> places = places_on<Geom2d_BSplineCurve>(on_face, on_first, on_last);
  if (same) places.insert(places.end(), in_space.places().begin(), in_space.places().end());
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  for (const double t : places) look(t);
  return gap;
}

}  // namespace

double border_gap(const TopoDS_Face& face) {
  double gap = 0.0;
  Box3 size;
  for (TopExp_Explorer it(face, TopAbs_VERTEX); it.More(); it.Next()) {
    const gp_Pnt p = BRep_Tool::Pnt(TopoDS::Vertex(it.Current()));
    size.add(Vec3(p.X(), p.Y(), p.Z()));
    gap = std::max(gap, BRep_Tool::Tolerance(TopoDS::Vertex(it.Current())));
  }
  const double most = std::max(kGapMm, kGapShare * size.diagonal());
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(it.Current());
    gap = std::max({gap, BRep_Tool::Tolerance(edge), gap_at_ends(edge), gap_along(edge, face, most)});
  }
  return gap > most ? gap : 0.0;
}

}  // namespace flank::internal
