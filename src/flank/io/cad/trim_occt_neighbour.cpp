#include "flank/io/cad/trim_occt_neighbour.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Eigen/LU>
#include <Geom2dAPI_Interpolate.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TColgp_HArray1OfPnt2d.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <vector>

namespace flank::internal {
namespace {

/// Places at which a border is led over to the new surface, and places between two of them at which it is held against it.
constexpr int kBorderPoints = 120, kBetween = 4;
constexpr double kSpareTolerance = 1.02;    ///< of an edge, for what lies between the places
constexpr double kLeastToleranceMm = 1e-6;  ///< of an edge
/// A border moves by at most this much of the gap: along a neighbour that leans by less than 12 degrees it stays.
constexpr double kMostOfGap = 5.0;
constexpr int kSteps = 30;
constexpr double kMetMm = 1e-9;

Vec3 vec(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }
Vec3 vec(const gp_Vec& v) { return {v.X(), v.Y(), v.Z()}; }
gp_Pnt pnt(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

/// A place of a border: in space, on the new surface, on the neighbour.
struct Place {
  Vec3 point = Vec3::Zero();
  Vec2 on_new = Vec2::Zero(), on_other = Vec2::Zero();
};

/// A neighbour's surface with the border's trim on it.
struct Neighbour {
  TopoDS_Face face;
  Handle(Geom_Surface) surface;
  Handle(Geom2d_Curve) trim;

  Neighbour(const TopoDS_Face& other, const TopoDS_Edge& edge) : face(TopoDS::Face(other.Oriented(TopAbs_FORWARD))) {
    surface = BRep_Tool::Surface(face);
    double first = 0.0, last = 0.0;
    trim = BRep_Tool::CurveOnSurface(edge, face, first, last);
  }
  [[nodiscard]] Vec2 at(double t) const {
    const gp_Pnt2d q = trim->Value(t);
    return {q.X(), q.Y()};
  }
  /// Whether the surface has this place: it may end there.
  [[nodiscard]] bool has(const Vec2& q) const {
    double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
    surface->Bounds(u0, u1, v0, v1);
    return (surface->IsUPeriodic() || (q.x() >= u0 && q.x() <= u1)) &&
           (surface->IsVPeriodic() || (q.y() >= v0 && q.y() <= v1));
  }
};

/// Whether the surface reaches so far: past its end it means nothing.
bool has(const BSplineSurface& s, const Vec2& q) {
  return q.x() >= s.u_first() && q.x() <= s.u_last() && q.y() >= s.v_first() && q.y() <= s.v_last();
}

/// Where surface and neighbour meet near a place of the old border, in the plane through `at` across `along`, by Newton's method; none if
/// farther away than `most_mm`, or beyond the end of either.
std::optional<Place> meeting(const BSplineSurface& surface, const Neighbour& other, const Vec3& at, const Vec3& along,
                             const Place& start, double most_mm) {
  Place place = start;
  for (int step = 0; step < kSteps; ++step) {
    const SurfaceJet s = surface.jet(place.on_new.x(), place.on_new.y());
    gp_Pnt p;
    gp_Vec du, dv;
    other.surface->D1(place.on_other.x(), place.on_other.y(), p, du, dv);
    Eigen::Vector4d rest;
    rest << s.p - vec(p), (s.p - at).dot(along);
    Eigen::Matrix4d slope = Eigen::Matrix4d::Zero();
    slope.block<3, 1>(0, 0) = s.du, slope.block<3, 1>(0, 1) = s.dv;
    slope.block<3, 1>(0, 2) = -vec(du), slope.block<3, 1>(0, 3) = -vec(dv);
    slope(3, 0) = s.du.dot(along), slope(3, 1) = s.dv.dot(along);
    place.point = s.p;
    if (!((s.p - at).norm() <= most_mm)) return {};
    if (rest.norm() < kMetMm)
      return has(surface, place.on_new) && other.has(place.on_other) ? std::optional(place) : std::nullopt;
    const Eigen::Vector4d move = slope.fullPivLu().solve(rest);
    place.on_new -= move.head<2>();
    place.on_other -= move.tail<2>();
  }
  return {};
}

/// A corner of the face: an edge of neighbours runs into it, and ends at the surface.
struct Corner {
  TopoDS_Vertex vertex;
  TopoDS_Edge edge;
  double t = 0.0;  ///< of that edge
  Place place;
};

/// Where a curve meets the surface, from its end on; none if not within its range or not nearby.
std::optional<Corner> shortened(const TopoDS_Vertex& vertex, const TopoDS_Edge& edge, const NewSurface& wanted) {
  double first = 0.0, last = 0.0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  if (curve.IsNull()) return {};
  const std::optional<Vec2> start = wanted.nearest(vec(BRep_Tool::Pnt(vertex)));
  if (!start) return {};
  Corner corner{vertex, edge, BRep_Tool::Parameter(vertex, edge), {}};
  corner.place.on_new = *start;
  const Vec3 from = vec(curve->Value(corner.t));
  const double gap = (wanted.surface.value(start->x(), start->y()) - from).norm();
  for (int step = 0; step < kSteps; ++step) {
    const SurfaceJet s = wanted.surface.jet(corner.place.on_new.x(), corner.place.on_new.y());
    gp_Pnt p;
    gp_Vec d;
    curve->D1(corner.t, p, d);
    const Vec3 rest = s.p - vec(p);
    corner.place.point = vec(p);
    if (!((vec(p) - from).norm() <= kMostOfGap * gap + kMetMm)) return {};
    if (rest.norm() < kMetMm && !has(wanted.surface, corner.place.on_new)) return {};
    if (rest.norm() < kMetMm) return corner.t >= first && corner.t <= last ? std::optional(corner) : std::nullopt;
    Eigen::Matrix3d slope;
    slope << s.du, s.dv, -vec(d);
    const Vec3 move = slope.fullPivLu().solve(rest);
    corner.place.on_new -= move.head<2>();
    corner.t -= move.z();
  }
  return {};
}

/// The same edge with its range cut to this parameter at the end where the vertex is.
void cut_range(const Corner& corner) {
  const BRep_Builder builder;
  double first = 0.0, last = 0.0;
  (void)BRep_Tool::Curve(corner.edge, first, last);
  const double old = BRep_Tool::Parameter(corner.vertex, corner.edge);
  if (std::abs(old - first) < std::abs(old - last))
    builder.Range(corner.edge, corner.t, last);
  else
    builder.Range(corner.edge, first, corner.t);
  builder.UpdateVertex(corner.vertex, pnt(corner.place.point), kLeastToleranceMm);
}

/// A border as curves through its places.
struct Curves {
  Handle(Geom_BSplineCurve) space;
  Handle(Geom2d_BSplineCurve) on_new, on_other;
};

Handle(Geom2d_BSplineCurve)
    through(const std::vector<Place>& places, Vec2 Place::*which, const Handle(TColStd_HArray1OfReal) & times) {
  const Handle(TColgp_HArray1OfPnt2d) points = new TColgp_HArray1OfPnt2d(1, static_cast<int>(places.size()));
  for (int k = 0; k < points->Length(); ++k) {
    const Vec2& q = places[static_cast<std::size_t>(k)].*which;
    points->SetValue(k + 1, gp_Pnt2d(q.x(), q.y()));
  }
  Geom2dAPI_Interpolate curve(points, times, Standard_False, 1e-12);
  curve.Perform();
  return curve.IsDone() ? curve.Curve() : Handle(Geom2d_BSplineCurve)();
}

Curves curves_through(const std::vector<Place>& places, const std::vector<double>& t) {
  const int count = static_cast<int>(t.size());
  const Handle(TColStd_HArray1OfReal) times = new TColStd_HArray1OfReal(1, count);
  const Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, count);
  for (int k = 0; k < count; ++k) {
    times->SetValue(k + 1, t[static_cast<std::size_t>(k)]);
    points->SetValue(k + 1, pnt(places[static_cast<std::size_t>(k)].point));
  }
  Curves curves;
  GeomAPI_Interpolate space(points, times, Standard_False, 1e-12);
  space.Perform();
  if (space.IsDone()) curves.space = space.Curve();
  curves.on_new = through(places, &Place::on_new, times);
  curves.on_other = through(places, &Place::on_other, times);
  return curves;
}

}  // namespace

struct BorderMove::Parts {
  TopoDS_Face face;
  NewSurface wanted;
  TopTools_IndexedDataMapOfShapeListOfShape faces_of_edge;
  std::vector<Corner> corners;
  TopTools_MapOfShape staying;  ///< borders that stay where they are

  [[nodiscard]] const Corner* corner_at(const TopoDS_Vertex& vertex) const {
    const auto found = std::find_if(corners.begin(), corners.end(),
                                    [&](const Corner& corner) { return corner.vertex.IsSame(vertex); });
    return found == corners.end() ? nullptr : &*found;
  }
  [[nodiscard]] std::optional<Neighbour> neighbour(const TopoDS_Edge& edge) const;
  [[nodiscard]] bool stays(const TopoDS_Edge& edge) const;
  [[nodiscard]] std::optional<Place> place_at(const Handle(Geom_Curve) & curve, const Neighbour* other, bool stays,
                                              double t) const;
  void settle_end(const TopoDS_Vertex& vertex, const Neighbour* other, Place& place) const;
};

std::optional<Neighbour> BorderMove::Parts::neighbour(const TopoDS_Edge& edge) const {
  const int at = faces_of_edge.FindIndex(edge);
  if (at == 0) return {};
  for (const TopoDS_Shape& other : faces_of_edge(at)) {
    if (other.IsSame(face)) continue;
    Neighbour found(TopoDS::Face(other), edge);
    if (!found.trim.IsNull()) return found;
  }
  return {};
}

/// A border along which surface and neighbour do not meet nearby everywhere, or the neighbour ends before, stays whole: in part, it would
/// jump.
bool BorderMove::Parts::stays(const TopoDS_Edge& edge) const {
  double first = 0.0, last = 0.0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  const std::optional<Neighbour> other = neighbour(edge);
  if (!other) return true;
  for (int k = 0; k < kBorderPoints; ++k) {
    const double t = first + (last - first) * k / (kBorderPoints - 1);
    gp_Pnt p;
    gp_Vec along;
    curve->D1(t, p, along);
    const std::optional<Vec2> nearest = wanted.nearest(vec(p));
    if (!nearest || along.Magnitude() == 0.0) return true;
    const double gap = (wanted.surface.value(nearest->x(), nearest->y()) - vec(p)).norm();
    if (!meeting(wanted.surface, *other, vec(p), vec(along).normalized(), {vec(p), *nearest, other->at(t)},
                 kMostOfGap * gap + kLeastToleranceMm))
      return true;
  }
  return false;
}

/// A place of the border: where the surfaces meet, else where the old border is.
std::optional<Place> BorderMove::Parts::place_at(const Handle(Geom_Curve) & curve, const Neighbour* other, bool stays,
                                                 double t) const {
  gp_Pnt p;
  gp_Vec along;
  curve->D1(t, p, along);
  const std::optional<Vec2> nearest = wanted.nearest(vec(p));
  if (!nearest) return {};
  const Place old{vec(p), *nearest, other ? other->at(t) : Vec2(Vec2::Zero())};
  if (stays || other == nullptr) return old;
  const double gap = (wanted.surface.value(nearest->x(), nearest->y()) - old.point).norm();
  return meeting(wanted.surface, *other, old.point, vec(along).normalized(), old, kMostOfGap * gap + kLeastToleranceMm)
      .value_or(old);
}

void BorderMove::Parts::settle_end(const TopoDS_Vertex& vertex, const Neighbour* other, Place& place) const {
  const Corner* corner = corner_at(vertex);
  if (corner == nullptr) return;
  place.point = corner->place.point;
  place.on_new = corner->place.on_new;
  if (other == nullptr) return;
  double first = 0.0, last = 0.0;
  const Handle(Geom2d_Curve) trim = BRep_Tool::CurveOnSurface(corner->edge, other->face, first, last);
  if (trim.IsNull()) return;
  const gp_Pnt2d q = trim->Value(corner->t);
  place.on_other = {q.X(), q.Y()};
}

BorderMove::BorderMove(const TopoDS_Shape& shape, const TopoDS_Face& face, const NewSurface& wanted)
    : parts_(new Parts{face, wanted, {}, {}, {}}) {
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, parts_->faces_of_edge);
  TopTools_IndexedDataMapOfShapeListOfShape edges_of_vertex;
  TopExp::MapShapesAndUniqueAncestors(shape, TopAbs_VERTEX, TopAbs_EDGE, edges_of_vertex);
  TopTools_IndexedMapOfShape own, vertices;
  TopExp::MapShapes(face, TopAbs_EDGE, own);
  TopExp::MapShapes(face, TopAbs_VERTEX, vertices);
  for (int k = 1; k <= own.Extent(); ++k)
    if (parts_->stays(TopoDS::Edge(own(k)))) parts_->staying.Add(own(k));
  for (int k = 1; k <= vertices.Extent(); ++k) {
    const TopoDS_Vertex vertex = TopoDS::Vertex(vertices(k));
    std::vector<TopoDS_Edge> others;
    bool stays = false;
    if (const int at = edges_of_vertex.FindIndex(vertex); at != 0)
      for (const TopoDS_Shape& edge : edges_of_vertex(at)) {
        stays = stays || parts_->staying.Contains(edge);
        if (!own.Contains(edge)) others.push_back(TopoDS::Edge(edge));
      }
    std::optional<Corner> corner;
    if (!stays && others.size() == 1) corner = shortened(vertex, others.front(), wanted);
    if (corner) cut_range(*corner);
    if (corner) parts_->corners.push_back(*corner);
  }
}

BorderMove::~BorderMove() = default;

namespace {

/// Between the places, too. `space` is the border, `old` the one before; `beside` is null where it stays on the neighbour as it is.
LedBorder measured(const Curves& curves, const Handle(Geom_Curve) & space, const Handle(Geom_Curve) & old,
                   const Handle(Geom_BSplineSurface) & surface, const Neighbour* beside, const Vec2& range) {
  LedBorder led;
  for (int k = 0; k <= kBetween * (kBorderPoints - 1); ++k) {
    const double at = range.x() + (range.y() - range.x()) * k / (kBetween * (kBorderPoints - 1));
    const gp_Pnt p = space->Value(at);
    const gp_Pnt2d q = curves.on_new->Value(at), w = curves.on_other->Value(at);
    led.off_mm = std::max(led.off_mm, p.Distance(surface->Value(q.X(), q.Y())));
    if (beside != nullptr) led.off_mm = std::max(led.off_mm, p.Distance(beside->surface->Value(w.X(), w.Y())));
    led.moved_mm = std::max(led.moved_mm, p.Distance(old->Value(at)));
  }
  return led;
}

}  // namespace

std::optional<LedBorder> BorderMove::lead_over(const TopoDS_Edge& edge, const Handle(Geom_BSplineSurface) & surface) {
  double first = 0.0, last = 0.0;
  const Handle(Geom_Curve) old = BRep_Tool::Curve(edge, first, last);
  const std::optional<Neighbour> other = parts_->neighbour(edge);
  const Neighbour* const beside = other ? &*other : nullptr;
  const bool stays = parts_->staying.Contains(edge);
  std::vector<Place> places;
  std::vector<double> t;
  for (int k = 0; k < kBorderPoints; ++k) {
    t.push_back(first + (last - first) * k / (kBorderPoints - 1));
    const std::optional<Place> place = parts_->place_at(old, beside, stays, t.back());
    if (!place) return {};
    places.push_back(*place);
  }
  const TopoDS_Edge forward = TopoDS::Edge(edge.Oriented(TopAbs_FORWARD));
  parts_->settle_end(TopExp::FirstVertex(forward), beside, places.front());
  parts_->settle_end(TopExp::LastVertex(forward), beside, places.back());
  const Curves curves = curves_through(places, t);
  if (curves.space.IsNull() || curves.on_new.IsNull() || curves.on_other.IsNull()) return {};
  const LedBorder led = measured(curves, stays ? old : Handle(Geom_Curve)(curves.space), old, surface,
                                 stays ? nullptr : beside, {first, last});
  const BRep_Builder builder;
  const double tolerance = kSpareTolerance * led.off_mm + kLeastToleranceMm;
  builder.UpdateEdge(edge, curves.on_new, surface, TopLoc_Location(), tolerance);
  // Curves through places would be beside the old ones, and not on the neighbour's trim.
  if (!stays) builder.UpdateEdge(edge, curves.space, TopLoc_Location(), tolerance);
  if (!stays) builder.UpdateEdge(edge, curves.on_other, beside->face, tolerance);
  builder.Range(edge, first, last);
  // A corner that stays is as far off as the border there has moved.
  const auto reach = [&](const TopoDS_Vertex& vertex, const Place& end) {
    const double away = kSpareTolerance * (vec(BRep_Tool::Pnt(vertex)) - end.point).norm() + kLeastToleranceMm;
    builder.UpdateVertex(vertex, std::max(away, BRep_Tool::Tolerance(edge)));
  };
  reach(TopExp::FirstVertex(forward), places.front());
  reach(TopExp::LastVertex(forward), places.back());
  return led;
}

}  // namespace flank::internal
