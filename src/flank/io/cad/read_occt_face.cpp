#include "flank/io/cad/read_occt_face.h"

#include <fmt/format.h>

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/error.h"
#include "flank/geom/stray_pole.h"
#include "flank/io/cad/read_occt_trim.h"
#include "flank/part.h"

namespace flank::internal {
namespace {

constexpr int kWireSteps = 16;       ///< of an edge, to see how far it goes
constexpr double kMostTurns = 1000;  ///< of a strip about the axis of its surface: what says more is damaged

/// The most millimetres that one unit of the parameter makes, at 25 places: so much a difference of parameters may
/// mean.
double mm_along(const Handle(Geom_Surface) & surface, const ParameterWindow& b, bool along_u) {
  double largest = 0.0;
  for (int i = 0; i <= 4; ++i) {
    for (int j = 0; j <= 4; ++j) {
      gp_Pnt p;
      gp_Vec du, dv;
      surface->D1(b.u0 + (b.u1 - b.u0) * i / 4, b.v0 + (b.v1 - b.v0) * j / 4, p, du, dv);
      largest = std::max(largest, (along_u ? du : dv).Magnitude());
    }
  }
  return largest;
}

/// How far the longest wire of the face goes along a parameter.
double longest_wire(const TopoDS_Face& face, bool along_u) {
  double longest = 0.0;
  for (TopExp_Explorer wires(face, TopAbs_WIRE); wires.More(); wires.Next()) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (TopExp_Explorer it(wires.Current(), TopAbs_EDGE); it.More(); it.Next()) {
      double first = 0.0, last = 0.0;
      const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(TopoDS::Edge(it.Current()), face, first, last);
      for (int i = 0; !curve.IsNull() && i <= kWireSteps; ++i) {
        const gp_Pnt2d p = curve->Value(first + (last - first) * i / kWireSteps);
        low = std::min(low, along_u ? p.X() : p.Y());
        high = std::max(high, along_u ? p.X() : p.Y());
      }
    }
    longest = std::max(longest, high - low);
  }
  return longest;
}

/// A window of one turn, or of as many as a wire of the face makes: the root and the crest of a thread are strips of one
/// cylinder that lie side by side. A spline has one turn only.
void keep_to_turns(const TopoDS_Face& face, const Handle(Geom_Surface) & surface, bool along_u, double period, double a,
                   double& z) {
  const bool winds = GeomAdaptor_Surface(surface).GetType() != GeomAbs_BSplineSurface && z - a <= kMostTurns * period &&
                     longest_wire(face, along_u) > period * (1.0 + 1e-6);
  if (!winds) z = std::min(z, a + period);
}

/// Where the face lies in the parameters of its surface; ends that differ from the surface's own by less than kBorderMm
/// are the surface's.
ParameterWindow box_of(const TopoDS_Face& face, const Handle(Geom_Surface) & surface, const std::string& name) {
  ParameterWindow b;
  BRepTools::UVBounds(face, b.u0, b.u1, b.v0, b.v1);
  const auto bounded = [](double a, double z) {
    return !Precision::IsInfinite(a) && !Precision::IsInfinite(z) && z > a;
  };
  // Planes and cylinders go on for ever: without trims there is nothing to make a spline of.
  if (!bounded(b.u0, b.u1) || !bounded(b.v0, b.v1))
    throw InputError(name + ": has no finite extent; expected faces bounded by trims on every side");
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
  surface->Bounds(u0, u1, v0, v1);
  const auto snap = [](double& t, double end, double mm) {
    if (!Precision::IsInfinite(end) && std::abs(t - end) * mm < kBorderMm) t = end;
  };
  const double mm_u = mm_along(surface, b, true), mm_v = mm_along(surface, b, false);
  // A closed surface has no ends to snap to; its window may lie across the seam.
  if (!surface->IsUPeriodic()) snap(b.u0, u0, mm_u), snap(b.u1, u1, mm_u);
  if (!surface->IsVPeriodic()) snap(b.v0, v0, mm_v), snap(b.v1, v1, mm_v);
  if (surface->IsUPeriodic()) keep_to_turns(face, surface, true, surface->UPeriod(), b.u0, b.u1);
  if (surface->IsVPeriodic()) keep_to_turns(face, surface, false, surface->VPeriod(), b.v0, b.v1);
  return b;
}

/// Arrays of basis functions have room up to kMaxDegree.
void refuse_high_degree(const BSplineSurface& s, const std::string& name) {
  if (s.degree_u > kMaxDegree || s.degree_v > kMaxDegree)
    throw InputError(name + ": has degree " + std::to_string(s.degree_u) + " x " + std::to_string(s.degree_v) +
                     "; expected up to " + std::to_string(kMaxDegree));
}

/// False for NaN too, since it compares with nothing.
bool usable(double x) { return std::abs(x) <= kLargestCoordinateMm; }

template <class Numbers>
bool all_finite(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

/// What everything else takes for granted. Damaged files, and the kernel itself, make surfaces that break it.
void refuse_unusable(const BSplineSurface& s, const std::string& name) {
  if (!all_finite(s.knots_u) || !all_finite(s.knots_v) || !(s.u_last() > s.u_first()) || !(s.v_last() > s.v_first()))
    throw InputError(name + ": the knots of its surface are not finite numbers that rise");
  for (const double w : s.weights)
    if (!(w > 0.0) || !std::isfinite(w))
      throw InputError(fmt::format("{}: a weight of its surface is {}; expected numbers > 0", name, w));
  for (const Vec3& p : s.poles)
    if (!usable(p.x()) || !usable(p.y()) || !usable(p.z()))
      throw InputError(fmt::format("{}: a control point of its surface is at ({}, {}, {}); expected up to {} mm", name,
                                   p.x(), p.y(), p.z(), kLargestCoordinateMm));
}

/// The net of a spline surface as it stands in the file, without its knots.
BSplineSurface net_of(const Geom_BSplineSurface& spline) {
  BSplineSurface net;
  net.count_u = spline.NbUPoles();
  net.count_v = spline.NbVPoles();
  const bool rational = spline.IsURational() || spline.IsVRational();
  for (int i = 1; i <= net.count_u; ++i)
    for (int j = 1; j <= net.count_v; ++j) {
      const gp_Pnt p = spline.Pole(i, j);
      net.poles.emplace_back(p.X(), p.Y(), p.Z());
      if (rational) net.weights.push_back(spline.Weight(i, j));
    }
  return net;
}

/// Says which control point of the file's surface went astray, or its weight: where the border does not follow it, nothing else tells.
void note_stray_pole(const Handle(Geom_Surface) & surface, const std::string& name, std::vector<std::string>& notes) {
  const auto spline = Handle(Geom_BSplineSurface)::DownCast(surface);
  if (spline.IsNull()) return;
  const BSplineSurface net = net_of(*spline);
  if (const auto stray = stray_pole(net))
    notes.push_back(fmt::format(
        "{}: control point {}, {} of its surface lies {:.3g} mm off the line of its neighbours, far more than "
        "any other; check it before using the result",
        name, stray->u + 1, stray->v + 1, stray->off));
  if (const auto stray = stray_weight(net))
    notes.push_back(fmt::format(
        "{}: the weight of control point {}, {} of its surface differs from its neighbours by a factor of {:.3g}, "
        "far more than any other; check it before using the result",
        name, stray->u + 1, stray->v + 1, stray->off));
}

}  // namespace

OcctFace convert_occt_face(const TopoDS_Face& face, const std::string& name) {
  OcctFace result;
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  if (surface.IsNull()) throw InputError(name + ": has no surface; expected faces with a surface (not triangulations)");
  result.type = surface_type(surface);
  ConvertedSurface converted;
  try {
    converted = convert_surface(surface, box_of(face, surface, name));
  } catch (const Standard_Failure& failure) {
    throw InputError(name + ": its surface (" + result.type + ") has no B-spline form (" + failure.GetMessageString() +
                     ")");
  }
  refuse_high_degree(converted.surface, name);
  refuse_unusable(converted.surface, name);
  if (converted.approximation_mm > 0.0)
    result.notes.push_back(name + ": " + result.type + " surface approximated within " +
                           std::to_string(converted.approximation_mm) + " mm");
  note_stray_pole(surface, name, result.notes);
  const TrimFrame frame = trim_frame(converted.surface, converted.map_u, converted.map_v);
  // Wires in the sense of the surface: the face's own turn is told apart (reversed), and would turn them once more.
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  for (TopExp_Explorer it(forward, TopAbs_WIRE); it.More(); it.Next()) {
    const std::optional<TrimLoop> loop = convert_wire(TopoDS::Wire(it.Current()), forward, frame);
    if (!loop)
      throw InputError(name +
                       ": a border of the face does not lie on its surface; export it again with trims (p-curves)");
    require_usable_trim(*loop, converted.surface, name);
    result.face.loops.push_back(*loop);
  }
  // Most CAD files state the border of an untrimmed surface as a trim; without it the face is cheaper to ask.
  if (result.face.loops.size() == 1 && is_natural_border(result.face.loops.front(), converted.surface, frame))
    result.face.loops.clear();
  result.face.reversed = face.Orientation() == TopAbs_REVERSED;
  result.face.surface = std::move(converted.surface);
  result.map_u = std::move(converted.map_u);
  result.map_v = std::move(converted.map_v);
  return result;
}

}  // namespace flank::internal
