#include "flank/io/cad/write_occt_face.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "flank/error.h"

namespace flank::internal {
namespace {

/// What the kernel may assume of edges and corners; the conversion itself is exact.
constexpr double kEdgeToleranceMm = 1e-6;

/// Distinct knots and how often each occurs.
struct KnotTable {
  std::vector<double> values;
  std::vector<int> multiplicities;
};

KnotTable knot_table(const std::vector<double>& knots) {
  KnotTable table;
  for (const double k : knots) {
    if (table.values.empty() || k != table.values.back()) {
      table.values.push_back(k);
      table.multiplicities.push_back(0);
    }
    ++table.multiplicities.back();
  }
  return table;
}

// Open CASCADE's arrays count from 1 and look at memory that they are given.
TColStd_Array1OfReal reals(const std::vector<double>& v) { return {v.front(), 1, static_cast<int>(v.size())}; }
TColStd_Array1OfInteger integers(const std::vector<int>& v) { return {v.front(), 1, static_cast<int>(v.size())}; }

Handle(Geom2d_BSplineCurve) occt_curve(const BSplineCurve2& c) {
  TColgp_Array1OfPnt2d poles(1, c.count());
  TColStd_Array1OfReal weights(1, c.count());
  for (int i = 0; i < c.count(); ++i) {
    poles(i + 1) = gp_Pnt2d(c.poles(0, i), c.poles(1, i));
    weights(i + 1) = c.weights.empty() ? 1.0 : c.weights[static_cast<std::size_t>(i)];
  }
  const KnotTable knots = knot_table(c.knots);
  return new Geom2d_BSplineCurve(poles, weights, reals(knots.values), integers(knots.multiplicities), c.degree);
}

/// Whether the curve stays at one point of the surface (a pole of a sphere, the tip of a cone).
bool is_degenerate(const BSplineCurve2& c, const BSplineSurface& s) {
  constexpr int kSamples = 8;
  const auto at = [&](int i) {
    const Eigen::Vector2d q = c.value(c.first() + (c.last() - c.first()) * i / kSamples);
    return s.value(q.x(), q.y());
  };
  for (int i = 1; i <= kSamples; ++i)
    if ((at(i) - at(0)).norm() > kEdgeToleranceMm) return false;
  return true;
}

/// Edges of a loop as curves on the surface and in space. Corners are shared, or the wire would not be closed.
TopoDS_Wire occt_wire(const TrimLoop& loop, const Face& face, const Handle(Geom_BSplineSurface) & surface) {
  const BRep_Builder builder;
  std::vector<TopoDS_Vertex> corners;
  for (const BSplineCurve2& edge : loop.edges) {
    const Vec3 p = face.surface.value(edge.poles(0, 0), edge.poles(1, 0));
    corners.push_back(BRepBuilderAPI_MakeVertex(gp_Pnt(p.x(), p.y(), p.z())));
    builder.UpdateVertex(corners.back(), kEdgeToleranceMm);
  }
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (std::size_t i = 0; i < loop.edges.size(); ++i) {
    const BSplineCurve2& trim = loop.edges[i];
    // By hand: BRepBuilderAPI_MakeEdge refuses trims that leave the surface's rectangle by a rounding error.
    TopoDS_Edge edge;
    builder.MakeEdge(edge);
    builder.UpdateEdge(edge, occt_curve(trim), surface, TopLoc_Location(), kEdgeToleranceMm);
    builder.Add(edge, corners[i].Oriented(TopAbs_FORWARD));
    builder.Add(edge, corners[(i + 1) % corners.size()].Oriented(TopAbs_REVERSED));
    builder.Range(edge, trim.first(), trim.last());
    if (is_degenerate(trim, face.surface))
      builder.Degenerated(edge, true);
    else if (!BRepLib::BuildCurve3d(edge, kEdgeToleranceMm))
      throw InternalError(face.id + ": a trim cannot be written as a curve in space");
    builder.Add(wire, edge);
  }
  wire.Closed(true);
  return wire;
}

}  // namespace

Handle(Geom_BSplineSurface) occt_surface(const BSplineSurface& s) {
  TColgp_Array2OfPnt poles(1, s.count_u, 1, s.count_v);
  TColStd_Array2OfReal weights(1, s.count_u, 1, s.count_v);
  for (int i = 0; i < s.count_u; ++i) {
    for (int j = 0; j < s.count_v; ++j) {
      const Vec3& p = s.pole(i, j);
      poles(i + 1, j + 1) = gp_Pnt(p.x(), p.y(), p.z());
      weights(i + 1, j + 1) = s.weights.empty() ? 1.0 : s.weights[static_cast<std::size_t>(i * s.count_v + j)];
    }
  }
  const KnotTable u = knot_table(s.knots_u), v = knot_table(s.knots_v);
  return new Geom_BSplineSurface(poles, weights, reals(u.values), reals(v.values), integers(u.multiplicities),
                                 integers(v.multiplicities), s.degree_u, s.degree_v);
}

double signed_area(const TrimLoop& loop) {
  double twice = 0.0;
  for (const BSplineCurve2& edge : loop.edges) {
    const int steps = 8 * edge.count();
    Eigen::Vector2d before = edge.value(edge.first());
    for (int i = 1; i <= steps; ++i) {
      const Eigen::Vector2d p = edge.value(edge.first() + (edge.last() - edge.first()) * i / steps);
      twice += before.x() * p.y() - p.x() * before.y();
      before = p;
    }
  }
  return 0.5 * twice;
}

TopoDS_Face occt_face(const Face& face) {
  const Handle(Geom_BSplineSurface) surface = occt_surface(face.surface);
  if (face.loops.empty()) {
    const TopoDS_Face whole = BRepBuilderAPI_MakeFace(surface, kEdgeToleranceMm);
    return face.reversed ? TopoDS::Face(whole.Reversed()) : whole;
  }
  const BRep_Builder builder;
  TopoDS_Face result;
  builder.MakeFace(result, surface, kEdgeToleranceMm);
  std::vector<std::pair<double, const TrimLoop*>> loops;
  for (const TrimLoop& loop : face.loops) loops.emplace_back(signed_area(loop), &loop);
  std::stable_sort(loops.begin(), loops.end(),
                   [](const auto& a, const auto& b) { return std::abs(a.first) > std::abs(b.first); });
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const TopoDS_Wire wire = occt_wire(*loops[i].second, face, surface);
    // The largest loop bounds the face and runs counter-clockwise, the others are holes and run clockwise.
    const bool wanted = (i == 0) == (loops[i].first > 0.0);
    builder.Add(result, wanted ? TopoDS_Shape(wire) : wire.Reversed());
  }
  return face.reversed ? TopoDS::Face(result.Reversed()) : result;
}

}  // namespace flank::internal
