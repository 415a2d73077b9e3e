#include "flank/io/tool/tool_step.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRep_Builder.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GProp_GProps.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <vector>

#include "flank/error.h"
#include "flank/io/cad/write_occt_products.h"
#include "flank/io/kernel/read_occt_silence.h"

namespace flank::internal {
namespace {

constexpr double kSamePointMm = 1e-7;  ///< Open CASCADE's own confusion: nearer points are one
constexpr double kStraightMm = 1e-9;   ///< a meridian that is no farther from its chord is a line
constexpr int kFirstPoints = 65, kMostPoints = 4097;

/// The half plane of the profile is y = 0, x >= 0.
gp_Pnt in_space(const Vec2& p) { return {p.y(), 0.0, p.x()}; }
gp_Vec in_space_vector(const Vec2& v) { return {v.y(), 0.0, v.x()}; }

/// One closed line of a profile, edge by edge, from the axis and back to it.
class Outline {
 public:
  explicit Outline(const Vec2& start) : at_(start), first_(vertex(start)), last_(first_) {}

  void line_to(const Vec2& p) {
    if ((p - at_).norm() <= kSamePointMm) return;
    const TopoDS_Vertex to = vertex(p);
    add(BRepBuilderAPI_MakeEdge(last_, to), p, to);
  }
  void curve_to(const Vec2& p, const Handle(Geom_Curve) & curve) {
    const TopoDS_Vertex to = vertex(p);
    add(BRepBuilderAPI_MakeEdge(curve, last_, to), p, to);
  }
  /// Turned about the axis, as a solid with its material inside.
  [[nodiscard]] TopoDS_Shape solid() {
    wire_.Add(BRepBuilderAPI_MakeEdge(last_, first_));
    const gp_Ax1 axis(gp_Pnt(0.0, 0.0, 0.0), gp_Dir(0.0, 0.0, 1.0));
    const TopoDS_Face half = BRepBuilderAPI_MakeFace(wire_.Wire(), Standard_True);
    const TopoDS_Shape turned = BRepPrimAPI_MakeRevol(half, axis);
    GProp_GProps volume;
    BRepGProp::VolumeProperties(turned, volume);
    return volume.Mass() < 0.0 ? turned.Reversed() : turned;
  }

 private:
  static TopoDS_Vertex vertex(const Vec2& p) { return BRepBuilderAPI_MakeVertex(in_space(p)); }
  void add(const TopoDS_Edge& edge, const Vec2& p, const TopoDS_Vertex& to) {
    wire_.Add(edge);
    at_ = p;
    last_ = to;
  }

  Vec2 at_;
  TopoDS_Vertex first_, last_;
  BRepBuilderAPI_MakeWire wire_;
};

/// dP/ds of meridian_point.
Vec2 meridian_tangent(const RadialFunction& radial, double s) {
  const RadialJet f = radial.at(s);
  const double q = std::sqrt(1.0 - f.d1 * f.d1);
  return Vec2(q, f.d1) * ((q * q - f.r * f.d2) / q);
}

/// A spline through `count` points of the meridian at equal steps of s, which stays its parameter, with the exact
/// tangents at both ends.
Handle(Geom_BSplineCurve) interpolated(const RadialFunction& radial, int count) {
  const Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, count);
  const Handle(TColStd_HArray1OfReal) parameters = new TColStd_HArray1OfReal(1, count);
  for (int i = 0; i < count; ++i) {
    const double s = radial.axis_length() * i / (count - 1);
    points->SetValue(i + 1, in_space(meridian_point(radial, s)));
    parameters->SetValue(i + 1, s);
  }
  GeomAPI_Interpolate fit(points, parameters, Standard_False, kSamePointMm);
  fit.Load(in_space_vector(meridian_tangent(radial, 0.0)),
           in_space_vector(meridian_tangent(radial, radial.axis_length())), Standard_False);
  fit.Perform();
  if (!fit.IsDone()) throw InternalError("tool.step: no curve could be interpolated through the meridian");
  return fit.Curve();
}

/// Distance of curve and meridian between the points that the curve goes through.
double deviation(const RadialFunction& radial, const Geom_BSplineCurve& curve, int count) {
  double largest = 0.0;
  for (int i = 0; i + 1 < count; ++i) {
    for (const double share : {0.25, 0.5, 0.75}) {
      const double s = radial.axis_length() * (i + share) / (count - 1);
      largest = std::max(largest, curve.Value(s).Distance(in_space(meridian_point(radial, s))));
    }
  }
  return largest;
}

/// Twice as many points until the curve is near enough; a meridian that is not smooth may end at kMostPoints.
Handle(Geom_BSplineCurve) meridian_curve(const RadialFunction& radial) {
  for (int count = kFirstPoints;; count = 2 * count - 1) {
    Handle(Geom_BSplineCurve) curve = interpolated(radial, count);
    // A margin, because the deviation is looked at in three places of each step only.
    if (deviation(radial, *curve, count) <= 0.5 * kStepMeridianMm || count >= kMostPoints) return curve;
  }
}

/// A cone or cylinder: as a line, so that other programs see an exact cone and not a spline.
bool is_straight(const std::vector<Vec2>& points) {
  const Vec2 chord = (points.back() - points.front()).normalized();
  return std::all_of(points.begin(), points.end(), [&](const Vec2& p) {
    const Vec2 d = p - points.front();
    return std::abs(chord.x() * d.y() - chord.y() * d.x()) <= kStraightMm;
  });
}

/// The tip's sphere as far as the meridian's beginning, the meridian, and a flat end at the top, where a shank goes
/// on.
TopoDS_Shape flank_solid(const RadialFunction& radial) {
  const double radius = radial.at(0.0).r;
  const std::vector<Vec2> points = meridian(radial, kFirstPoints);
  const Vec2 pole(-radius, 0.0);
  const Vec2 &begin = points.front(), &end = points.back();
  // The middle of the arc: it may be longer than a quarter of a circle, where the tool grows thinner from its tip on.
  const Vec2 middle = radius * (0.5 * (begin / radius + Vec2(-1.0, 0.0))).normalized();
  Outline outline(pole);
  outline.curve_to(begin, GC_MakeArcOfCircle(in_space(pole), in_space(middle), in_space(begin)).Value());
  if (is_straight(points))
    outline.line_to(end);
  else
    outline.curve_to(end, meridian_curve(radial));
  outline.line_to({end.x(), 0.0});
  return outline.solid();
}

/// The solids of a profile (z, radius), z not falling. Where it touches the axis a solid ends and another begins.
TopoDS_Shape profile_solids(const std::vector<Vec2>& profile) {
  const BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  int count = 0;
  TopoDS_Shape last;
  for (std::size_t begin = 0; begin + 1 < profile.size();) {
    std::size_t end = begin + 1;
    while (end + 1 < profile.size() && profile[end].y() > kSamePointMm) ++end;
    const double low = profile[begin].x(), high = profile[end].x();
    double widest = 0.0;
    for (std::size_t k = begin; k <= end; ++k) widest = std::max(widest, profile[k].y());
    if (high - low > kSamePointMm && widest > kSamePointMm) {
      Outline outline({low, 0.0});
      for (std::size_t k = begin; k <= end; ++k) outline.line_to(profile[k]);
      outline.line_to({high, 0.0});
      builder.Add(all, last = outline.solid());
      ++count;
    }
    begin = end;
  }
  return count == 0 ? TopoDS_Shape() : count == 1 ? last : all;
}

}  // namespace

std::string tool_to_step(const Tool& tool) {
  if (const Legitimacy verdict = check_legitimacy(tool.radial); !verdict.legitimate)
    throw InputError("tool.step: not a tool, " + verdict.reason);
  const OcctSilence silence;
  try {
    std::vector<OcctProduct> products{{"flank", flank_solid(tool.radial)}};
    for (const auto& [name, profile] : {std::pair("shank", &tool.shank), std::pair("holder", &tool.holder)})
      if (const TopoDS_Shape solid = profile_solids(*profile); !solid.IsNull()) products.push_back({name, solid});
    return step_text(tool.name.empty() ? "tool" : tool.name, products);
  } catch (const Standard_Failure& failure) {
    throw InternalError(std::string("tool.step: the solid cannot be made (") + failure.GetMessageString() + ")");
  }
}

}  // namespace flank::internal
