#include "flank/io/cad/triangulate.h"

#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Failure.hxx>
#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/geom/face_box.h"
#include "flank/geom/tessellate.h"
#include "flank/geom/trim.h"
#include "flank/io/cad/write_occt_face.h"
#include "flank/io/kernel/read_occt_silence.h"

namespace flank::internal {
namespace {

constexpr double kAngle = 0.5;       ///< radians that neighbouring triangles turn by at most
constexpr int kTries = 4;            ///< meshes of one face, each finer
constexpr double kAreaShare = 0.02;  ///< of the trimmed parameter area that the triangles may miss or add
constexpr int kCoarsestGrid = 8, kFinestGrid = 256;
constexpr int kGradedTries = 3;
constexpr int kMostCut = 4 * kMostTriangles;  ///< most are along the border
constexpr double kFar =
    2.0;  ///< of the deviation asked for: what is said of a mesh (clearance_scene.cpp), and what another one is tried for

/// Triangles with the parameters of their vertices.
struct ParameterMesh {
  TriangleMesh mesh;
  std::vector<Vec2> parameters;
};

/// What Open CASCADE makes of a face; empty where it fails.
ParameterMesh mesh_of(const Face& face, double deflection) {
  const OcctSilence silence;
  ParameterMesh out;
  try {
    const TopoDS_Face shape = occt_face(face);
    const BRepMesh_IncrementalMesh meshed(shape, deflection, false, kAngle, false);
    TopLoc_Location location;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(shape, location);
    if (mesh.IsNull() || !mesh->HasUVNodes()) return {};
    for (int i = 1; i <= mesh->NbNodes(); ++i) {
      const gp_Pnt2d uv = mesh->UVNode(i);
      out.parameters.emplace_back(uv.X(), uv.Y());
      out.mesh.vertices.push_back(face.surface.value(uv.X(), uv.Y()));
    }
    for (int i = 1; i <= mesh->NbTriangles(); ++i) {
      int a = 0, b = 0, c = 0;
      mesh->Triangle(i).Get(a, b, c);
      out.mesh.triangles.push_back({a - 1, b - 1, c - 1});
    }
  } catch (const Standard_Failure&) {
    return {};
  } catch (const InternalError&) {
    return {};
  }
  return out;
}

/// Distance between the surface and the triangles, at places of equal parameters.
double deviation_of(const BSplineSurface& surface, const ParameterMesh& m) {
  constexpr std::array<std::array<double, 2>, 7> kPlaces{
      {{0.5, 0.0}, {0.0, 0.5}, {0.5, 0.5}, {1 / 3.0, 1 / 3.0}, {0.2, 0.2}, {0.6, 0.2}, {0.2, 0.6}}};
  double most = 0.0;
  for (const auto& t : m.mesh.triangles) {
    const auto at = [&](const auto& values, std::size_t k) { return values[static_cast<std::size_t>(t[k])]; };
    for (const auto& [b, c] : kPlaces) {
      const double a = 1.0 - b - c;
      const Vec2 uv = a * at(m.parameters, 0) + b * at(m.parameters, 1) + c * at(m.parameters, 2);
      const Vec3 flat = a * at(m.mesh.vertices, 0) + b * at(m.mesh.vertices, 1) + c * at(m.mesh.vertices, 2);
      const SurfaceJet jet = surface.jet(uv.x(), uv.y());
      // What lies along the surface is no deviation of it.
      const Vec3 off = flat - jet.p, n = jet.du.cross(jet.dv);
      const double length = n.norm();
      most = std::max(most, length > 0.0 ? std::abs(off.dot(n)) / length : off.norm());
    }
  }
  return most;
}

/// Area of the triangles in the parameter plane, which trims enclose exactly: holes that a mesher has left show as a
/// lack.
double parameter_area(const ParameterMesh& m) {
  double twice = 0.0;
  for (const auto& t : m.mesh.triangles) {
    const Vec2& a = m.parameters[static_cast<std::size_t>(t[0])];
    const Vec2 ab = m.parameters[static_cast<std::size_t>(t[1])] - a,
               ac = m.parameters[static_cast<std::size_t>(t[2])] - a;
    twice += std::abs(ab.x() * ac.y() - ab.y() * ac.x());
  }
  return 0.5 * twice;
}

/// Area of the trimmed region in the parameter plane: the largest loop less the others.
double trimmed_area(const Face& face) {
  const BSplineSurface& s = face.surface;
  if (face.loops.empty()) return (s.u_last() - s.u_first()) * (s.v_last() - s.v_first());
  double largest = 0.0, all = 0.0;
  for (const TrimLoop& loop : face.loops) {
    const double area = std::abs(signed_area(loop));
    largest = std::max(largest, area);
    all += area;
  }
  return 2.0 * largest - all;
}

/// Parameters first to last in `cells` equal steps.
std::vector<double> even_steps(double first, double last, int cells) {
  std::vector<double> steps;
  for (int i = 0; i <= cells; ++i) steps.push_back(first + (last - first) * i / cells);
  return steps;
}

/// Cells of a grid that are not outside the trim: covers the face, and up to a cell more.
ParameterMesh grid_mesh(const BSplineSurface& s, const TrimRegion& region, const std::vector<double>& u,
                        const std::vector<double>& v) {
  ParameterMesh out;
  for (const double y : v) {
    for (const double x : u) {
      out.parameters.emplace_back(x, y);
      out.mesh.vertices.push_back(s.value(x, y));
    }
  }
  const int row = static_cast<int>(u.size());
  for (int j = 0; j + 1 < static_cast<int>(v.size()); ++j) {
    // Cells that a loop cuts stay whole: an obstacle may be a little larger, never smaller.
    for (int i = 0; i + 1 < row; ++i) {
      const auto k = static_cast<std::size_t>(i), l = static_cast<std::size_t>(j);
      if (!region.whole() && region.classify({u[k], u[k + 1], v[l], v[l + 1]}) == TrimRegion::Side::kOutside) continue;
      const int a = j * row + i, b = a + row;
      out.mesh.triangles.push_back({a, a + 1, b + 1});
      out.mesh.triangles.push_back({a, b + 1, b});
    }
  }
  return out;
}

ParameterRectangle domain(const BSplineSurface& s) { return {s.u_first(), s.u_last(), s.v_first(), s.v_last()}; }

/// Steps from `first` to `last`, short where the surface bends along them: what `at(x, y)` (y over the other direction)
/// departs from its chords, across the surface, is at most a third of `wanted` and even.
template <class At>
std::vector<double> graded_steps(double first, double last, double other_first, double other_last, double wanted,
                                 const At& at) {
  constexpr int kProbes = 256, kLines = 16;
  constexpr double kFewest = 2.0 / kProbes;  ///< cells a probe: at least two over all
  const double h = (last - first) / kProbes;
  // Cells up to each probe, not rounded: equal shares of their sum are steps that deviate equally.
  std::vector<double> sum = {0.0};
  for (int i = 0; i < kProbes; ++i) {
    double off = 0.0;
    for (int k = 0; k <= kLines; ++k) {
      // The worst of several lines decides for all: a grid has one set of steps.
      const double y = other_first + (other_last - other_first) * k / kLines, x = first + h * i;
      const SurfaceJet jet = at(x + 0.5 * h, y);
      const Vec3 n = jet.du.cross(jet.dv), chord = 0.5 * (at(x, y).p + at(x + h, y).p) - jet.p;
      const double length = n.norm();
      off = std::max(off, length > 0.0 ? std::abs(chord.dot(n)) / length : chord.norm());
    }
    // A chord over h that is off by `off` is off by off / n^2 when cut into n.
    sum.push_back(sum.back() + std::max(kFewest, std::sqrt(3.0 * off / wanted)));
  }
  const int cells = static_cast<int>(std::ceil(sum.back()));
  std::vector<double> steps = {first};
  for (int c = 1, i = 0; c < cells; ++c) {
    const double place = sum.back() * c / cells;
    while (sum[static_cast<std::size_t>(i) + 1] < place) ++i;
    const auto k = static_cast<std::size_t>(i);
    steps.push_back(first + h * (i + (place - sum[k]) / (sum[k + 1] - sum[k])));
  }
  steps.push_back(last);
  return steps;
}

/// A face without trims, by a grid that follows its curvature: where a mesher fights with a pole or a long thin patch, this
/// is a matter of milliseconds. Empty where it would take too many triangles.
FaceTriangles by_graded_grid(const Face& face, double wanted) {
  const BSplineSurface& s = face.surface;
  const ParameterRectangle d = domain(s);
  const TrimRegion region({}, d);
  FaceTriangles out;
  out.face = face.id;
  double aim = wanted;
  for (int k = 0; k < kGradedTries; ++k) {
    const auto u = graded_steps(d.u0, d.u1, d.v0, d.v1, aim, [&](double x, double y) { return s.jet(x, y); });
    const auto v = graded_steps(d.v0, d.v1, d.u0, d.u1, aim, [&](double x, double y) { return s.jet(y, x); });
    if (2 * (u.size() - 1) * (v.size() - 1) > kMostTriangles) break;
    ParameterMesh m = grid_mesh(s, region, u, v);
    out.deviation_mm = deviation_of(s, m);
    if (out.deviation_mm <= wanted) {
      out.mesh = std::move(m.mesh);
      break;
    }
    // In proportion and a little more, since what is reached follows what is aimed at; the bounds keep one odd
    // measurement from running away.
    aim *= std::clamp(0.8 * wanted / out.deviation_mm, 0.1, 0.8);
  }
  return out;
}

/// A trimmed face that a mesher does not bring near enough, in cells that its loops cut: off its border by less than a quarter of their
/// side. Empty where that would take too many triangles, or where the cells miss some of it.
FaceTriangles by_cut_grid(const Face& face, double wanted, double area) {
  constexpr double kSides = 100.0;  // cells along the face, at least: a border is no straighter than they
  const Box3 box = box_of(face);
  FaceTriangles out;
  out.face = face.id;
  double aim = wanted;
  for (int k = 0; k < kGradedTries; ++k) {
    Tessellation cut = tessellate(face, {.chord_mm = aim, .edge_mm = box.diagonal() / kSides});
    ParameterMesh m{std::move(cut.mesh), std::move(cut.parameters)};
    if (static_cast<int>(m.mesh.triangles.size()) > kMostCut || std::abs(parameter_area(m) - area) > kAreaShare * area)
      break;
    out.deviation_mm = deviation_of(face.surface, m);
    out.mesh = std::move(m.mesh);
    if (out.deviation_mm <= wanted) break;
    aim *= std::clamp(0.8 * wanted / out.deviation_mm, 0.1, 0.8);
  }
  return out;
}

/// What Open CASCADE's mesher makes, finer and finer as long as that brings it nearer; empty where it leaves holes.
FaceTriangles by_mesher(const Face& face, double wanted, double area) {
  constexpr double kNearer = 0.7;  // a finer mesh of a face that the mesher folds is no nearer, and takes minutes
  FaceTriangles best;
  best.face = face.id;
  double deflection = wanted;
  for (int k = 0; k < kTries; ++k) {
    ParameterMesh m = mesh_of(face, deflection);
    // A mesher that gives up leaves holes: the areas tell.
    if (m.mesh.triangles.empty() || std::abs(parameter_area(m) - area) > kAreaShare * area) break;
    const double before = best.mesh.triangles.empty() ? 1e300 : best.deviation_mm, here = deviation_of(face.surface, m);
    if (here < before) {
      best.deviation_mm = here;
      best.mesh = std::move(m.mesh);
    }
    // What is reached when there are too many triangles is told as it is (deviation_mm).
    if (here <= wanted || here > kNearer * before || static_cast<int>(best.mesh.triangles.size()) > kMostTriangles)
      break;
    deflection *= std::clamp(0.7 * wanted / here, 0.1, 0.5);
  }
  return best;
}

/// The last resort, where the mesher fails: ever finer cells of the parameter rectangle.
FaceTriangles by_grid(const Face& face, double wanted) {
  FaceTriangles out;
  out.face = face.id;
  out.beyond_border = !face.loops.empty();
  const TrimRegion region(face.loops, domain(face.surface));
  const ParameterRectangle box = region.whole() ? domain(face.surface) : region.box();
  for (int cells = kCoarsestGrid; cells <= kFinestGrid; cells *= 2) {
    ParameterMesh m =
        grid_mesh(face.surface, region, even_steps(box.u0, box.u1, cells), even_steps(box.v0, box.v1, cells));
    out.deviation_mm = deviation_of(face.surface, m);
    out.mesh = std::move(m.mesh);
    if (out.deviation_mm <= wanted) break;
  }
  return out;
}

}  // namespace

FaceTriangles triangulate_face(const Face& face, double deviation_mm) {
  if (!(deviation_mm > 0.0)) throw UsageError("triangulation: the deviation must be > 0 mm");
  // Without trims a grid will do, and needs no mesher.
  if (TrimRegion(face.loops, domain(face.surface)).whole())
    if (FaceTriangles graded = by_graded_grid(face, deviation_mm); !graded.mesh.triangles.empty()) return graded;
  const double area = trimmed_area(face);
  FaceTriangles best = by_mesher(face, deviation_mm, area);
  if (!best.mesh.triangles.empty() && best.deviation_mm <= kFar * deviation_mm) return best;
  if (FaceTriangles cut = by_cut_grid(face, deviation_mm, area); !cut.mesh.triangles.empty())
    if (best.mesh.triangles.empty() || cut.deviation_mm < best.deviation_mm) return cut;
  return best.mesh.triangles.empty() ? by_grid(face, deviation_mm) : best;
}

std::vector<FaceTriangles> triangulate(const Part& part, double deviation_mm) {
  std::vector<FaceTriangles> out(static_cast<std::size_t>(part.face_count()));
  parallel_for(out.size(), [&](std::size_t k) {
    if (part.is_mesh())
      out[k] = {part.face_id(static_cast<int>(k)), extract_mesh(part, {static_cast<int>(k)}), 0.0, false};
    else if (part.is_left_out(static_cast<int>(k)))
      out[k].face = part.face_id(static_cast<int>(k));
    else
      out[k] = triangulate_face(part.faces[k], deviation_mm);
  });
  return out;
}

}  // namespace flank::internal
