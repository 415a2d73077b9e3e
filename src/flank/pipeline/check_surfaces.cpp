#include "flank/pipeline/check_surfaces.h"

#include <algorithm>

#include "flank/base/parallel.h"
#include "flank/io/triangulate.h"

namespace flank {
namespace {

/// Is any of a face near the box? Judged by points of its surface, so by a little more than its trimmed part.
bool is_near(const BSplineSurface& surface, const Box3& box, double reach_mm) {
  constexpr int kPoints = 24;
  Box3 face;
  for (int i = 0; i <= kPoints; ++i) {
    for (int j = 0; j <= kPoints; ++j) {
      const double u = surface.u_first() + (surface.u_last() - surface.u_first()) * i / kPoints;
      const double v = surface.v_first() + (surface.v_last() - surface.v_first()) * j / kPoints;
      face.add(surface.value(u, v));
    }
  }
  const double slack = reach_mm + face.diagonal() / kPoints;
  return (face.low.array() <= box.high.array() + slack).all() && (face.high.array() >= box.low.array() - slack).all();
}

}  // namespace

std::vector<CheckSurface> other_faces(const Part& part, const std::vector<int>& faces, const Box3& box, double reach_mm,
                                      double deviation_mm) {
  std::vector<int> others;
  for (int k = 0; k < part.face_count(); ++k) {
    if (std::find(faces.begin(), faces.end(), k) != faces.end()) continue;
    if (part.is_mesh() || is_near(part.faces[static_cast<std::size_t>(k)].surface, box, reach_mm)) others.push_back(k);
  }
  std::vector<CheckSurface> checks(others.size());
  parallel_for(others.size(), [&](std::size_t k) {
    checks[k].mesh = part.is_mesh()
                         ? extract_mesh(part, {others[k]})
                         : triangulate_face(part.faces[static_cast<std::size_t>(others[k])], deviation_mm).mesh;
  });
  return checks;
}

}  // namespace flank
