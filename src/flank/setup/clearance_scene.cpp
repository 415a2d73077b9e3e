#include "flank/setup/clearance_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "flank/base/parallel.h"
#include "flank/base/tolerance_budget.h"
#include "flank/geom/tessellate.h"
#include "flank/io/cad/triangulate.h"

namespace flank::internal {
namespace {

constexpr double kFinestMm = 0.002, kCoarsestMm = 0.02;  ///< deviation of the triangles, about half the tolerance
constexpr double kSizeShare = 1e-3;  ///< of the part: deviation where only what might hold the tool is asked

bool holds(const std::vector<int>& faces, std::size_t face) {
  return std::find(faces.begin(), faces.end(), static_cast<int>(face)) != faces.end();
}

/// The triangles as an obstacle; `notes` gets what is wrong with them.
Obstacle as_obstacle(FaceTriangles face, const std::string& name, ObstacleRole role, double deviation,
                     std::vector<std::string>& notes) {
  if (face.deviation_mm > 2.0 * deviation)
    notes.push_back(fmt::format(
        "{}: clearances to it are measured to triangles that follow it within {:.3g} mm; their +- includes that", name,
        face.deviation_mm));
  if (face.beyond_border)
    notes.push_back(
        name + ": its border could not be followed; clearances are measured to triangles that may reach beyond it");
  return {name, role, std::move(face.mesh), face.deviation_mm};
}

/// Triangles for the question whether anything stands in a line: by a grid, in milliseconds, where a mesher that is held to a deviation
/// may take minutes for one face that folds. The grid aims at the deviation; twice that is counted.
std::vector<FaceTriangles> coarse_triangles(const Part& part, double deviation) {
  constexpr double kAimed = 2.0;
  std::vector<FaceTriangles> faces(part.faces.size());
  parallel_for(faces.size(), [&](std::size_t k) {
    faces[k].face = part.face_id(static_cast<int>(k));
    if (part.left_out.contains(static_cast<int>(k))) return;  // it has no surface
    faces[k].mesh = tessellate(part.faces[k], {.chord_mm = deviation}).mesh;
    faces[k].deviation_mm = kAimed * deviation;
  });
  return faces;
}

void add_part(const Setup& setup, double deviation, bool coarse, std::vector<Obstacle>& obstacles,
              std::vector<std::string>& notes) {
  std::vector<FaceTriangles> faces =
      coarse && !setup.part.is_mesh() ? coarse_triangles(setup.part, deviation) : triangulate(setup.part, deviation);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const bool target = holds(setup.targets, k);
    if (!target && !holds(setup.checks, k)) continue;
    const std::string name = faces[k].face;
    const ObstacleRole role = target ? ObstacleRole::kTarget : ObstacleRole::kPart;
    obstacles.push_back(as_obstacle(std::move(faces[k]), name, role, deviation, notes));
  }
}

void add_fixture(const Part& fixture, double deviation, std::vector<Obstacle>& obstacles,
                 std::vector<std::string>& notes) {
  for (const std::string& repair : fixture.repairs) notes.push_back(fixture.file + ": " + repair);
  const std::string short_name = std::filesystem::path(fixture.file).filename().string();
  for (FaceTriangles& face : triangulate(fixture, deviation)) {
    if (face.mesh.triangles.empty()) continue;
    const std::string name = short_name + " " + face.face;
    obstacles.push_back(as_obstacle(std::move(face), name, ObstacleRole::kFixture, deviation, notes));
  }
}

}  // namespace

ClearanceScene make_clearance_scene(const Setup& setup, const ObstacleRequest& request, bool has_body,
                                    std::vector<std::string>& notes) {
  ClearanceScene scene;
  scene.options.tolerance_mm = setup.tolerance_mm;
  scene.options.required_mm = request.clearance_mm.value_or(-1.0);
  scene.options.allowance_mm = setup.allowance_mm;
  scene.has_body = has_body;
  const double deviation =
      std::clamp(kToleranceBudget.shank.judge_triangles * setup.tolerance_mm, kFinestMm, kCoarsestMm);
  // Whether something is in the way of a tool that is not known yet need not be told to a hundredth of a millimetre.
  std::vector<std::string> unsaid;
  add_part(setup, has_body ? deviation : std::max(kCoarsestMm, kSizeShare * setup.part.box.diagonal()), !has_body,
           scene.obstacles, has_body ? notes : unsaid);
  for (const Part& fixture : setup.fixtures) add_fixture(fixture, deviation, scene.obstacles, notes);
  return scene;
}

void measure_bodies(const ClearanceScene& scene, const Tool& tool, const Path& path, VerifyReport& report) {
  report.clearance = measure_clearance(scene, tool, path);
  report.hold = judge_hold(tool, path, scene.obstacles, scene.options);
}

namespace {

bool anything_to_judge(const ClearanceScene& scene) {
  return scene.has_body || std::any_of(scene.obstacles.begin(), scene.obstacles.end(),
                                       [](const Obstacle& o) { return o.role == ObstacleRole::kFixture; });
}

}  // namespace

ClearanceReport measure_clearance(const ClearanceScene& scene, const Tool& tool, const Path& path) {
  if (!anything_to_judge(scene)) return {};
  return judge_clearance(tool, path, scene.obstacles, scene.options);
}

bool keeps_clear(const ClearanceScene& scene, const Tool& tool, const Path& path, double shank_least_mm) {
  return !anything_to_judge(scene) || flank::keeps_clear(tool, path, scene.obstacles, scene.options, shank_least_mm);
}

}  // namespace flank::internal
