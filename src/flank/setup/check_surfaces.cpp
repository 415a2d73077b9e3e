#include "flank/setup/check_surfaces.h"

#include <algorithm>

#include "flank/base/parallel.h"
#include "flank/io/cad/triangulate.h"

namespace flank::internal {
namespace {

/// Is any of a face within reach of the target? Judged by points of its surface, so by a little more than its trimmed part.
bool is_near(const BSplineSurface& surface, const Target& target, double reach_mm) {
  constexpr int kPoints = 24;
  std::vector<Vec3> points;
  Box3 face;
  for (int i = 0; i <= kPoints; ++i) {
    for (int j = 0; j <= kPoints; ++j) {
      const double u = surface.u_first() + (surface.u_last() - surface.u_first()) * i / kPoints;
      const double v = surface.v_first() + (surface.v_last() - surface.v_first()) * j / kPoints;
      points.push_back(surface.value(u, v));
      face.add(points.back());
    }
  }
  const double slack = reach_mm + face.diagonal() / kPoints;
  return std::any_of(points.begin(), points.end(), [&](const Vec3& p) {
    return target.box().squared_distance(p) <= slack * slack && target.closest_within(p, slack).patch >= 0;
  });
}

/// Solids of which no face is in `faces`.
std::vector<int> other_solids(const Part& part, const std::vector<int>& faces) {
  std::vector<int> others;
  for (int solid = 0; solid < part.solids; ++solid)
    if (std::none_of(faces.begin(), faces.end(),
                     [&](int k) { return part.faces[static_cast<std::size_t>(k)].solid == solid; }))
      others.push_back(solid);
  return others;
}

std::shared_ptr<const Target> solid_target(const Part& part, int solid) {
  std::vector<Face> faces;
  for (const Face& face : part.faces)
    if (face.solid == solid) faces.push_back(face);
  return faces.empty() ? nullptr : make_target(std::move(faces), +1);
}

/// Does the target touch the solid, or run into it?
bool touches(const Target& target, const Target& solid, double within_mm) {
  constexpr double kSpacingShare = 0.02;
  for (const SurfaceSample& sample : target.samples(kSpacingShare * target.diagonal())) {
    if (solid.box().squared_distance(sample.point) > within_mm * within_mm) continue;
    if (solid.closest(sample.point).distance < within_mm) return true;
  }
  return false;
}

ObstacleMesh as_triangles(const Part& part, int face, double deviation_mm) {
  ObstacleMesh check;
  if (part.is_mesh()) {
    check.mesh = extract_mesh(part, {face});
    return check;
  }
  FaceTriangles triangles = triangulate_face(part.faces[static_cast<std::size_t>(face)], deviation_mm);
  if (triangles.deviation_mm > 1.5 * deviation_mm) check.slack_mm = triangles.deviation_mm;
  check.mesh = std::move(triangles.mesh);
  return check;
}

}  // namespace

Obstacles other_faces(const Part& part, const std::vector<int>& faces, const Target& target, double reach_mm,
                      double deviation_mm) {
  constexpr double kTouchMm = 0.5;
  Obstacles obstacles;
  std::vector<char> left_out(static_cast<std::size_t>(part.face_count()), 0);
  for (const int k : faces) left_out[static_cast<std::size_t>(k)] = 1;
  for (const int solid : part.is_mesh() ? std::vector<int>{} : other_solids(part, faces)) {
    std::shared_ptr<const Target> whole = solid_target(part, solid);
    if (!whole || !touches(target, *whole, kTouchMm)) continue;
    obstacles.solids.push_back(std::move(whole));
    for (std::size_t k = 0; k < left_out.size(); ++k)
      if (part.faces[k].solid == solid) left_out[k] = 1;
  }
  std::vector<int> others;
  for (int k = 0; k < part.face_count(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (left_out[i] == 0 && (part.is_mesh() || is_near(part.faces[i].surface, target, reach_mm))) others.push_back(k);
  }
  obstacles.surfaces.resize(others.size());
  parallel_for(others.size(),
               [&](std::size_t k) { obstacles.surfaces[k] = as_triangles(part, others[k], deviation_mm); });
  return obstacles;
}

std::vector<ObstacleMesh> own_faces(const Part& part, const std::vector<int>& faces, double deviation_mm,
                                    double spare_mm) {
  std::vector<ObstacleMesh> surfaces(faces.size());
  parallel_for(faces.size(), [&](std::size_t k) {
    surfaces[k] = as_triangles(part, faces[k], deviation_mm);
    surfaces[k].slack_mm += spare_mm;
    surfaces[k].flank_may_touch = true;
  });
  return surfaces;
}

}  // namespace flank::internal
