#include "flank/wheel/wheel_work.h"

#include <algorithm>

#include "flank/base/parallel.h"
#include "flank/geom/tessellate.h"
#include "flank/path/turning.h"

namespace flank::internal {
namespace {

using Names = std::vector<std::string>;

constexpr int kMostSteps = 2000;  ///< of a face, in either direction

void append(Names& to, const Names& more) { to.insert(to.end(), more.begin(), more.end()); }

bool holds(const Names& faces, const std::string& face) {
  return std::find(faces.begin(), faces.end(), face) != faces.end();
}

}  // namespace

Names wall_faces(const WheelRoles& roles) {
  Names out = roles.shroud;
  for (const WheelBlade& blade : roles.blades) {
    append(out, blade.flow());
    append(out, blade.tips);
  }
  for (const std::string& face : roles.rest)
    if (!holds(roles.debris, face)) out.push_back(face);
  return out;
}

double WheelWork::turn_window() {
  Names flow = roles.hub;
  for (const WheelBlade& blade : sector.blades) append(flow, blade.flow());
  double size = 0.0;
  for (const Target* target : targets.of(flow)) size = std::max(size, target->diagonal());
  return 1.1 * flank::internal::turn_window(size);
}

const TriangleBvh& WheelWork::coarse_triangles() {
  if (coarse) return *coarse;
  Names names = wall_faces(roles);
  append(names, roles.hub);
  TriangleMesh all;
  for (const WheelFace& face : faces)
    if (holds(names, face.id)) flank::internal::append(all, face.mesh);
  return coarse.emplace(all);
}

const TriangleBvh& WheelWork::guard_triangles() {
  if (fine) return *fine;
  std::vector<int> counted;
  for (int k = 0; k < part.face_count(); ++k)
    if (!part.is_left_out(k) && !holds(roles.debris, part.face_id(k))) counted.push_back(k);
  std::vector<TriangleMesh> meshes(counted.size());
  parallel_for(meshes.size(), [&](std::size_t k) {
    const TessellationOptions options{.chord_mm = 0.5 * kGuardShare * job.tolerance_mm, .most_steps = kMostSteps};
    meshes[k] = part.is_mesh() ? extract_mesh(part, {counted[k]})
                               : tessellate(part.faces[static_cast<std::size_t>(counted[k])], options).mesh;
  });
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes) flank::internal::append(all, mesh);
  return fine.emplace(all);
}

}  // namespace flank::internal
