#include "flank/io/triangulate.h"

#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Failure.hxx>
#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/error.h"
#include "flank/base/parallel.h"
#include "flank/geom/trim.h"
#include "flank/io/read_occt_silence.h"
#include "flank/io/write_occt_face.h"

namespace flank {
namespace {

constexpr double kAngle = 0.5;       ///< radians that neighbouring triangles turn by at most
constexpr int kTries = 4;            ///< meshes of one face, each finer
constexpr double kAreaShare = 0.02;  ///< of the trimmed parameter area that the triangles may miss or add
constexpr int kCoarsestGrid = 8, kFinestGrid = 256;

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
    BRepMesh_IncrementalMesh(shape, deflection, false, kAngle, false);
    TopLoc_Location location;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(shape, location);
    if (mesh.IsNull() || !mesh->HasUVNodes()) return {};
    for (int i = 1; i <= mesh->NbNodes(); ++i) {
      const gp_Pnt2d uv = mesh->UVNode(i);
      out.parameters.emplace_back(uv.X(), uv.Y());
      out.mesh.vertices.push_back(face.surface.value(uv.X(), uv.Y()));
    }
    for (int i = 1; i <= mesh->NbTriangles(); ++i) {
      int a, b, c;
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

/// Cells of a grid that are not outside the trim: covers the face, and up to a cell more.
ParameterMesh grid_mesh(const Face& face, int cells) {
  const BSplineSurface& s = face.surface;
  const ParameterRectangle all{s.u_first(), s.u_last(), s.v_first(), s.v_last()};
  const TrimRegion region(face.loops, all);
  const ParameterRectangle box = region.whole() ? all : region.box();
  ParameterMesh out;
  const auto u = [&](int i) { return box.u0 + (box.u1 - box.u0) * i / cells; };
  const auto v = [&](int j) { return box.v0 + (box.v1 - box.v0) * j / cells; };
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      out.parameters.emplace_back(u(i), v(j));
      out.mesh.vertices.push_back(s.value(u(i), v(j)));
    }
  }
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      if (!region.whole() && region.classify({u(i), u(i + 1), v(j), v(j + 1)}) == TrimRegion::Side::kOutside) continue;
      const int a = j * (cells + 1) + i, b = a + cells + 1;
      out.mesh.triangles.push_back({a, a + 1, b + 1});
      out.mesh.triangles.push_back({a, b + 1, b});
    }
  }
  return out;
}

FaceTriangles by_grid(const Face& face, double wanted) {
  FaceTriangles out;
  out.face = face.id;
  out.beyond_border = !face.loops.empty();
  for (int cells = kCoarsestGrid; cells <= kFinestGrid; cells *= 2) {
    ParameterMesh m = grid_mesh(face, cells);
    out.deviation_mm = deviation_of(face.surface, m);
    out.mesh = std::move(m.mesh);
    if (out.deviation_mm <= wanted) break;
  }
  return out;
}

}  // namespace

FaceTriangles triangulate_face(const Face& face, double deviation_mm) {
  if (!(deviation_mm > 0.0)) throw UsageError("triangulation: a deviation above 0 mm is accepted");
  const double area = trimmed_area(face);
  FaceTriangles best;
  best.face = face.id;
  double deflection = deviation_mm;
  for (int k = 0; k < kTries; ++k) {
    ParameterMesh m = mesh_of(face, deflection);
    // A mesher that gives up leaves holes: the areas tell.
    if (m.mesh.triangles.empty() || std::abs(parameter_area(m) - area) > kAreaShare * area) break;
    best.deviation_mm = deviation_of(face.surface, m);
    best.mesh = std::move(m.mesh);
    if (best.deviation_mm <= deviation_mm || static_cast<int>(best.mesh.triangles.size()) > kMostTriangles) break;
    deflection *= std::clamp(0.7 * deviation_mm / best.deviation_mm, 0.1, 0.5);
  }
  return best.mesh.triangles.empty() ? by_grid(face, deviation_mm) : best;
}

std::vector<FaceTriangles> triangulate(const Part& part, double deviation_mm) {
  std::vector<FaceTriangles> out(static_cast<std::size_t>(part.face_count()));
  parallel_for(out.size(), [&](std::size_t k) {
    if (part.is_mesh())
      out[k] = {"F" + std::to_string(k + 1), extract_mesh(part, {static_cast<int>(k)}), 0.0, false};
    else
      out[k] = triangulate_face(part.faces[k], deviation_mm);
  });
  return out;
}

}  // namespace flank
