#include "flank/feature/wheel_face.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/geom/pieces/face_pieces.h"
#include "flank/geom/tessellate.h"
#include "flank/geom/trim.h"
#include "flank/io/face_groups.h"

namespace flank::internal {
namespace {

constexpr int kGrid = 24;         ///< samples in a direction
constexpr int kFinest = 192;      ///< of a face that hardly shows in its parameter box
constexpr int kFewest = 40;       ///< samples that say enough of a face
constexpr double kSteps = 120.0;  ///< sides of triangles in a part's size

/// Curvatures from the fundamental forms; false where the surface has no normal.
bool sample_at(const Face& face, double u, double v, double cell, FaceSample& out) {
  const SurfaceJet jet = face.surface.jet(u, v);
  const Vec3 cross = jet.du.cross(jet.dv);
  const double e = jet.du.squaredNorm(), f = jet.du.dot(jet.dv), g = jet.dv.squaredNorm(), area = cross.norm();
  if (!(area > 1e-3 * std::sqrt(e * g)) || !(area > 0.0)) return false;
  const Vec3 n = (face.reversed ? -1.0 : 1.0) * cross / area;
  const double l = jet.duu.dot(n), m = jet.duv.dot(n), q = jet.dvv.dot(n), det = area * area;
  const double mean = 0.5 * (e * q - 2.0 * f * m + g * l) / det, gauss = (l * q - m * m) / det;
  const double spread = std::sqrt(std::max(0.0, mean * mean - gauss));
  out = {jet.p, n, area * cell, mean - spread, mean + spread};
  return true;
}

std::vector<FaceSample> samples_of(const Face& face) {
  const BSplineSurface& s = face.surface;
  const TrimRegion region(face.loops, {s.u_first(), s.u_last(), s.v_first(), s.v_last()});
  const ParameterRectangle& b = region.box();
  std::vector<FaceSample> out;
  for (int grid = kGrid; grid <= kFinest; grid *= 2) {
    out.clear();
    const double du = (b.u1 - b.u0) / grid, dv = (b.v1 - b.v0) / grid;
    for (int i = 0; i < grid; ++i)
      for (int j = 0; j < grid; ++j) {
        const double u = b.u0 + (i + 0.5) * du, v = b.v0 + (j + 0.5) * dv;
        FaceSample sample;
        if (!region.whole() && !region.inside(u, v)) continue;
        if (sample_at(face, u, v, du * dv, sample)) out.push_back(sample);
      }
    if (static_cast<int>(out.size()) >= kFewest) break;
  }
  return out;
}

void conclude(WheelFace& out) {
  for (const FaceSample& sample : out.samples) out.area += sample.area;
  out.box = out.mesh.box();
  if (!out.mesh.triangles.empty()) out.tree = TriangleBvh(out.mesh);
}

WheelFace from_face(const Face& face, const std::string& type, int index, double size) {
  WheelFace out;
  out.id = face.id, out.type = type, out.index = index;
  out.solid = face.of_solid ? face.solid : -1;
  out.samples = samples_of(face);
  Tessellation cells = tessellate(face, {.chord_mm = 2e-4 * size, .edge_mm = size / kSteps, .most_steps = 120});
  out.mesh = std::move(cells.mesh);
  for (const std::vector<Vec3>& loop : cells.borders) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec3 &p = loop[k], &q = loop[(k + 1) % loop.size()];
      out.border_mm += (q - p).norm();
      out.border.push_back(p);
      out.border.push_back(0.5 * (p + q));
    }
  }
  conclude(out);
  return out;
}

Vec3 normal_of(const TriangleMesh& mesh, int triangle) {
  const auto& t = mesh.triangles[static_cast<std::size_t>(triangle)];
  const Vec3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
  return (mesh.vertices[static_cast<std::size_t>(t[1])] - a)
      .cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a)
      .normalized();
}

Vec3 middle_of(const TriangleMesh& mesh, int triangle) {
  Vec3 sum = Vec3::Zero();
  for (const int k : mesh.triangles[static_cast<std::size_t>(triangle)])
    sum += mesh.vertices[static_cast<std::size_t>(k)];
  return sum / 3.0;
}

/// The region's own border: sides of triangles that no other triangle of it has.
void add_mesh_border(WheelFace& out) {
  std::vector<std::pair<int, int>> sides;
  for (const auto& t : out.mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) sides.emplace_back(std::minmax(t[k], t[(k + 1) % 3]));
  std::sort(sides.begin(), sides.end());
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if ((k > 0 && sides[k] == sides[k - 1]) || (k + 1 < sides.size() && sides[k] == sides[k + 1])) continue;
    const Vec3 &p = out.mesh.vertices[static_cast<std::size_t>(sides[k].first)],
               &q = out.mesh.vertices[static_cast<std::size_t>(sides[k].second)];
    out.border_mm += (q - p).norm();
    out.border.push_back(p);
    out.border.push_back(0.5 * (p + q));
  }
}

WheelFace from_region(const Part& part, int index) {
  WheelFace out;
  out.id = part.face_id(index), out.type = "mesh", out.index = index;
  out.mesh = extract_mesh(part, {index});
  for (std::size_t k = 0; k < out.mesh.triangles.size(); ++k) {
    const auto& t = out.mesh.triangles[k];
    const Vec3& a = out.mesh.vertices[static_cast<std::size_t>(t[0])];
    const Vec3 cross = (out.mesh.vertices[static_cast<std::size_t>(t[1])] - a)
                           .cross(out.mesh.vertices[static_cast<std::size_t>(t[2])] - a);
    if (!(cross.norm() > 0.0)) continue;
    out.samples.push_back({middle_of(out.mesh, static_cast<int>(k)), cross.normalized(), 0.5 * cross.norm()});
  }
  add_mesh_border(out);
  conclude(out);
  return out;
}

}  // namespace

std::vector<WheelFace> wheel_faces(const Part& part) {
  const double size = part.box.diagonal();
  std::vector<std::vector<WheelFace>> all(static_cast<std::size_t>(part.face_count()));
  parallel_for(all.size(), [&](std::size_t k) {
    const int index = static_cast<int>(k);
    if (part.is_left_out(index)) return;
    if (part.is_mesh()) {
      all[k].push_back(from_region(part, index));
      return;
    }
    const Face& face = part.faces[k];
    const std::vector<FacePiece> pieces = face_pieces(face);
    if (!pieces.empty() && goes_all_round(face, pieces)) {
      for (const NamedPiece& piece : pieces_of_face(part, index)) {
        all[k].push_back(from_face(piece.face, part.surface_types[k], index, size));
        all[k].back().edge = piece.edge;
      }
    } else {
      all[k].push_back(from_face(face, part.surface_types[k], index, size));
    }
  });
  std::vector<WheelFace> out;
  for (std::vector<WheelFace>& some : all)
    for (WheelFace& face : some)
      if (!face.samples.empty() && !face.mesh.triangles.empty()) out.push_back(std::move(face));
  return out;
}

FaceContact contact(const WheelFace& a, const WheelFace& b, double near_mm) {
  FaceContact out;
  if ((a.box.low.array() > b.box.high.array() + near_mm).any() ||
      (b.box.low.array() > a.box.high.array() + near_mm).any())
    return out;
  double sum = 0.0;
  for (const Vec3& p : a.border) {
    if (b.box.squared_distance(p) > near_mm * near_mm) continue;
    const BvhHit hit = b.tree.closest(p);
    if (hit.squared_distance > near_mm * near_mm) continue;
    ++out.points;
    const Vec3 to = middle_of(b.mesh, hit.triangle) - p;
    const Vec3 n = normal_of(a.mesh, a.tree.closest(p).triangle);
    if (to.norm() > 0.0) sum += n.dot(to) / to.norm();
  }
  if (out.points > 0) out.bend = sum / out.points;
  return out;
}

NearFace nearest(const std::vector<const WheelFace*>& faces, const Vec3& p) {
  NearFace out;
  double best = 1e300;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (faces[k]->box.squared_distance(p) >= best) continue;
    const BvhHit hit = faces[k]->tree.closest(p);
    if (hit.squared_distance >= best) continue;
    best = hit.squared_distance;
    out.normal = normal_of(faces[k]->mesh, hit.triangle);
    out.point = hit.point;
    out.face = static_cast<int>(k);
    out.height = std::copysign(std::sqrt(best), out.normal.dot(p - hit.point));
  }
  return out;
}

}  // namespace flank::internal
