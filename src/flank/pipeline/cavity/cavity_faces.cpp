#include "flank/pipeline/cavity/cavity_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "flank/base/stopping.h"
#include "flank/error.h"
#include "flank/geom/face_box.h"
#include "flank/trochoid/sides/side_fit.h"

namespace flank::internal {
namespace {

/// Index of the group that has the face.
std::size_t group_of(const std::vector<TargetGroup>& groups, int face) {
  std::size_t g = 0;
  while (g < groups.size() &&
         std::find(groups[g].indices.begin(), groups[g].indices.end(), face) == groups[g].indices.end())
    ++g;
  return g;
}

/// Share of the samples of `side` from which the other one lies in front.
double looks_at(const Target& side, const Target& other) {
  double front = 0.0, all = 0.0;
  for (const SurfaceSample& sample : side.samples(std::sqrt(side.area()) / 15.0)) {
    all += sample.area;
    if (sample.normal.dot(other.closest(sample.point).point - sample.point) > 0.0) front += sample.area;
  }
  return all > 0.0 ? front / all : 0.0;
}

constexpr double kLeastFacing = 0.5;  ///< cosine: at most 60 degrees between the walls

bool face_each_other(const Target& a, const Target& b) {
  return facing(a, b) < -kLeastFacing && looks_at(a, b) > 0.5 && looks_at(b, a) > 0.5;
}

/// Faces of the part by how near their control points may be to a place, which hold all of them: the nearest one first.
std::vector<std::pair<double, int>> nearest_first(const Part& part, const Vec3& place) {
  std::vector<std::pair<double, int>> out;
  for (int f = 0; f < part.face_count(); ++f) {
    if (part.is_left_out(f)) continue;
    const Box3 box = box_of(part.faces[static_cast<std::size_t>(f)]);
    out.emplace_back(std::sqrt(box.squared_distance(place)), f);
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// The nearest other face of the part opposite `left`; empty: none is. Faces much smaller than it are no walls.
std::string face_across(const Part& part, const Target& left) {
  constexpr double kLeastArea = 0.2;
  Vec3 middle = Vec3::Zero();
  for (const SurfaceSample& sample : left.samples(std::sqrt(left.area()) / 10.0))
    middle += sample.area / left.area() * sample.point;
  std::string nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [no_nearer, f] : nearest_first(part, middle)) {
    if (no_nearer >= least) break;
    stop_here();
    const Face& face = part.faces[static_cast<std::size_t>(f)];
    for (const int side : {+1, -1}) {
      const std::unique_ptr<Target> target = make_target({face}, side);
      if (target->area() < kLeastArea * left.area()) break;
      const double distance = (target->closest(middle).point - middle).norm();
      if (distance < least && face_each_other(left, *target)) least = distance, nearest = face.id;
      if (face.of_solid) break;
    }
  }
  return nearest;
}

/// What would be accepted beside the left side.
std::string accepted_across(const TrochoidJob& job, const Part& part) {
  std::vector<Face> left;
  for (const int f : parse_face_list(part, job.left)) left.push_back(part.faces[static_cast<std::size_t>(f)]);
  const bool of_solid = left.front().of_solid;
  for (const int side : {+1, -1}) {
    const std::string across = face_across(part, *make_target(left, side));
    if (!across.empty()) return across + " lies opposite " + job.left;
    if (of_solid) break;
  }
  return "no large enough face of the part lies opposite " + job.left +
         "; a side may be several faces that are joined, like F9,F10";
}

void check_facing(const TrochoidJob& job, const Setup& setup, const Target& left, const Target& right) {
  if (face_each_other(left, right)) return;
  const double cosine = facing(left, right);
  const double degrees = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
  // Walls back to back have opposite normals, too.
  const std::string why =
      cosine < -kLeastFacing
          ? "one lies behind the other"
          : fmt::format("their normals are {:.1f} degrees apart on average (180 is face to face)", degrees);
  throw InputError("right", fmt::format("{} does not face {}: {}; give the two sides of one cavity: {}", job.right,
                                        job.left, why, accepted_across(job, setup.part)));
}

}  // namespace

CavityFaces cavity_faces(const TrochoidJob& job, const Setup& setup) {
  if (setup.part.is_mesh())
    throw InputError("part", setup.part.file + ": is a mesh; a cavity needs faces (STEP, IGES or BREP)");
  CavityFaces out;
  std::vector<TargetGroup> groups = make_targets(setup);
  const std::size_t left = group_of(groups, parse_face_list(setup.part, job.left).front());
  const std::size_t right = group_of(groups, parse_face_list(setup.part, job.right).front());
  if (groups.size() != 2 || left == right || std::max(left, right) > 1)
    throw InputError(
        "right",
        fmt::format("{} and {} make {} connected side{}; expected two, that do not touch each other: {}", job.left,
                    job.right, groups.size(), groups.size() == 1 ? "" : "s", accepted_across(job, setup.part)));
  for (const std::size_t g : {left, right}) out.sides.push_back(std::move(groups[g]));
  check_facing(job, setup, *out.sides[0].target, *out.sides[1].target);
  out.width = width_between(side_of(out.sides[0]), side_of(out.sides[1]));
  return out;
}

}  // namespace flank::internal
