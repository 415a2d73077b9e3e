#include "flank/limit/least_left.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "flank/geom/face_box.h"
#include "flank/limit/ball_room.h"
#include "flank/target.h"

namespace flank::internal {
namespace {

/// The target with the most material left, if its place is known.
const FaceVerdict* most_left(const VerifyReport& report) {
  const FaceVerdict* most = nullptr;
  for (const FaceVerdict& face : report.faces)
    if (face.target && std::isfinite(face.undercut_mm) && face.undercut_mm > report.tolerance_mm &&
        (most == nullptr || face.undercut_mm > most->undercut_mm))
      most = &face;
  return most;
}

/// Of the targets and of what must not be entered, the faces within a ball's reach of the place. Leaving out others lowers a bound at most.
std::vector<Face> faces_near(const Setup& setup, const Vec3& place, double reach_mm) {
  std::vector<Face> near;
  for (const std::vector<int>* faces : {&setup.targets, &setup.checks})
    for (const int k : *faces) {
      if (setup.part.is_left_out(k)) continue;
      const Face& face = setup.part.faces[static_cast<std::size_t>(k)];
      const Box3 box = box_of(face);
      const Vec3 beyond = (box.low - place).cwiseMax(place - box.high).cwiseMax(Vec3::Zero());
      if (beyond.norm() <= reach_mm) near.push_back(face);
    }
  return near;
}

int face_named(const Part& part, const std::string& name) {
  for (int k = 0; k < part.face_count(); ++k)
    if (part.face_id(k) == name) return k;
  return -1;
}

}  // namespace

std::optional<LeastLeft> least_left(const Setup& setup, const VerifyReport& report) {
  constexpr double kReach = 3.0;  // radii
  constexpr int kCubes = 4000;    // as many take a tenth of a second
  const FaceVerdict* most = most_left(report);
  const double radius = report.reach_radius_mm;
  if (most == nullptr || !(radius > 0.0) || setup.part.is_mesh() || setup.allowance_mm > 0.0) return std::nullopt;
  const int own = face_named(setup.part, most->face);
  std::vector<Face> faces = faces_near(setup, most->undercut_point, kReach * radius);
  if (own < 0 || faces.empty()) return std::nullopt;
  const std::unique_ptr<Target> face = make_target({setup.part.faces[static_cast<std::size_t>(own)]});
  const std::unique_ptr<Target> all = make_target(std::move(faces));
  Box3 place;
  place.add(most->undercut_point);
  const BallRoom room(setup, {all.get()}, {own}, place, radius);
  const Vec3 normal = face->closest(most->undercut_point).normal;
  const LeastError least = least_error(most->undercut_point, normal, room.scene(), radius,
                                       {.gap = 0.1, .enough_mm = report.tolerance_mm, .cubes = kCubes});
  if (!(least.bound_mm > 0.0)) return std::nullopt;
  return LeastLeft{most->face, most->undercut_point, most->undercut_mm, radius, least.bound_mm};
}

}  // namespace flank::internal
