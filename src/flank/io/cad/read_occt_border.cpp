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
#include <TopTools_MapOfOrientedShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "flank/geom/stray_pole.h"
#include "flank/io/kernel/occt_space_curve.h"
#include "flank/vec.h"

namespace flank::internal {
namespace {

/// What the parts of a border may be apart, mm and of its size: programs leave hundredths.
constexpr double kGapMm = 0.05, kGapShare = 1e-3;
/// Along an edge it may be so many times as much: programs let its two curves run at different paces. One that runs there and back is
/// damaged.
constexpr double kAlong = 10.0;

/// The farthest that a bounded curve goes from where it begins, at a few places.
double reach_of(const Geom_Curve& curve, double first, double last) {
  constexpr int kPlaces = 8;
  double reach = 0.0;
  for (int k = 1; k <= kPlaces; ++k)
    reach = std::max(reach, curve.Value(first + (last - first) * k / kPlaces).Distance(curve.Value(first)));
  return reach;
}

/// How far the curve of an edge ends from the vertices of the edge, or a vertex of the edge from both ends. Where an edge begins and
/// does not end, all of it is in doubt.
double gap_at_ends(const TopoDS_Edge& edge) {
  double first = 0.0, last = 0.0, gap = 0.0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  if (curve.IsNull()) return gap;
  const TopoDS_Vertex from = TopExp::FirstVertex(edge), to = TopExp::LastVertex(edge);
  for (const auto& [t, vertex] : {std::pair(first, from), std::pair(last, to)})
    if (!vertex.IsNull() && !Precision::IsInfinite(t))
      gap = std::max(gap, curve->Value(t).Distance(BRep_Tool::Pnt(vertex)));
  if (Precision::IsInfinite(first) || Precision::IsInfinite(last)) return gap;
  if (from.IsNull() != to.IsNull()) gap = std::max(gap, reach_of(*curve, first, last));
  // Of two vertices that begin an edge the kernel takes the first.
  const gp_Pnt begin = curve->Value(first), end = curve->Value(last);
  for (TopExp_Explorer it(edge, TopAbs_VERTEX); it.More(); it.Next()) {
    if (it.Current().Orientation() == TopAbs_INTERNAL) continue;
    const gp_Pnt p = BRep_Tool::Pnt(TopoDS::Vertex(it.Current()));
    gap = std::max(gap, std::min(p.Distance(begin), p.Distance(end)));
  }
  return gap;
}

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

/// Empty for a curve that has none, or is no spline.
template <class Spline>
std::vector<double> weights_of(const Handle(Spline) & spline) {
  std::vector<double> weights;
  for (int i = 1; !spline.IsNull() && spline->IsRational() && i <= spline->NbPoles(); ++i)
    weights.push_back(spline->Weight(i));
  return weights;
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
  TopTools_MapOfOrientedShape seen;
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(it.Current());
    gap = std::max({gap, BRep_Tool::Tolerance(edge), gap_at_ends(edge), gap_along(edge, face, most)});
    // Along a seam a border runs both ways; along an edge the same way twice it does not close.
    if (!seen.Add(edge)) gap = std::max(gap, size.diagonal());
  }
  return gap > most ? gap : 0.0;
}

int border_without_curves(const TopoDS_Face& face) {
  int lost = 0;
  double first = 0.0, last = 0.0;
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next())
    lost += BRep_Tool::CurveOnSurface(TopoDS::Edge(it.Current()), face, first, last).IsNull() ? 1 : 0;
  return lost;
}

double border_stray_weight(const TopoDS_Face& face) {
  double worst = 0.0, first = 0.0, last = 0.0;
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(it.Current());
    const auto in_space = Handle(Geom_BSplineCurve)::DownCast(BRep_Tool::Curve(edge, first, last));
    const auto on_face = Handle(Geom2d_BSplineCurve)::DownCast(BRep_Tool::CurveOnSurface(edge, face, first, last));
    worst = std::max({worst, stray_curve_weight(weights_of(in_space)), stray_curve_weight(weights_of(on_face))});
  }
  return worst;
}

}  // namespace flank::internal
