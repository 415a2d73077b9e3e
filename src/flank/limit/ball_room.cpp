#include "flank/limit/ball_room.h"

#include <algorithm>
#include <map>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/geom/face_box.h"
#include "flank/geom/tessellate.h"

namespace flank::internal {
namespace {

constexpr double kChordShare = 0.05;   ///< of the radius: of the triangles from the faces
constexpr double kReach = 3.0;         ///< radii in which a solid matters, and its triangles must be near its faces
constexpr double kCoarseShare = 1e-3;  ///< of the part: of triangles that are farther

/// Finely where balls may come, else as closed as that needs.
TriangleMesh joined(const Part& part, const std::vector<int>& faces, const Box3& near, double radius_mm) {
  std::vector<TriangleMesh> meshes(faces.size());
  parallel_for(meshes.size(), [&](std::size_t k) {
    const Face& face = part.faces[static_cast<std::size_t>(faces[k])];
    const bool fine = internal::near(box_of(face), near, kReach * radius_mm);
    const double chord = kChordShare * radius_mm;
    meshes[k] = tessellate(face, {.chord_mm = fine ? chord : std::max(chord, kCoarseShare * part.box.diagonal())}).mesh;
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

}  // namespace

BallRoom::BallRoom(const Setup& setup, std::vector<const Target*> faces, const std::vector<int>& own, const Box3& near,
                   double radius_mm) {
  scene_.faces = std::move(faces);
  if (setup.part.is_mesh()) return;
  for (const auto& [solid, of_solid] : whole_solids(setup)) {
    Box3 box;
    for (const int face : of_solid) box.add(box_of(setup.part.faces[static_cast<std::size_t>(face)]));
    if (!internal::near(box, near, kReach * radius_mm)) continue;
    solids_.emplace_back(joined(setup.part, of_solid, near, radius_mm));
    scene_.of_solid = scene_.of_solid || std::find(of_solid.begin(), of_solid.end(), own.front()) != of_solid.end();
  }
  for (const verify::Winding& solid : solids_) scene_.solids.push_back(&solid);
}

}  // namespace flank::internal
