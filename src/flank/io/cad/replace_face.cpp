#include "flank/io/cad/replace_face.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRepTools_ReShape.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom_Curve.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "flank/error.h"
#include "flank/io/cad/read_occt_face.h"
#include "flank/io/cad/trim_occt_neighbour.h"
#include "flank/io/cad/write_occt_face.h"
#include "flank/io/cad/write_occt_products.h"
#include "flank/io/kernel/read_occt_shape.h"
#include "flank/io/kernel/read_occt_silence.h"

namespace flank::internal {
namespace {

constexpr double kLeastToleranceMm = 1e-6;  ///< of an edge

Vec3 vec(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }

/// The same surface with u and v exchanged: its normal looks the other way.
BSplineSurface transposed(const BSplineSurface& s) {
  BSplineSurface t = s;
  std::swap(t.degree_u, t.degree_v);
  std::swap(t.knots_u, t.knots_v);
  std::swap(t.count_u, t.count_v);
  for (int i = 0; i < s.count_u; ++i)
    for (int j = 0; j < s.count_v; ++j) {
      t.pole(j, i) = s.pole(i, j);
      if (!s.weights.empty())
        t.weights[static_cast<std::size_t>(j * t.count_v + i)] = s.weights[static_cast<std::size_t>(i * s.count_v + j)];
    }
  return t;
}

/// Whether the new surface's normal looks the way of the old one's, both as they are parametrised, at the first place that has
/// both.
bool same_way(const TopoDS_Face& old, const NewSurface& next) {
  const BRepAdaptor_Surface surface(TopoDS::Face(old.Oriented(TopAbs_FORWARD)));
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
  BRepTools::UVBounds(old, u0, u1, v0, v1);
  for (const double share : {0.5, 0.4, 0.6, 0.25, 0.75}) {
    gp_Pnt p;
    gp_Vec du, dv;
    surface.D1(u0 + share * (u1 - u0), v0 + share * (v1 - v0), p, du, dv);
    const std::optional<Vec2> at = next.nearest(vec(p));
    if (!at) continue;
    const gp_Vec n = du.Crossed(dv);
    const SurfaceJet jet = next.surface.jet(at->x(), at->y());
    return Vec3(n.X(), n.Y(), n.Z()).dot(jet.du.cross(jet.dv)) > 0.0;
  }
  return true;
}

/// Why the borders of a face cannot be kept; empty where they can.
std::string unusable_border(const TopoDS_Face& face) {
  TopTools_IndexedMapOfShape seen;
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(it.Current());
    if (BRep_Tool::Degenerated(edge)) return "one of its borders is a point";
    if (seen.Contains(edge) || BRep_Tool::IsClosed(edge, face)) return "it has a seam";
    double first = 0.0, last = 0.0;
    if (BRep_Tool::Curve(edge, first, last).IsNull()) return "one of its borders has no curve in space";
    seen.Add(edge);
  }
  return {};
}

/// The face with another surface, its borders where that meets the neighbours; none, with the reason in `why`, where that cannot be.
std::optional<TopoDS_Face> replaced(const TopoDS_Shape& shape, const TopoDS_Face& old, const NewSurface& wanted,
                                    LedBorder& led, std::string& why) {
  why = unusable_border(old);
  if (!why.empty()) return {};
  NewSurface next = wanted;
  if (!same_way(old, wanted)) {
    next.surface = transposed(wanted.surface);
    next.nearest = [&wanted](const Vec3& p) -> std::optional<Vec2> {
      const std::optional<Vec2> at = wanted.nearest(p);
      if (!at) return {};
      return Vec2(at->y(), at->x());
    };
  }
  const Handle(Geom_BSplineSurface) surface = occt_surface(next.surface);
  const BRep_Builder builder;
  TopoDS_Face face;
  builder.MakeFace(face, surface, kLeastToleranceMm);
  BorderMove borders(shape, old, next);
  for (TopExp_Explorer it(old.Oriented(TopAbs_FORWARD), TopAbs_WIRE); it.More(); it.Next()) {
    for (TopExp_Explorer edge(it.Current(), TopAbs_EDGE); edge.More(); edge.Next()) {
      const std::optional<LedBorder> one = borders.lead_over(TopoDS::Edge(edge.Current()), surface);
      if (!one) {
        why = "its border runs past the new surface";
        return {};
      }
      led.off_mm = std::max(led.off_mm, one->off_mm);
      led.moved_mm = std::max(led.moved_mm, one->moved_mm);
    }
    builder.Add(face, it.Current());
  }
  return TopoDS::Face(face.Oriented(old.Orientation()));
}

double volume_of(const TopoDS_Shape& shape) {
  GProp_GProps volume;
  BRepGProp::VolumeProperties(shape, volume);
  return volume.Mass();
}

/// Values of the new faces, with the numbers that they have in the new shape.
std::vector<Face> values_of(const TopoDS_Shape& shape, const std::vector<TopoDS_Face>& fresh, const std::string& file) {
  TopTools_IndexedMapOfShape all;
  TopExp::MapShapes(shape, TopAbs_FACE, all);
  std::vector<Face> faces;
  for (const TopoDS_Face& wanted : fresh)
    for (int i = 1; i <= all.Extent(); ++i) {
      if (!all(i).IsPartner(wanted)) continue;
      const std::string id = "F" + std::to_string(i);
      faces.push_back(convert_occt_face(TopoDS::Face(all(i)), file + ", face " + id).face);
      faces.back().id = id;
      faces.back().reversed = all(i).Orientation() == TopAbs_REVERSED;
      break;
    }
  return faces;
}

}  // namespace

ReplacedFaces replace_faces(const std::string& file, const std::string& format, const std::optional<std::string>& unit,
                            const std::vector<NewSurface>& surfaces) {
  const OcctSilence silence;
  ReplacedFaces out;
  try {
    const OcctShape loaded = load_occt_shape(file, format, unit);
    const Handle(BRepTools_ReShape) context = new BRepTools_ReShape;
    std::vector<TopoDS_Face> fresh;
    for (const NewSurface& next : surfaces) {
      const TopoDS_Face old = TopoDS::Face(loaded.faces(next.face + 1));
      LedBorder led;
      const std::optional<TopoDS_Face> face = replaced(loaded.shape, old, next, led, out.why);
      if (!face) {
        out.why = "F" + std::to_string(next.face + 1) + ": " + out.why;
        return out;
      }
      out.gap_mm.push_back(led.off_mm);
      out.moved_mm.push_back(led.moved_mm);
      fresh.push_back(*face);
      context->Replace(old, *face);
    }
    const TopoDS_Shape shape = context->Apply(loaded.shape);
    out.faces = values_of(shape, fresh, file);
    if (out.faces.size() != surfaces.size()) {
      out.why = "the CAD kernel did not take the new faces";
      out.faces.clear();
      return out;
    }
    const std::string name = std::filesystem::path(file).stem().string() + ", redesigned";
    out.step = step_text(name, {{name, shape}});
  } catch (const Standard_Failure& failure) {
    out.why = std::string("the CAD kernel cannot join them (") + failure.GetMessageString() + ")";
  }
  return out;
}

CheckedSolids check_solids(const std::string& file, const std::string& format, const std::optional<std::string>& unit) {
  const OcctSilence silence;
  CheckedSolids checked;
  try {
    const OcctShape loaded = load_occt_shape(file, format, unit);
    checked.shape_valid = BRepCheck_Analyzer(loaded.shape).IsValid();
    for (TopExp_Explorer it(loaded.shape, TopAbs_SOLID); it.More(); it.Next()) {
      ++checked.solids;
      bool closed = true;
      for (TopExp_Explorer shell(it.Current(), TopAbs_SHELL); shell.More(); shell.Next())
        closed = closed && BRep_Tool::IsClosed(shell.Current());
      if (closed && BRepCheck_Analyzer(it.Current()).IsValid() && volume_of(it.Current()) > 0.0) ++checked.valid;
    }
    for (TopExp_Explorer it(loaded.shape, TopAbs_EDGE); it.More(); it.Next())
      checked.tolerance_mm = std::max(checked.tolerance_mm, BRep_Tool::Tolerance(TopoDS::Edge(it.Current())));
  } catch (const Standard_Failure&) {
    checked.shape_valid = false;
  }
  return checked;
}

}  // namespace flank::internal
