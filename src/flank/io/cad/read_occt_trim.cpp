#include "flank/io/cad/read_occt_trim.h"

#include <fmt/format.h>

#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <GeomLib.hxx>
#include <Precision.hxx>
#include <ShapeFix_Edge.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <gp.hxx>
#include <limits>
#include <utility>

#include "flank/error.h"
#include "flank/geom/trim.h"

namespace flank::internal {
namespace {

constexpr double kSnapMm = 1e-9;  ///< ends of trims closer than this become the same point
constexpr double kOrderGapMm =
    1e-3;  ///< a larger gap in the order of the file makes the edges be ordered by their ends
/// Halvings of one smooth piece of a trim at most: a bound for curves that the mapping makes singular.
constexpr int kMostHalvings = 14;

using Point2 = Eigen::Vector2d;

bool all_finite(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

Point2 start(const BSplineCurve2& c) { return c.poles.col(0); }
Point2 end(const BSplineCurve2& c) { return c.poles.col(c.poles.cols() - 1); }

/// The same points in the opposite direction, over the same range of the parameter.
BSplineCurve2 reversed(const BSplineCurve2& c) {
  BSplineCurve2 r = c;
  const double sum = c.knots.front() + c.knots.back();
  for (std::size_t i = 0; i < c.knots.size(); ++i) r.knots[i] = sum - c.knots[c.knots.size() - 1 - i];
  r.poles = c.poles.rowwise().reverse();
  std::reverse(r.weights.begin(), r.weights.end());
  return r;
}

/// As a curve in space: one conversion for both, and the library's own cutting of periodic splines in the plane goes
/// wrong.
BSplineCurve2 exact(const Handle(Geom2d_Curve) & curve, double first, double last) {
  const gp_Ax2 plane(gp::Origin(), gp::DZ(), gp::DX());
  const BSplineCurve3 lifted = convert_curve(GeomLib::To3d(plane, curve), first, last).curve;
  BSplineCurve2 c;
  c.degree = lifted.degree;
  c.knots = lifted.knots;
  c.poles = lifted.poles.topRows<2>();
  c.weights = lifted.weights;
  return c;
}

/// A node of the cubic Hermite spline that follows a trim through the parameter maps.
struct Node {
  double t;
  Point2 p, d;
};

Node node(const Geom2dAdaptor_Curve& curve, const TrimFrame& frame, double t) {
  gp_Pnt2d p;
  gp_Vec2d d;
  curve.D1(t, p, d);
  return {t, frame.map({p.X(), p.Y()}), {d.X() * frame.map_u.derivative(p.X()), d.Y() * frame.map_v.derivative(p.Y())}};
}

/// The cubic between two nodes, at share x of the way.
Point2 hermite(const Node& a, const Node& b, double x) {
  const double h = b.t - a.t, y = 1.0 - x;
  return (1.0 + 2.0 * x) * y * y * a.p + x * y * y * h * a.d + x * x * (3.0 - 2.0 * x) * b.p - x * x * y * h * b.d;
}

/// Largest distance of the cubic from the mapped trim at three places, mm on the surface.
double hermite_error(const Geom2dAdaptor_Curve& curve, const TrimFrame& frame, const Node& a, const Node& b) {
  double error = 0.0;
  for (const double x : {0.25, 0.5, 0.75}) {
    const gp_Pnt2d p = curve.Value(a.t + x * (b.t - a.t));
    error = std::max(error, frame.length_mm(frame.map({p.X(), p.Y()}) - hermite(a, b, x)));
  }
  return error;
}

/// Appends nodes up to b, halving until half of the promised error holds: it is measured at three places only.
void refine(const Geom2dAdaptor_Curve& curve, const TrimFrame& frame, const Node& b, int halvings,
            std::vector<Node>& nodes) {
  const Node a = nodes.back();
  if (halvings > 0 && hermite_error(curve, frame, a, b) > 0.5 * kTrimConversionErrorMm) {
    refine(curve, frame, node(curve, frame, 0.5 * (a.t + b.t)), halvings - 1, nodes);
    refine(curve, frame, b, halvings - 1, nodes);
    return;
  }
  nodes.push_back(b);
}

/// Cubic with double knots through the nodes and their derivatives.
BSplineCurve2 hermite_spline(const std::vector<Node>& nodes) {
  BSplineCurve2 c;
  c.degree = 3;
  c.poles.resize(2, static_cast<Eigen::Index>(2 * nodes.size()));
  c.knots.assign(4, nodes.front().t);
  Eigen::Index k = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double before = i == 0 ? 0.0 : nodes[i].t - nodes[i - 1].t;
    const double after = i + 1 == nodes.size() ? 0.0 : nodes[i + 1].t - nodes[i].t;
    if (i == 0) c.poles.col(k++) = nodes[i].p;
    if (i > 0) c.poles.col(k++) = nodes[i].p - before / 3.0 * nodes[i].d;
    if (i + 1 < nodes.size()) c.poles.col(k++) = nodes[i].p + after / 3.0 * nodes[i].d;
    if (i + 1 == nodes.size()) c.poles.col(k++) = nodes[i].p;
    if (i > 0 && i + 1 < nodes.size()) c.knots.insert(c.knots.end(), 2, nodes[i].t);
  }
  c.knots.insert(c.knots.end(), 4, nodes.back().t);
  return c;
}

/// A trim of a face whose parameters had to be mapped (arcs as rational splines): the map is not polynomial, so the
/// trim is approximated. Lines along a parameter direction stay lines.
BSplineCurve2 mapped(const Handle(Geom2d_Curve) & curve, double first, double last, const TrimFrame& frame) {
  const Geom2dAdaptor_Curve adaptor(curve, first, last);
  const gp_Pnt2d p = adaptor.Value(first), q = adaptor.Value(last);
  const bool straight = adaptor.GetType() == GeomAbs_Line;
  if (straight &&
      (std::abs(q.X() - p.X()) * frame.mm_per_u < kSnapMm || std::abs(q.Y() - p.Y()) * frame.mm_per_v < kSnapMm))
    return straight_edge(frame.map({p.X(), p.Y()}), frame.map({q.X(), q.Y()}));
  // Kinks of the file's curve are ends of pieces; a cubic cannot follow them.
  TColStd_Array1OfReal breaks(1, adaptor.NbIntervals(GeomAbs_C2) + 1);
  adaptor.Intervals(breaks, GeomAbs_C2);
  std::vector<Node> nodes{node(adaptor, frame, first)};
  for (int i = breaks.Lower() + 1; i <= breaks.Upper(); ++i)
    refine(adaptor, frame, node(adaptor, frame, breaks(i)), kMostHalvings, nodes);
  return hermite_spline(nodes);
}

/// Largest distance from the end of an edge to the start of the next one, mm.
double largest_gap(const std::vector<BSplineCurve2>& edges, const TrimFrame& frame) {
  double gap = 0.0;
  for (std::size_t i = 0; i < edges.size(); ++i)
    gap = std::max(gap, frame.length_mm(start(edges[(i + 1) % edges.size()]) - end(edges[i])));
  return gap;
}

/// Orders edges so that each begins nearest to where the one before it ended.
std::vector<BSplineCurve2> chain(std::vector<BSplineCurve2> edges, const TrimFrame& frame) {
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const auto nearer = [&](const BSplineCurve2& a, const BSplineCurve2& b) {
      return frame.length_mm(start(a) - end(edges[i])) < frame.length_mm(start(b) - end(edges[i]));
    };
    const auto first = edges.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    std::iter_swap(first, std::min_element(first, edges.end(), nearer));
  }
  return edges;
}

/// Ends that nearly meet are made equal, wider gaps are closed by a straight line.
TrimLoop closed(const std::vector<BSplineCurve2>& edges, const TrimFrame& frame) {
  TrimLoop loop;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    loop.edges.push_back(edges[i]);
    const Point2 from = end(edges[i]), to = start(edges[(i + 1) % edges.size()]);
    if (frame.length_mm(to - from) > kSnapMm)
      loop.edges.push_back(straight_edge(from, to));
    else
      loop.edges.back().poles.col(loop.edges.back().poles.cols() - 1) = to;
  }
  return loop;
}

}  // namespace

// The derivatives' largest length over a grid: what one unit of a parameter is at most, near enough for tolerances.
TrimFrame trim_frame(const BSplineSurface& s, ParameterMap map_u, ParameterMap map_v) {
  constexpr int kGrid = 8;
  TrimFrame frame{std::move(map_u), std::move(map_v), 0.0, 0.0};
  for (int i = 0; i <= kGrid; ++i) {
    for (int j = 0; j <= kGrid; ++j) {
      const SurfaceJet jet = s.jet(s.u_first() + (s.u_last() - s.u_first()) * i / kGrid,
                                   s.v_first() + (s.v_last() - s.v_first()) * j / kGrid);
      frame.mm_per_u = std::max(frame.mm_per_u, jet.du.norm());
      frame.mm_per_v = std::max(frame.mm_per_v, jet.dv.norm());
    }
  }
  return frame;
}

std::optional<BSplineCurve2> convert_edge(const TopoDS_Edge& edge, const TopoDS_Face& face, const TrimFrame& frame) {
  double first = 0.0, last = 0.0;
  Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
  // IGES and BREP files may lack curves in the parameter plane: the kernel projects the edge.
  if (curve.IsNull() && ShapeFix_Edge().FixAddPCurve(edge, face, false))
    curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
  if (curve.IsNull() || !(last > first)) return std::nullopt;
  const bool same = frame.map_u.identity() && frame.map_v.identity();
  const BSplineCurve2 c = same ? exact(curve, first, last) : mapped(curve, first, last, frame);
  return edge.Orientation() == TopAbs_REVERSED ? reversed(c) : c;
}

std::optional<TrimLoop> convert_wire(const TopoDS_Wire& wire, const TopoDS_Face& face, const TrimFrame& frame) {
  std::vector<TopoDS_Edge> ordered, all;
  for (BRepTools_WireExplorer it(wire, face); it.More(); it.Next()) ordered.push_back(it.Current());
  for (TopExp_Explorer it(wire, TopAbs_EDGE); it.More(); it.Next()) all.push_back(TopoDS::Edge(it.Current()));
  const auto convert = [&](const std::vector<TopoDS_Edge>& edges) {
    std::vector<BSplineCurve2> curves;
    for (const TopoDS_Edge& edge : edges) {
      const std::optional<BSplineCurve2> curve = convert_edge(edge, face, frame);
      if (curve) curves.push_back(*curve);
    }
    return curves;
  };
  std::vector<BSplineCurve2> curves = convert(ordered);
  // The explorer stops at the first gap that is wider than the edges' tolerances. Whatever closes better counts.
  if (ordered.size() != all.size() || largest_gap(curves, frame) > kOrderGapMm) {
    std::vector<BSplineCurve2> other = chain(convert(all), frame);
    if (other.size() > curves.size() || largest_gap(other, frame) < largest_gap(curves, frame))
      curves = std::move(other);
  }
  if (curves.empty() || curves.size() < all.size()) return std::nullopt;
  return closed(curves, frame);
}

bool is_natural_border(const TrimLoop& loop, const BSplineSurface& surface, const TrimFrame& frame) {
  const Point2 low(surface.u_first(), surface.v_first()), high(surface.u_last(), surface.v_last());
  double twice_area = 0.0;
  for (const BSplineCurve2& edge : loop.edges) {
    const int steps = 4 * edge.count();
    Point2 before = start(edge);
    for (int i = 1; i <= steps; ++i) {
      const Point2 p = edge.value(edge.first() + (edge.last() - edge.first()) * i / steps);
      const double off_u = std::min(std::abs(p.x() - low.x()), std::abs(p.x() - high.x())) * frame.mm_per_u;
      const double off_v = std::min(std::abs(p.y() - low.y()), std::abs(p.y() - high.y())) * frame.mm_per_v;
      if (std::min(off_u, off_v) > kBorderMm) return false;
      twice_area += (before.x() - low.x()) * (p.y() - low.y()) - (p.x() - low.x()) * (before.y() - low.y());
      before = p;
    }
  }
  const double rectangle = (high - low).prod();
  return std::abs(std::abs(0.5 * twice_area) - rectangle) <= 1e-3 * rectangle;
}

void require_usable_trim(const TrimLoop& loop, const BSplineSurface& s, const std::string& name) {
  const Vec2 low(s.u_first(), s.v_first()), high(s.u_last(), s.v_last()), range = high - low;
  for (const BSplineCurve2& edge : loop.edges) {
    if (!edge.poles.allFinite() || !all_finite(edge.knots) || !all_finite(edge.weights))
      throw InputError(name + ": one of its trims has control points or knots that are not finite");
    if (edge.poles.cols() == 0 || !(edge.last() > edge.first()))
      throw InputError(name + ": the knots of one of its trims do not rise");
    if (std::any_of(edge.weights.begin(), edge.weights.end(), [](double w) { return !(w > 0.0); }))
      throw InputError(name + ": a weight of one of its trims is not > 0");
    // Points and not control points: those of a flat arc stand off twice as far as the arc, which is all of the range.
    const int steps = 4 * edge.count();
    for (int i = 0; i <= steps; ++i) {
      const Vec2 p = edge.value(edge.first() + (edge.last() - edge.first()) * i / steps);
      if ((p.array() >= (low - range).array()).all() && (p.array() <= (high + range).array()).all()) continue;
      throw InputError(
          fmt::format("{}: one of its trims reaches the parameters ({}, {}), far outside those of its surface, {} to "
                      "{} and {} to {}",
                      name, p.x(), p.y(), low.x(), high.x(), low.y(), high.y()));
    }
  }
}

}  // namespace flank::internal
