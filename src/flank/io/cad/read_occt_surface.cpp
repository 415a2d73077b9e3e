#include "flank/io/cad/read_occt_surface.h"

#include <GeomAdaptor_Surface.hxx>
#include <GeomConvert.hxx>
#include <GeomConvert_ApproxCurve.hxx>
#include <GeomConvert_ApproxSurface.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Line.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Standard_Failure.hxx>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "flank/geom/spline_segment.h"

namespace flank::internal {
namespace {

constexpr double kApproximationMm = 1e-6;  ///< asked of surfaces and curves that have no exact B-spline form
/// A rational quadratic holds less than half a turn; a quarter keeps its parameter close to the angle.
constexpr double kLargestArc = 0.5 * std::numbers::pi;

Vec3 vec(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }

/// Every knot as often as it counts.
std::vector<double> flat_knots(const TColStd_Array1OfReal& values, const TColStd_Array1OfInteger& multiplicities) {
  std::vector<double> knots;
  for (int i = values.Lower(); i <= values.Upper(); ++i)
    knots.insert(knots.end(), static_cast<std::size_t>(multiplicities(i)), values(i));
  return knots;
}

/// The piece over [a, b] of a spline; `period` > 0: of a closed one, whose piece may lie periods away or across the
/// seam.
SplineRows piece(SplineRows rows, double a, double b, double period) {
  if (period <= 0.0) return spline_segment(std::move(rows), a, b);
  // Onto the period that the spline's own knots cover: a trim may state its parameters in any.
  // Just before the seam is meant as the seam: hence the half of a billionth.
  const double shift = std::floor((a - rows.first()) / period + 5e-10) * period;
  a -= shift;
  b = std::min(b - shift, a + period);
  // The library leaves the knots of a spline that was periodic as they were: not clamped.
  if (b > rows.last() + 1e-9 * period) {
    const double first = rows.first(), last = rows.last();
    rows = two_turns(spline_segment(std::move(rows), first, last), period);
  }
  rows = spline_segment(std::move(rows), a, b);
  // Back to where the face has its trims.
  for (double& knot : rows.knots) knot += shift;
  return rows;
}

/// A surface with equal weights is polynomial, which is cheaper to evaluate.
void drop_equal_weights(std::vector<double>& weights) {
  const auto [low, high] = std::minmax_element(weights.begin(), weights.end());
  if (weights.empty() || *high - *low <= 1e-14 * *high) weights.clear();
}

/// Knots are inserted into homogeneous control points: only these are splines.
Eigen::Vector4d homogeneous(const gp_Pnt& p, double weight) {
  return {weight * p.X(), weight * p.Y(), weight * p.Z(), weight};
}

/// Exact: cut at a and b by inserting knots.
BSplineCurve3 convert_spline(Handle(Geom_BSplineCurve) c, double a, double b) {
  const double period = c->IsPeriodic() ? c->Period() : 0.0;
  if (c->IsPeriodic()) {
    // A copy: the curve belongs to the shape, and other faces share it.
    c = Handle(Geom_BSplineCurve)::DownCast(c->Copy());
    c->SetNotPeriodic();
  }
  SplineRows rows{c->Degree(), flat_knots(c->Knots(), c->Multiplicities()), Eigen::MatrixXd(4, c->NbPoles())};
  for (int i = 0; i < c->NbPoles(); ++i) rows.poles.col(i) = homogeneous(c->Pole(i + 1), c->Weight(i + 1));
  rows = piece(std::move(rows), a, b, period);
  BSplineCurve3 r;
  r.degree = rows.degree;
  r.knots = std::move(rows.knots);
  r.poles = rows.poles.topRows<3>().array().rowwise() / rows.poles.row(3).array();
  for (const double w : rows.poles.row(3)) r.weights.push_back(w);
  drop_equal_weights(r.weights);
  return r;
}

/// Angles from a to b at most kLargestArc apart.
std::vector<double> arc_breaks(double a, double b) {
  // The slack keeps exactly a quarter turn from becoming two arcs.
  const int arcs = std::max(1, static_cast<int>(std::ceil((b - a) / kLargestArc - 1e-9)));
  std::vector<double> breaks;
  for (int i = 0; i <= arcs; ++i) breaks.push_back(i == arcs ? b : a + (b - a) * i / arcs);
  return breaks;
}

/// Knots of quadratic arcs that meet with a common tangent.
std::vector<double> arc_knots(const std::vector<double>& breaks) {
  std::vector<double> knots(3, breaks.front());
  // Twice in degree 2: the arcs meet in their common end, each with its own weights.
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i) knots.insert(knots.end(), 2, breaks[i]);
  knots.insert(knots.end(), 3, breaks.back());
  return knots;
}

/// The points that control the arcs between `breaks` of the conic centre + cos x + sin y: ends of arcs with weight 1,
/// and between them the meeting point of the tangents with weight cos(half angle).
struct ArcPole {
  double cosine, sine, weight;
};

std::vector<ArcPole> arc_poles(const std::vector<double>& breaks) {
  std::vector<ArcPole> poles{{std::cos(breaks[0]), std::sin(breaks[0]), 1.0}};
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    // The tangents at both ends meet at 1 / cos(half angle) along the middle direction; with that cosine as its
    // weight the arc is the conic's.
    const double middle = 0.5 * (breaks[i] + breaks[i + 1]), weight = std::cos(0.5 * (breaks[i + 1] - breaks[i]));
    poles.push_back({std::cos(middle) / weight, std::sin(middle) / weight, weight});
    poles.push_back({std::cos(breaks[i + 1]), std::sin(breaks[i + 1]), 1.0});
  }
  return poles;
}

/// centre + cos t x + sin t y, t in [a, b]. The parameter of the spline is not the angle; the map says how they relate.
ConvertedCurve convert_conic(const Vec3& center, const Vec3& x, const Vec3& y, double a, double b) {
  ConvertedCurve r;
  r.map.breaks = arc_breaks(a, b);
  r.curve.degree = 2;
  r.curve.knots = arc_knots(r.map.breaks);
  const std::vector<ArcPole> poles = arc_poles(r.map.breaks);
  r.curve.poles.resize(3, static_cast<Eigen::Index>(poles.size()));
  for (std::size_t i = 0; i < poles.size(); ++i) {
    r.curve.poles.col(static_cast<Eigen::Index>(i)) = center + poles[i].cosine * x + poles[i].sine * y;
    r.curve.weights.push_back(poles[i].weight);
  }
  return r;
}

/// The straight line from p to q over [a, b].
BSplineCurve3 segment(const Vec3& p, const Vec3& q, double a, double b) {
  BSplineCurve3 c;
  c.degree = 1;
  c.knots = {a, a, b, b};
  c.poles.resize(3, 2);
  c.poles << p, q;
  return c;
}

/// Control points with one column for each u and the four coordinates of each v below one another, or the two swapped.
SplineRows transposed(const SplineRows& rows, int degree, std::vector<double> knots) {
  SplineRows other{degree, std::move(knots), Eigen::MatrixXd(4 * rows.poles.cols(), rows.poles.rows() / 4)};
  for (Eigen::Index i = 0; i < rows.poles.cols(); ++i)
    for (Eigen::Index j = 0; j < rows.poles.rows() / 4; ++j)
      other.poles.block<4, 1>(4 * i, j) = rows.poles.block<4, 1>(4 * j, i);
  return other;
}

/// Exact, first along u, then along v on the swapped rows.
ConvertedSurface convert_spline(Handle(Geom_BSplineSurface) s, const ParameterWindow& box) {
  const double period_u = s->IsUPeriodic() ? s->UPeriod() : 0.0, period_v = s->IsVPeriodic() ? s->VPeriod() : 0.0;
  s = Handle(Geom_BSplineSurface)::DownCast(s->Copy());
  s->SetUNotPeriodic();
  s->SetVNotPeriodic();
  // A polynomial surface that was periodic keeps weights of zero from the library: they mean nothing.
  const bool rational = s->IsURational() || s->IsVRational();
  SplineRows rows{s->UDegree(), flat_knots(s->UKnots(), s->UMultiplicities()),
                  Eigen::MatrixXd(4 * s->NbVPoles(), s->NbUPoles())};
  for (int i = 0; i < s->NbUPoles(); ++i)
    for (int j = 0; j < s->NbVPoles(); ++j)
      rows.poles.block<4, 1>(4 * j, i) = homogeneous(s->Pole(i + 1, j + 1), rational ? s->Weight(i + 1, j + 1) : 1.0);
  rows = piece(std::move(rows), box.u0, box.u1, period_u);
  ConvertedSurface r;
  r.surface.degree_u = rows.degree;
  r.surface.degree_v = s->VDegree();
  r.surface.knots_u = rows.knots;
  r.surface.count_u = static_cast<int>(rows.poles.cols());
  rows = piece(transposed(rows, s->VDegree(), flat_knots(s->VKnots(), s->VMultiplicities())), box.v0, box.v1, period_v);
  r.surface.knots_v = rows.knots;
  r.surface.count_v = static_cast<int>(rows.poles.cols());
  for (int i = 0; i < r.surface.count_u; ++i) {
    for (int j = 0; j < r.surface.count_v; ++j) {
      const Eigen::Vector4d pole = rows.poles.block<4, 1>(4 * i, j);
      r.surface.poles.emplace_back(pole.head<3>() / pole[3]);
      r.surface.weights.push_back(pole[3]);
    }
  }
  drop_equal_weights(r.surface.weights);
  return r;
}

/// Surface with u moving the points of `section` rigidly or along a line: rows of poles, one row for each pole in u.
void fill_poles(BSplineSurface& s, const BSplineCurve3& section, const std::vector<double>& row_weights,
                const std::function<Vec3(std::size_t row, const Vec3& pole)>& place) {
  s.degree_v = section.degree;
  s.knots_v = section.knots;
  s.count_v = section.count();
  s.count_u = static_cast<int>(row_weights.size());
  for (std::size_t i = 0; i < row_weights.size(); ++i) {
    for (int j = 0; j < section.count(); ++j) {
      s.poles.push_back(place(i, section.poles.col(j)));
      s.weights.push_back(row_weights[i] *
                          (section.weights.empty() ? 1.0 : section.weights[static_cast<std::size_t>(j)]));
    }
  }
  drop_equal_weights(s.weights);
}

/// Surfaces of revolution (cylinder, cone, sphere, torus, general): u is the angle about the axis from the meridian at
/// u = 0.
ConvertedSurface convert_revolution(const Handle(Geom_Surface) & surface, const gp_Ax1& axis,
                                    const ParameterWindow& box) {
  const ConvertedCurve meridian = convert_curve(surface->UIso(0.0), box.v0, box.v1);
  // The turn of the parameter u may go either way round the axis that the surface states (left-handed frames): ask the
  // surface.
  const Vec3 origin = vec(axis.Location()),
             direction = Vec3(axis.Direction().X(), axis.Direction().Y(), axis.Direction().Z());
  const auto turned = [&](const Vec3& p, double cosine, double sine, double sense) {
    const Vec3 along = direction * direction.dot(p - origin), out = p - origin - along;
    return Vec3(origin + along + cosine * out + sense * sine * direction.cross(out));
  };
  double sense = 1.0, farthest = 0.0;
  for (int k = 0; k <= 8; ++k) {
    const double v = box.v0 + (box.v1 - box.v0) * k / 8.0;
    // Asked where the meridian is farthest from the axis: on it both turns are the same point.
    const Vec3 at_zero = vec(surface->Value(0.0, v)), at_one = vec(surface->Value(1.0, v));
    if ((at_one - at_zero).norm() <= farthest) continue;
    farthest = (at_one - at_zero).norm();
    const Vec3 forward = turned(at_zero, std::cos(1.0), std::sin(1.0), 1.0),
               back = turned(at_zero, std::cos(1.0), std::sin(1.0), -1.0);
    sense = (forward - at_one).norm() <= (back - at_one).norm() ? 1.0 : -1.0;
  }
  ConvertedSurface r;
  r.map_u.breaks = arc_breaks(box.u0, box.u1);
  r.map_v = meridian.map;
  r.surface.degree_u = 2;
  r.surface.knots_u = arc_knots(r.map_u.breaks);
  const std::vector<ArcPole> arc = arc_poles(r.map_u.breaks);
  std::vector<double> weights;
  for (const ArcPole& a : arc) weights.push_back(a.weight);
  fill_poles(r.surface, meridian.curve, weights,
             [&](std::size_t i, const Vec3& p) { return turned(p, arc[i].cosine, arc[i].sine, sense); });
  return r;
}

/// Surfaces that are straight in v with the same direction and parameter everywhere (planes, extrusions): base(u) + v
/// direction.
ConvertedSurface convert_extrusion(const Handle(Geom_Surface) & surface, const ParameterWindow& box) {
  const ConvertedCurve base = convert_curve(surface->VIso(box.v0), box.u0, box.u1);
  // The same for every u, which is what makes it an extrusion.
  const Vec3 step = vec(surface->Value(box.u0, box.v1)) - vec(surface->Value(box.u0, box.v0));
  ConvertedSurface r;
  r.map_u = base.map;
  r.surface.degree_u = base.curve.degree;
  r.surface.knots_u = base.curve.knots;
  const std::vector<double> rows = base.curve.weights.empty()
                                       ? std::vector<double>(static_cast<std::size_t>(base.curve.count()), 1.0)
                                       : base.curve.weights;
  fill_poles(r.surface, segment(Vec3::Zero(), step, box.v0, box.v1), rows, [&](std::size_t i, const Vec3& p) {
    return Vec3(base.curve.poles.col(static_cast<Eigen::Index>(i)) + p);
  });
  return r;
}

/// For surfaces without an exact form (offsets and the like): the kernel's approximation, with what it says of its
/// error.
ConvertedSurface approximate(const Handle(Geom_Surface) & surface, const ParameterWindow& box) {
  const Handle(Geom_Surface) part = new Geom_RectangularTrimmedSurface(surface, box.u0, box.u1, box.v0, box.v1);
  const GeomConvert_ApproxSurface approximation(part, kApproximationMm, GeomAbs_C2, GeomAbs_C2, 9, 9, 400, 0);
  if (!approximation.HasResult()) throw Standard_Failure("the surface cannot be approximated by a B-spline");
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
  approximation.Surface()->Bounds(u0, u1, v0, v1);
  ConvertedSurface r = convert_spline(approximation.Surface(), {u0, u1, v0, v1});
  r.approximation_mm = std::max(approximation.MaxError(), kApproximationMm);
  return r;
}

}  // namespace

double ParameterMap::value(double t) const {
  if (breaks.empty()) return t;
  const auto after =
      std::clamp(std::upper_bound(breaks.begin(), breaks.end(), t), breaks.begin() + 1, breaks.end() - 1);
  const double middle = 0.5 * (*(after - 1) + *after), half = 0.5 * (*after - *(after - 1));
  // The ends of an arc keep their places; in between its parameter is linear in the tangent of half the angle from
  // the middle.
  return middle + half * std::tan(0.5 * (t - middle)) / std::tan(0.5 * half);
}

double ParameterMap::derivative(double t) const {
  if (breaks.empty()) return 1.0;
  const auto after =
      std::clamp(std::upper_bound(breaks.begin(), breaks.end(), t), breaks.begin() + 1, breaks.end() - 1);
  const double middle = 0.5 * (*(after - 1) + *after), half = 0.5 * (*after - *(after - 1));
  const double tangent = std::tan(0.5 * (t - middle));
  return 0.5 * half * (1.0 + tangent * tangent) / std::tan(0.5 * half);
}

ConvertedCurve convert_curve(const Handle(Geom_Curve) & curve, double a, double b) {
  // The limits of a trimmed curve are not needed: a and b say which part is meant.
  if (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(curve))
    return convert_curve(trimmed->BasisCurve(), a, b);
  if (const auto spline = Handle(Geom_BSplineCurve)::DownCast(curve)) return {convert_spline(spline, a, b), {}};
  if (const auto bezier = Handle(Geom_BezierCurve)::DownCast(curve))
    return {convert_spline(GeomConvert::CurveToBSplineCurve(bezier), a, b), {}};
  if (!Handle(Geom_Line)::DownCast(curve).IsNull())
    return {segment(vec(curve->Value(a)), vec(curve->Value(b)), a, b), {}};
  // Circles and ellipses: x and y are the points at 0 and at a quarter turn, whatever frame the file states. Open
  // conics go on to the approximation.
  if (const auto conic = Handle(Geom_Conic)::DownCast(curve); !conic.IsNull() && conic->IsClosed()) {
    const Vec3 center = vec(conic->Location());
    return convert_conic(center, vec(conic->Value(0.0)) - center, vec(conic->Value(kLargestArc)) - center, a, b);
  }
  const Handle(Geom_Curve) part = new Geom_TrimmedCurve(curve, a, b);
  const GeomConvert_ApproxCurve approximation(part, kApproximationMm, GeomAbs_C2, 400, 9);
  if (!approximation.HasResult()) throw Standard_Failure("a curve cannot be approximated by a B-spline");
  return {convert_spline(approximation.Curve(), a, b), {}};
}

std::string surface_type(const Handle(Geom_Surface) & surface) {
  switch (GeomAdaptor_Surface(surface).GetType()) {
    case GeomAbs_Plane:
      return "plane";
    case GeomAbs_Cylinder:
      return "cylinder";
    case GeomAbs_Cone:
      return "cone";
    case GeomAbs_Sphere:
      return "sphere";
    case GeomAbs_Torus:
      return "torus";
    case GeomAbs_BezierSurface:
      return "Bezier";
    case GeomAbs_BSplineSurface:
      return "B-spline";
    case GeomAbs_SurfaceOfRevolution:
      return "revolution";
    case GeomAbs_SurfaceOfExtrusion:
      return "extrusion";
    case GeomAbs_OffsetSurface:
      return "offset";
    default:
      return "other";
  }
}

ConvertedSurface convert_surface(const Handle(Geom_Surface) & surface, const ParameterWindow& box) {
  if (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface))
    return convert_surface(trimmed->BasisSurface(), box);
  if (const auto spline = Handle(Geom_BSplineSurface)::DownCast(surface)) return convert_spline(spline, box);
  if (const auto bezier = Handle(Geom_BezierSurface)::DownCast(surface))
    return convert_spline(GeomConvert::SurfaceToBSplineSurface(bezier), box);
  const GeomAdaptor_Surface adaptor(surface);
  switch (adaptor.GetType()) {
    case GeomAbs_Plane:
    case GeomAbs_SurfaceOfExtrusion:
      return convert_extrusion(surface, box);
    case GeomAbs_Cylinder:
      return convert_revolution(surface, adaptor.Cylinder().Axis(), box);
    case GeomAbs_Cone:
      return convert_revolution(surface, adaptor.Cone().Axis(), box);
    case GeomAbs_Sphere:
      return convert_revolution(surface, adaptor.Sphere().Position().Axis(), box);
    case GeomAbs_Torus:
      return convert_revolution(surface, adaptor.Torus().Axis(), box);
    case GeomAbs_SurfaceOfRevolution:
      return convert_revolution(surface, adaptor.AxeOfRevolution(), box);
    default:
      return approximate(surface, box);
  }
}

}  // namespace flank::internal
