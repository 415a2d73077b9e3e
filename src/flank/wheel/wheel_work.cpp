#include "flank/wheel/wheel_work.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/geom/tessellate.h"
#include "flank/io/face_names.h"
#include "flank/path/turning.h"
#include "flank/wheel/point/axis_rod.h"
#include "flank/wheel/swept_boxes.h"

namespace flank::internal {
namespace {

using Names = std::vector<std::string>;

constexpr int kMostSteps = 2000;  ///< of a face, in either direction

void append(Names& to, const Names& more) { to.insert(to.end(), more.begin(), more.end()); }

/// A face, or a piece of it.
bool names_face(const Names& faces, const std::string& face) {
  return std::any_of(faces.begin(), faces.end(), [&](const std::string& name) {
    return "F" + std::to_string(parse_face_name(name).number) == face;
  });
}

bool holds(const Names& faces, const std::string& face) {
  return std::find(faces.begin(), faces.end(), face) != faces.end();
}

/// What stands beside the sector in the wheel and not in the part: faces, and the pitches that they are turned by.
struct TurnedFaces {
  Names faces;
  int turns = 0;
};

std::vector<TurnedFaces> missing_walls(const WheelWork& work) {
  std::vector<TurnedFaces> out;
  for (const MissingBlade& one : missing_beside(work.roles, work.sector)) {
    out.push_back({one.blade.flow(), one.turns});
    append(out.back().faces, one.blade.tips);
  }
  return out;
}

std::vector<TurnedFaces> missing_floor(const WheelWork& work) {
  if (work.sectors_of_hub() >= work.roles.count) return {};
  return {{work.roles.hub, -1}, {work.roles.hub, 1}};
}

std::vector<TurnedFaces> missing_faces(const WheelWork& work) {
  std::vector<TurnedFaces> out = missing_walls(work);
  for (TurnedFaces& more : missing_floor(work)) out.push_back(std::move(more));
  return out;
}

/// All that the wheel has and the part has not.
std::vector<TurnedFaces> all_missing(const WheelWork& work) {
  std::vector<TurnedFaces> out;
  for (const MissingBlade& one : missing_blades(work.roles, work.sector)) {
    out.push_back({one.blade.flow(), one.turns});
    append(out.back().faces, one.blade.tips);
  }
  if (work.sectors_of_hub() < work.roles.count)
    for (int turns = 1; turns < work.roles.count; ++turns) out.push_back({work.roles.hub, turns});
  return out;
}

void add_targets(WheelWork& work, const std::vector<TurnedFaces>& missing, std::vector<const Target*>& out) {
  for (const TurnedFaces& more : missing)
    for (const Target* target : work.targets.turned(more.faces, work.roles.axis, work.sector.pitch_rad, more.turns))
      out.push_back(target);
}

void append_turned(const TriangleMesh& mesh, const WheelWork& work, int turns, TriangleMesh& all) {
  const std::size_t first = all.vertices.size();
  flank::internal::append(all, mesh);
  if (turns == 0) return;
  const Eigen::Isometry3d turn = work.roles.axis.turn(turns * work.sector.pitch_rad);
  for (std::size_t k = first; k < all.vertices.size(); ++k) all.vertices[k] = turn * all.vertices[k];
}

/// Cells that a wheel of any size has about as many of.
std::unique_ptr<DistanceGrid> grid_of(const WheelWork& work, const TriangleBvh& triangles) {
  constexpr double kShare = 1.0 / 400.0, kFinestMm = 0.1, kCoarsestMm = 1.0, kBeyondShare = 0.15;
  const double reach = work.reach_mm();
  const int all = all_missing(work).empty() ? 1 : work.roles.count;
  Box3 box;
  for (const WheelFace& face : work.faces)
    for (int turns = 0; turns < all; ++turns) {
      const Eigen::Isometry3d turn = work.roles.axis.turn(turns * work.sector.pitch_rad);
      for (const Vec3& p : face.mesh.vertices) box.add(turn * p);
    }
  // The tools stand above what they machine.
  return std::make_unique<DistanceGrid>(triangles, box, kBeyondShare * reach,
                                        std::clamp(kShare * reach, kFinestMm, kCoarsestMm));
}

/// Faces of the part and the pitches that they are turned by, of those that boxes may meet.
std::set<std::pair<int, int>> near_faces(const WheelWork& work, const SweptBoxes& swept) {
  const Part& part = work.part;
  const std::vector<TurnedFaces> missing = missing_faces(work);
  std::set<std::pair<int, int>> out;
  const auto add_if_near = [&](int index, int turns) {
    constexpr double kOffMm = 0.5;  // more than triangles are off their faces
    const Eigen::Isometry3d turn = work.roles.axis.turn(turns * work.sector.pitch_rad);
    Box3 box;
    for (const WheelFace& face : work.faces)
      if (face.index == index)
        for (const Vec3& p : face.mesh.vertices) box.add(turn * p);
    box.low.array() -= kOffMm, box.high.array() += kOffMm;
    // What has no triangles has no box either.
    if (box.empty() || swept.meet(box)) out.insert({index, turns});
  };
  for (int k = 0; k < part.face_count(); ++k) {
    if (part.is_left_out(k) || holds(work.roles.debris, part.face_id(k))) continue;
    add_if_near(k, 0);
    for (const TurnedFaces& more : missing)
      if (names_face(more.faces, part.face_id(k))) add_if_near(k, more.turns);
  }
  if (out.empty() && part.face_count() > 0) out.insert({0, 0});
  return out;
}

}  // namespace

std::vector<const Target*> WheelWork::floor() {
  std::vector<const Target*> out = targets.of(roles.hub);
  add_targets(*this, missing_floor(*this), out);
  return out;
}

std::vector<const Target*> WheelWork::walls() {
  std::vector<const Target*> out = targets.of(wall_faces(roles));
  add_targets(*this, missing_walls(*this), out);
  return out;
}

std::vector<const Target*> WheelWork::missing() {
  std::vector<const Target*> out;
  add_targets(*this, missing_faces(*this), out);
  return out;
}

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

Vec3 WheelWork::up() const {
  const bool ahead = is_machined_from_ahead(hub_looks_along(roles, faces), finish.strips, roles.axis);
  return ahead ? roles.axis.direction : Vec3(-roles.axis.direction);
}

PointOptions WheelWork::point_options(const Names& names) {
  constexpr double kWindowShare = 1.1;
  double size = 0.0;
  for (const Target* target : targets.of(names)) size = std::max(size, target->diagonal());
  PointOptions options;
  options.tolerance_mm = job.tolerance_mm;
  options.turn_window_mm = kWindowShare * turn_window(size);
  options.held = {up(), most_tilt_deg * std::numbers::pi / 180.0};
  if (tool) options.shank_mm = shank_radius(*tool);
  return options;
}

const TriangleBvh& WheelWork::coarse_triangles() {
  if (coarse) return *coarse;
  Names names = wall_faces(roles);
  append(names, roles.hub);
  TriangleMesh all;
  for (const WheelFace& face : faces)
    if (holds(names, face.id)) flank::internal::append(all, face.mesh);
  for (const TurnedFaces& more : missing_faces(*this))
    for (const WheelFace& face : faces)
      if (holds(more.faces, face.id)) append_turned(face.mesh, *this, more.turns, all);
  return coarse.emplace(all);
}

const DistanceGrid& WheelWork::distances() {
  if (!grid) grid = grid_of(*this, coarse_triangles());
  return *grid;
}

const DistanceGrid& WheelWork::wheel_distances() {
  if (all_missing(*this).empty()) return distances();
  if (!grid_all_round) grid_all_round = grid_of(*this, wheel_triangles());
  return *grid_all_round;
}

void WheelWork::forget() {
  fine.reset(), grid.reset(), grid_all_round.reset(), coarse.reset(), all_round.reset();
  targets.forget();
}

const TriangleBvh& WheelWork::wheel_triangles() {
  const std::vector<TurnedFaces> lacking = all_missing(*this);
  if (lacking.empty()) return coarse_triangles();
  if (all_round) return *all_round;
  TriangleMesh all;
  Names names = wall_faces(roles);
  append(names, roles.hub);
  for (const WheelFace& face : faces) {
    if (holds(names, face.id)) flank::internal::append(all, face.mesh);
    for (const TurnedFaces& more : lacking)
      if (holds(more.faces, face.id)) append_turned(face.mesh, *this, more.turns, all);
  }
  return all_round.emplace(all);
}

double WheelWork::reach_mm() const {
  double along = 0.0, radius = 0.0, low = 1e300, high = -1e300;
  for (const WheelFace& face : faces)
    for (const Vec3& p : face.mesh.vertices) {
      along = roles.axis.along(p), radius = std::max(radius, roles.axis.radius(p));
      low = std::min(low, along), high = std::max(high, along);
    }
  return std::hypot(2.0 * radius, high - low);
}

const TriangleBvh& WheelWork::guard_triangles(const Path& path, const RadialFunction& radial, double off_mm) {
  // No more than this path asks for: what an earlier one has met must not decide anything here, for it may not be asked in another run.
  std::set<std::pair<int, int>> wanted = near_faces(*this, SweptBoxes(path, radial));
  if (fine && wanted == fine->faces && off_mm == fine->off_mm) return fine->tree;
  fine.reset();
  std::vector<int> counted;
  for (const auto& [face, turns] : wanted)
    if (counted.empty() || counted.back() != face) counted.push_back(face);
  std::vector<TriangleMesh> meshes(counted.size());
  parallel_for(meshes.size(), [&](std::size_t k) {
    const TessellationOptions options{.chord_mm = 0.5 * off_mm, .most_steps = kMostSteps};
    meshes[k] = part.is_mesh() ? extract_mesh(part, {counted[k]})
                               : tessellate(part.faces[static_cast<std::size_t>(counted[k])], options).mesh;
  });
  TriangleMesh all;
  for (std::size_t k = 0; k < counted.size(); ++k) {
    // There are millions of them: none is held twice.
    const TriangleMesh mesh = std::exchange(meshes[k], {});
    for (auto at = wanted.lower_bound({counted[k], std::numeric_limits<int>::min()});
         at != wanted.end() && at->first == counted[k]; ++at)
      append_turned(mesh, *this, at->second, all);
  }
  return fine.emplace(GuardTriangles{std::move(wanted), off_mm, TriangleBvh(all)}).tree;
}

}  // namespace flank::internal
