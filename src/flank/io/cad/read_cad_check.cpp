#include "flank/io/cad/read_cad_check.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepClass_FaceClassifier.hxx>
#include <BRep_Tool.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <limits>

#include "flank/io/cad/read_cad.h"
#include "flank/io/cad/read_occt_face.h"
#include "flank/io/cad/read_occt_trim.h"
#include "flank/io/kernel/read_occt_shape.h"

namespace flank::internal {
namespace {

/// Samples per direction of a surface, per edge, and per direction for the question which side is outside.
constexpr int kSurfaceSamples = 24, kEdgeSamples = 16, kSideSamples = 3;
/// Step along the outward normal: far beyond the errors of the conversion, and far less than walls are thick.
constexpr double kStepOffMm = 0.01;

Vec3 vec(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }

double between(double a, double b, int i, int count) { return a + (b - a) * i / count; }

/// Largest distance between our surface and that of the kernel at equal parameters.
void compare_surfaces(const TopoDS_Face& face, const OcctFace& ours, CadCheck& check) {
  const Handle(Geom_Surface) theirs = BRep_Tool::Surface(face);
  const BSplineSurface& s = ours.face.surface;
  Box3 box;
  for (int i = 0; i <= kSurfaceSamples; ++i) {
    for (int j = 0; j <= kSurfaceSamples; ++j) {
      const double u = between(s.u_first(), s.u_last(), i, kSurfaceSamples),
                   v = between(s.v_first(), s.v_last(), j, kSurfaceSamples);
      const Vec3 p = vec(theirs->Value(u, v));
      box.add(p);
      check.surface_error_mm =
          std::max(check.surface_error_mm, (s.value(ours.map_u.value(u), ours.map_v.value(v)) - p).norm());
    }
  }
  check.size_mm = box.diagonal();
}

/// Distance of a point from a curve: the nearest of a row of samples, then Newton.
double distance(const Adaptor3d_Curve& curve, double first, double last, const Vec3& p) {
  constexpr int kRow = 64, kSteps = 12;
  double best = std::numeric_limits<double>::infinity(), t = first;
  for (int i = 0; i <= kRow; ++i) {
    const double at = between(first, last, i, kRow);
    const double d = (vec(curve.Value(at)) - p).norm();
    if (d < best) best = d, t = at;
  }
  for (int i = 0; i < kSteps; ++i) {
    gp_Pnt c;
    gp_Vec d1, d2;
    curve.D2(t, c, d1, d2);
    const Vec3 off = vec(c) - p, a(d1.X(), d1.Y(), d1.Z()), b(d2.X(), d2.Y(), d2.Z());
    // Half of the second derivative of the squared distance; Gauss-Newton if it is not convex here.
    double slope = a.squaredNorm() + off.dot(b);
    if (slope <= 0.0) slope = a.squaredNorm();
    if (slope <= 0.0) break;
    t = std::clamp(t - off.dot(a) / slope, first, last);
    best = std::min(best, (vec(curve.Value(t)) - p).norm());
  }
  return best;
}

/// Our trims and those of the file, each mapped into space, against the edge's curve in space. The gap of the file
/// itself says how much of ours is inherited.
void compare_edge(const TopoDS_Edge& edge, const TopoDS_Face& face, const OcctFace& ours, CadCheck& check) {
  double first = 0.0, last = 0.0, first_2d = 0.0, last_2d = 0.0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  if (curve.IsNull() || BRep_Tool::Degenerated(edge)) return;
  const GeomAdaptor_Curve adaptor(curve);
  const TrimFrame frame = trim_frame(ours.face.surface, ours.map_u, ours.map_v);
  const std::optional<BSplineCurve2> trim = convert_edge(edge, face, frame);
  if (!trim) return;
  const Handle(Geom2d_Curve) theirs = BRep_Tool::CurveOnSurface(edge, face, first_2d, last_2d);
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  for (int i = 0; i <= kEdgeSamples; ++i) {
    const Eigen::Vector2d q = trim->value(between(trim->first(), trim->last(), i, kEdgeSamples));
    check.edge_error_mm =
        std::max(check.edge_error_mm, distance(adaptor, first, last, ours.face.surface.value(q.x(), q.y())));
    const gp_Pnt2d r = theirs->Value(between(first_2d, last_2d, i, kEdgeSamples));
    check.file_edge_gap_mm =
        std::max(check.file_edge_gap_mm, distance(adaptor, first, last, vec(surface->Value(r.X(), r.Y()))));
  }
}

/// Whether a point just off the face along its outward normal is outside the solid, by the kernel's own classifier.
void look_outside(const TopoDS_Face& face, const OcctFace& ours, const Face& part_face,
                  BRepClass3d_SolidClassifier& solid, CadCheck& check) {
  const BSplineSurface& s = ours.face.surface;
  for (int i = 1; i < kSideSamples; ++i) {
    for (int j = 1; j < kSideSamples; ++j) {
      const double u = between(s.u_first(), s.u_last(), i, kSideSamples),
                   v = between(s.v_first(), s.v_last(), j, kSideSamples);
      if (BRepClass_FaceClassifier(face, gp_Pnt2d(u, v), 1e-7).State() != TopAbs_IN) continue;
      const SurfaceJet jet = s.jet(ours.map_u.value(u), ours.map_v.value(v));
      const Vec3 normal = (part_face.reversed ? -1.0 : 1.0) * jet.du.cross(jet.dv).normalized();
      const Vec3 out = jet.p + kStepOffMm * normal;
      solid.Perform(gp_Pnt(out.x(), out.y(), out.z()), 1e-6);
      ++check.outward_samples;
      check.outward_wrong += solid.State() == TopAbs_IN;
    }
  }
}

}  // namespace

std::vector<CadCheck> check_cad(const std::string& file, const std::string& format) {
  const Part part = read_cad(file, format, {});
  const OcctShape loaded = load_occt_shape(file, format, {});
  TopTools_IndexedMapOfShape faces, solids;
  TopExp::MapShapes(loaded.shape, TopAbs_FACE, faces);
  TopExp::MapShapes(loaded.shape, TopAbs_SOLID, solids);
  std::vector<BRepClass3d_SolidClassifier> classifiers(static_cast<std::size_t>(solids.Extent()));
  for (int k = 1; k <= solids.Extent(); ++k) classifiers[static_cast<std::size_t>(k - 1)].Load(solids(k));
  std::vector<CadCheck> checks;
  for (int i = 1; i <= faces.Extent(); ++i) {
    const Face& part_face = part.faces[static_cast<std::size_t>(i - 1)];
    const TopoDS_Face face = TopoDS::Face(faces(i).Oriented(TopAbs_FORWARD));
    const OcctFace ours = convert_occt_face(face, file);
    CadCheck check;
    check.face = part_face.id;
    compare_surfaces(face, ours, check);
    for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next())
      compare_edge(TopoDS::Edge(it.Current()), face, ours, check);
    // Solids that were sewn out of loose faces are not in the file.
    if (part_face.of_solid && static_cast<std::size_t>(part_face.solid) < classifiers.size())
      look_outside(face, ours, part_face, classifiers[static_cast<std::size_t>(part_face.solid)], check);
    checks.push_back(check);
  }
  return checks;
}

}  // namespace flank::internal
