#include "flank/setup/make_obstacles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/geom/face_box.h"
#include "flank/io/cad/triangulate.h"
#include "flank/io/part_format.h"
#include "flank/surface/facets.h"
#include "flank/surface/offset_target.h"

namespace flank::internal {
namespace {

/// Tolerances by which a planner keeps farther from a fixture than the judge asks: it steers by soft terms and by
/// floors below zero (0.8 and 0.65 tolerances), and the judge's bound holds half a tolerance of triangles.
constexpr double kSpareTolerances = 2.0;

/// What a planner keeps where the judge asks for `required_mm`; none: no deeper than the tolerance.
double planned_clearance(const ObstacleChoice& choice) {
  return choice.clearance_mm.value_or(-choice.tolerance_mm) + kSpareTolerances * choice.tolerance_mm;
}

/// Least distance between the box of a face and the target.
double box_gap(const Box3& box, const std::vector<SurfaceSample>& samples) {
  double least = std::numeric_limits<double>::infinity();
  for (const SurfaceSample& sample : samples) least = std::min(least, box.squared_distance(sample.point));
  return std::sqrt(least);
}

/// The face as a surface of its own.
std::unique_ptr<Target> surface_of(const Part& part, int face) {
  if (part.is_mesh()) return make_facets(extract_mesh(part, {face}));
  return make_target(std::vector<Face>{part.faces[static_cast<std::size_t>(face)]});
}

/// Solids of which a face is neither the target's own nor among the others.
std::vector<char> solids_with_unchecked_faces(const Part& part, const ObstacleChoice& choice) {
  std::vector<char> bared(static_cast<std::size_t>(part.solids), 0);
  for (int k = 0; k < static_cast<int>(part.faces.size()); ++k) {
    const int solid = part.faces[static_cast<std::size_t>(k)].solid;
    const bool asked = part.is_left_out(k) || std::binary_search(choice.others.begin(), choice.others.end(), k) ||
                       std::find(choice.own.begin(), choice.own.end(), k) != choice.own.end();
    if (solid >= 0 && !asked) bared[static_cast<std::size_t>(solid)] = 1;
  }
  return bared;
}

/// Those of `faces` within reach of the target's samples, as surfaces. `bared`: of each solid; empty: none is.
void add_surfaces(const Part& part, const std::vector<int>& faces, const std::vector<SurfaceSample>& samples,
                  double reach_mm, double clearance_mm, const std::vector<char>& bared, Obstacles& obstacles) {
  const double reach = reach_mm + clearance_mm;
  std::vector<ObstacleFace> all(faces.size());
  std::vector<char> far(faces.size(), 0);
  parallel_for(faces.size(), [&](std::size_t k) {
    const Face* face = part.is_mesh() ? nullptr : &part.faces[static_cast<std::size_t>(faces[k])];
    // To make a surface that can be asked costs more than all that is asked of most of them.
    far[k] = face != nullptr && box_gap(box_of(*face), samples) > reach;
    if (far[k]) return;
    all[k].surface = surface_of(part, faces[k]);
    all[k].clearance_mm = clearance_mm;
    all[k].oriented = face != nullptr && face->of_solid;
    all[k].bared =
        face != nullptr && face->solid >= 0 && !bared.empty() && bared[static_cast<std::size_t>(face->solid)] != 0;
  });
  for (std::size_t k = 0; k < all.size(); ++k)
    if (far[k] == 0 && box_gap(all[k].surface->box(), samples) <= reach) obstacles.faces.push_back(std::move(all[k]));
}

/// Is any of a face within reach of the target? Judged by points of its surface, so by a little more than its trimmed
/// part.
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
  // Between two points of the grid the surface may come nearer by about a cell.
  const double slack = reach_mm + face.diagonal() / kPoints;
  return std::any_of(points.begin(), points.end(), [&](const Vec3& p) {
    // The box first: most points are far from it, and asking the target costs more.
    return target.box().squared_distance(p) <= slack * slack && target.closest_within(p, slack).patch >= 0;
  });
}

/// Solids all of whose faces are in `faces`.
std::vector<int> whole_solids(const Part& part, const std::vector<int>& faces) {
  std::vector<char> whole(static_cast<std::size_t>(part.solids), 1);
  for (int k = 0; k < static_cast<int>(part.faces.size()); ++k) {
    const int solid = part.faces[static_cast<std::size_t>(k)].solid;
    if (solid >= 0 && !std::binary_search(faces.begin(), faces.end(), k)) whole[static_cast<std::size_t>(solid)] = 0;
  }
  std::vector<int> solids;
  for (int solid = 0; solid < part.solids; ++solid)
    if (whole[static_cast<std::size_t>(solid)] != 0) solids.push_back(solid);
  return solids;
}

/// All faces of a solid as one surface with an inside; null if none of them could be read.
std::unique_ptr<Target> solid_target(const Part& part, int solid) {
  std::vector<Face> faces;
  for (const Face& face : part.faces)
    if (face.solid == solid) faces.push_back(face);
  return faces.empty() ? nullptr : make_target(std::move(faces), +1);
}

/// Does the target touch the solid, or run into it?
bool touches(const Target& target, const Target& solid, double within_mm) {
  constexpr double kSpacingShare = 0.02;
  // At samples 2 % of the target's size apart: what touches it along an edge has several of them.
  for (const SurfaceSample& sample : target.samples(kSpacingShare * target.diagonal())) {
    if (solid.box().squared_distance(sample.point) > within_mm * within_mm) continue;
    if (solid.closest(sample.point).distance < within_mm) return true;
  }
  return false;
}

/// A face as triangles that deviate from it by `deviation_mm`, or its own triangles. What could not be made as fine
/// is told as slack, which the planner keeps besides.
ObstacleMesh as_triangles(const Part& part, int face, double deviation_mm) {
  ObstacleMesh obstacle;
  if (part.is_mesh()) {
    obstacle.mesh = extract_mesh(part, {face});
    return obstacle;
  }
  FaceTriangles triangles = triangulate_face(part.faces[static_cast<std::size_t>(face)], deviation_mm);
  // A little more than asked for is in the spare of every clearance.
  if (triangles.deviation_mm > 1.5 * deviation_mm) obstacle.slack_mm = triangles.deviation_mm;
  obstacle.mesh = std::move(triangles.mesh);
  return obstacle;
}

/// Appends `faces` as triangles, made in parallel.
std::vector<ObstacleMesh> meshes_of(const Part& part, const std::vector<int>& faces, double deviation_mm) {
  std::vector<ObstacleMesh> meshes(faces.size());
  parallel_for(faces.size(), [&](std::size_t k) { meshes[k] = as_triangles(part, faces[k], deviation_mm); });
  return meshes;
}

/// Of `faces`, those within reach.
std::vector<int> near_faces(const Part& part, const std::vector<int>& faces, const Target& target, double reach_mm) {
  std::vector<int> near;
  for (const int k : faces)
    if (part.is_mesh() || is_near(part.faces[static_cast<std::size_t>(k)].surface, target, reach_mm)) near.push_back(k);
  return near;
}

/// The solid with what is left on it.
std::shared_ptr<const Target> with_allowance(std::unique_ptr<Target> solid, double allowance_mm) {
  if (solid == nullptr || !(allowance_mm > 0.0)) return solid;
  return offset_target(std::move(solid), allowance_mm);
}

/// Solids that the target touches, other than its own, whole; of each face of the part whether it is one's.
std::vector<char> add_solids(const Part& part, const Target& target, const ObstacleChoice& choice,
                             Obstacles& obstacles) {
  constexpr double kTouchMm = 0.5;
  std::vector<char> in_solid(static_cast<std::size_t>(part.face_count()), 0);
  for (const int solid : part.is_mesh() ? std::vector<int>{} : whole_solids(part, choice.others)) {
    std::shared_ptr<const Target> whole = with_allowance(solid_target(part, solid), choice.allowance_mm);
    if (!whole || !touches(target, *whole, kTouchMm)) continue;
    obstacles.solids.push_back(std::move(whole));
    for (std::size_t k = 0; k < in_solid.size(); ++k)
      if (part.faces[k].solid == solid) in_solid[k] = 1;
  }
  return in_solid;
}

/// What is in no solid within reach, as triangles. Solids are asked for the flank alone, so shank and holder see their triangles.
void add_meshes(const Part& part, const Target& target, const ObstacleChoice& choice, const ObstacleDetail& detail,
                const std::vector<char>& in_solid, Obstacles& obstacles) {
  const bool above = detail.own_deviation_mm.has_value();
  std::vector<int> others = choice.others;
  // Without shank or holder nobody asks those triangles: the solid answers for the flank.
  if (!above) std::erase_if(others, [&](int k) { return in_solid[static_cast<std::size_t>(k)] != 0; });
  const std::vector<int> near = near_faces(part, others, target, *detail.meshes_within_mm);
  std::vector<ObstacleMesh> meshes = meshes_of(part, near, detail.deviation_mm);
  for (std::size_t k = 0; k < near.size(); ++k) {
    meshes[k].flank_may_touch = in_solid[static_cast<std::size_t>(near[k])] != 0;
    meshes[k].slack_mm += choice.allowance_mm;
    if (choice.clearance_mm) meshes[k].above_clearance_mm = planned_clearance(choice);
    obstacles.meshes.push_back(std::move(meshes[k]));
  }
}

/// All faces of the fixtures: nothing of the tool comes nearer than the clearance.
void add_fixtures(const Target& target, const ObstacleChoice& choice, const ObstacleDetail& detail,
                  const std::vector<SurfaceSample>& samples, Obstacles& obstacles) {
  const double clearance_mm = planned_clearance(choice);
  for (const Part& fixture : choice.fixtures) {
    std::vector<int> faces(static_cast<std::size_t>(fixture.face_count()));
    std::iota(faces.begin(), faces.end(), 0);
    std::erase_if(faces, [&](int face) { return fixture.is_left_out(face); });  // nothing is known of them
    if (detail.faces_within_mm)
      add_surfaces(fixture, faces, samples, *detail.faces_within_mm, clearance_mm, {}, obstacles);
    if (!detail.meshes_within_mm) continue;
    const std::vector<int> near = near_faces(fixture, faces, target, *detail.meshes_within_mm + clearance_mm);
    for (ObstacleMesh& mesh : meshes_of(fixture, near, detail.deviation_mm)) {
      mesh.flank_clearance_mm = mesh.above_clearance_mm = clearance_mm;
      obstacles.meshes.push_back(std::move(mesh));
    }
  }
}

/// The target's own faces for shank and holder, finely: a shank as thick as the flank touches what the flank touches.
void add_own(const Part& part, const ObstacleChoice& choice, const ObstacleDetail& detail, Obstacles& obstacles) {
  for (ObstacleMesh& mesh : meshes_of(part, choice.own, *detail.own_deviation_mm)) {
    mesh.slack_mm += detail.own_spare_mm + choice.allowance_mm;
    mesh.flank_may_touch = true;
    obstacles.meshes.push_back(std::move(mesh));
  }
}

/// Says by which field a missing unit is given: `unit` is that of the part.
Part read_mesh(const std::string& file, const std::optional<std::string>& unit) {
  try {
    return read_part(file, unit);
  } catch (const InputError& e) {
    constexpr std::string_view kField = "give `unit`";
    std::string text = e.what();
    const std::size_t at = unit ? std::string::npos : text.find(kField);
    if (at == std::string::npos) throw;
    throw InputError(text.replace(at, kField.size(), "give `fixture_unit`"));
  }
}

}  // namespace

ObstacleChoice choose_obstacles(const std::vector<int>& own, const std::vector<int>& targets,
                                const std::vector<int>& checks) {
  ObstacleChoice choice;
  choice.own = own;
  choice.others = checks;
  // Another target must not be cut either while this one is machined.
  for (const int face : targets)
    if (std::find(own.begin(), own.end(), face) == own.end()) choice.others.push_back(face);
  std::sort(choice.others.begin(), choice.others.end());
  return choice;
}

Obstacles make_obstacles(const Part& part, const Target& target, const ObstacleChoice& choice,
                         const ObstacleDetail& detail) {
  constexpr int kSamples = 200;
  Obstacles obstacles;
  std::vector<SurfaceSample> samples;
  if (detail.faces_within_mm) {
    // About 200 of them: only the nearness of boxes is measured by them.
    samples = target.samples(std::sqrt(target.area() / kSamples));
    add_surfaces(part, choice.others, samples, *detail.faces_within_mm, choice.allowance_mm,
                 solids_with_unchecked_faces(part, choice), obstacles);
  }
  const std::vector<char> in_solid = add_solids(part, target, choice, obstacles);
  if (detail.meshes_within_mm) add_meshes(part, target, choice, detail, in_solid, obstacles);
  if (detail.own_deviation_mm) add_own(part, choice, detail, obstacles);
  add_fixtures(target, choice, detail, samples, obstacles);
  return obstacles;
}

std::vector<Part> read_fixtures(const std::vector<std::string>& files, const std::optional<std::string>& unit) {
  std::vector<Part> fixtures;
  // A unit is asked of meshes only: a STEP file has its own, and another one on top of it would be refused.
  for (const std::string& file : files)
    fixtures.push_back(is_mesh_file(file) ? read_mesh(file, unit) : read_part(file));
  return fixtures;
}

}  // namespace flank::internal
