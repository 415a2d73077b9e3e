#include "flank/limit/least_left.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "flank/geom/face_box.h"
#include "flank/limit/ball_bound.h"
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

/// Of the targets and of what must not be entered, the faces within a ball's reach of the box. Leaving out others lowers a bound at most.
std::vector<Face> faces_near(const Setup& setup, const Box3& box, double reach_mm) {
  std::vector<Face> all;
  for (const std::vector<int>* faces : {&setup.targets, &setup.checks})
    for (const int k : *faces) {
      if (setup.part.is_left_out(k)) continue;
      const Face& face = setup.part.faces[static_cast<std::size_t>(k)];
      if (near(box_of(face), box, reach_mm)) all.push_back(face);
    }
  return all;
}

int face_named(const Part& part, const std::string& name) {
  for (int k = 0; k < part.face_count(); ++k)
    if (part.face_id(k) == name) return k;
  return -1;
}

}  // namespace

std::optional<LeastLeft> least_left(const Setup& setup, const VerifyReport& report, double radius_mm) {
  constexpr double kReach = 3.0;                // radii
  constexpr double kSites = 40.0;               // of the first net
  constexpr int kNets = 3, kCubesOfSite = 500;  // together half a second
  constexpr int kCubes = 4000;                  // where most is left: a tenth of a second
  constexpr double kGap = 0.1;
  const FaceVerdict* most = most_left(report);
  if (most == nullptr || !(radius_mm > 0.0) || setup.part.is_mesh() || setup.allowance_mm > 0.0) return std::nullopt;
  const int own = face_named(setup.part, most->face);
  if (own < 0) return std::nullopt;
  const Face& left = setup.part.faces[static_cast<std::size_t>(own)];
  const Box3 box = box_of(left);
  const std::unique_ptr<Target> face = make_target({left}),
                                all = make_target(faces_near(setup, box, kReach * radius_mm));
  const BallRoom room(setup, {all.get()}, {own}, box, radius_mm);
  const BallBound net = ball_bound(*face, room.scene(),
                                   {.radius_mm = radius_mm,
                                    .tolerance_mm = report.tolerance_mm,
                                    .spacing_mm = std::sqrt(face->area() / kSites),
                                    .gap = kGap,
                                    .levels = kNets,
                                    .cubes = kCubesOfSite},
                                   {});
  const LeastError place =
      least_error(most->undercut_point, face->closest(most->undercut_point).normal, room.scene(), radius_mm,
                  {.gap = kGap, .enough_mm = std::max(report.tolerance_mm, net.bound_mm), .cubes = kCubes});
  const bool there = place.bound_mm > net.bound_mm;
  const double bound = there ? place.bound_mm : net.bound_mm;
  if (!(bound > 0.0)) return std::nullopt;
  return LeastLeft{most->face, there ? most->undercut_point : net.point, most->undercut_mm, radius_mm, bound};
}

}  // namespace flank::internal
