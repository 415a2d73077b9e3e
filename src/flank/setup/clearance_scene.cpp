#include "flank/setup/clearance_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "flank/base/tolerance_budget.h"
#include "flank/geom/face_box.h"
#include "flank/geom/tessellate.h"
#include "flank/io/cad/triangulate.h"

namespace flank::internal {
namespace {

constexpr double kFinestMm = 0.002, kCoarsestMm = 0.02;  ///< deviation of the triangles, about half the tolerance
constexpr double kSizeShare = 1e-3;  ///< of the part: deviation where only what might hold the tool is asked

bool holds(const std::vector<int>& faces, int face) {
  return std::find(faces.begin(), faces.end(), face) != faces.end();
}

/// The triangles as an obstacle, with what is wrong with them.
Obstacle as_obstacle(FaceTriangles face, const std::string& name, ObstacleRole role, double deviation) {
  std::string caveat;
  if (face.deviation_mm > 2.0 * deviation)
    caveat = fmt::format(
        "{}: clearances to it are measured to triangles that follow it within {:.3g} mm; their +- includes that", name,
        face.deviation_mm);
  else if (face.beyond_border)
    caveat = name + ": its border could not be followed; clearances are measured to triangles that may reach beyond it";
  return {name, role, std::move(face.mesh), face.deviation_mm, std::move(caveat)};
}

/// Triangles for the question whether anything stands in a line: by a grid, in milliseconds, where a mesher that is held to a deviation
/// may take minutes for one face that folds. The grid aims at the deviation; twice that is counted.
FaceTriangles coarse_triangles(const Face& face, double deviation) {
  constexpr double kAimed = 2.0;
  FaceTriangles out;
  out.mesh = tessellate(face, {.chord_mm = deviation}).mesh;
  out.deviation_mm = kAimed * deviation;
  return out;
}

/// A face of a part, whose triangles are made when something comes near its box.
struct Place {
  std::string name;
  ObstacleRole role;
  std::shared_ptr<const Face> face;          ///< none of a mesh
  std::shared_ptr<const TriangleMesh> mesh;  ///< none of a CAD part
  Box3 box;

  Place(const Part& part, int k, std::string called, ObstacleRole as) : name(std::move(called)), role(as) {
    if (part.is_mesh())
      mesh = std::make_shared<const TriangleMesh>(extract_mesh(part, {k}));
    else
      face = std::make_shared<const Face>(part.faces[static_cast<std::size_t>(k)]);
    box = mesh ? mesh->box() : box_of(*face);
  }

  [[nodiscard]] DistantObstacle cut(double deviation, FaceTriangles (*triangles)(const Face&, double)) const {
    return {name, role, box, [of = *this, deviation, triangles] {
              if (of.mesh) return Obstacle{of.name, of.role, *of.mesh, 0.0, {}};
              return as_obstacle(triangles(*of.face, deviation), of.name, of.role, deviation);
            }};
  }
};

/// The faces that count.
std::vector<Place> places_of(const Setup& setup) {
  const Part& part = setup.part;
  std::vector<Place> places;
  for (int k = 0; k < part.face_count(); ++k) {
    const bool target = holds(setup.targets, k);
    if ((!target && !holds(setup.checks, k)) || part.is_left_out(k)) continue;
    places.emplace_back(part, k, part.face_id(k), target ? ObstacleRole::kTarget : ObstacleRole::kPart);
  }
  return places;
}

void add_fixture(const Part& fixture, double deviation, std::vector<DistantObstacle>& obstacles,
                 std::vector<std::string>& notes) {
  for (const std::string& repair : fixture.repairs) notes.push_back(fixture.file + ": " + repair);
  const std::string short_name = std::filesystem::path(fixture.file).filename().string();
  for (int k = 0; k < fixture.face_count(); ++k)
    if (!fixture.is_left_out(k))
      obstacles.push_back(Place(fixture, k, short_name + " " + fixture.face_id(k), ObstacleRole::kFixture)
                              .cut(deviation, triangulate_face));
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
  const double coarse = std::max(kCoarsestMm, kSizeShare * setup.part.box.diagonal());
  std::vector<DistantObstacle> obstacles, sight;
  for (const Place& place : places_of(setup)) {
    sight.push_back(place.cut(coarse, coarse_triangles));
    obstacles.push_back(has_body ? place.cut(deviation, triangulate_face) : sight.back());
  }
  scene.sight = ObstacleSet(std::move(sight));
  for (const Part& fixture : setup.fixtures) add_fixture(fixture, deviation, obstacles, notes);
  scene.obstacles = ObstacleSet(std::move(obstacles));
  return scene;
}

void measure_bodies(const ClearanceScene& scene, const Tool& tool, const Path& path, VerifyReport& report) {
  report.clearance = measure_clearance(scene, tool, path);
  report.hold = judge_hold(tool, path, scene.obstacles, scene.options);
}

void add_caveats(const VerifyReport& report, std::vector<std::string>& notes) {
  notes.insert(notes.end(), report.clearance.notes.begin(), report.clearance.notes.end());
}

namespace {

bool anything_to_judge(const ClearanceScene& scene) {
  return scene.has_body || std::any_of(scene.obstacles.obstacles().begin(), scene.obstacles.obstacles().end(),
                                       [](const DistantObstacle& o) { return o.role == ObstacleRole::kFixture; });
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
