#include "flank/bound/ball_room.h"

#include <algorithm>
#include <map>

#include "flank/base/parallel.h"
#include "flank/geom/tessellate.h"

namespace flank::internal {
namespace {

constexpr double kChordShare = 0.05;  ///< of the radius: of the triangles from the faces
constexpr double kReach = 3.0;        ///< radii round the target in which a solid matters

TriangleMesh joined(const Part& part, const std::vector<int>& faces, double chord_mm) {
  std::vector<TriangleMesh> meshes(faces.size());
  parallel_for(meshes.size(), [&](std::size_t k) {
    meshes[k] = tessellate(part.faces[static_cast<std::size_t>(faces[k])], {.chord_mm = chord_mm}).mesh;
  });
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes) append(all, mesh);
  return all;
}

/// The faces of each solid all of whose faces count.
std::map<int, std::vector<int>> whole_solids(const Setup& setup) {
  const Part& part = setup.part;
  std::vector<char> counts(static_cast<std::size_t>(part.face_count()), 0);
  for (const std::vector<int>* faces : {&setup.targets, &setup.checks})
    for (const int face : *faces) counts[static_cast<std::size_t>(face)] = 1;
  std::map<int, std::vector<int>> solids;
  for (int face = 0; face < part.face_count(); ++face)
    solids[part.faces[static_cast<std::size_t>(face)].solid].push_back(face);
  std::erase_if(solids, [&](const auto& solid) {
    return solid.first < 0 || !std::all_of(solid.second.begin(), solid.second.end(), [&](int face) {
             return counts[static_cast<std::size_t>(face)] != 0 && !part.is_left_out(face);
           });
  });
  return solids;
}

bool is_near(const Box3& a, const Box3& b, double mm) {
  return (a.low.array() <= b.high.array() + mm).all() && (b.low.array() <= a.high.array() + mm).all();
}

}  // namespace

BallRoom::BallRoom(const BoundSetup& setup, std::size_t group, double radius_mm) {
  for (const TargetGroup& each : setup.groups) scene_.faces.push_back(each.target.get());
  for (const Target* other : setup.avoided()) scene_.faces.push_back(other);
  if (setup.setup.part.is_mesh()) return;
  const TargetGroup& own = setup.groups[group];
  for (const auto& [solid, faces] : whole_solids(setup.setup)) {
    Box3 box;
    for (const int face : faces)
      for (const Vec3& pole : setup.setup.part.faces[static_cast<std::size_t>(face)].surface.poles) box.add(pole);
    if (!is_near(box, own.target->box(), kReach * radius_mm)) continue;
    solids_.emplace_back(joined(setup.setup.part, faces, kChordShare * radius_mm));
    scene_.of_solid = scene_.of_solid || std::find(faces.begin(), faces.end(), own.indices.front()) != faces.end();
  }
  for (const verify::Winding& solid : solids_) scene_.solids.push_back(&solid);
}

}  // namespace flank::internal
