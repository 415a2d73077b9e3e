// How smooth a wheel is where its operations meet: steps and turns of the normal of what is left, across the borders of its faces.
//
// usage: bench_wheel_joints PART FOLDER
//
// FOLDER is what `flank wheel` wrote of PART. Along every border between two faces of a blade, and between blade and hub, the surface that the
// whole path leaves is compared with the faces a twentieth of a millimetre to either side: the step is what its heights over the two faces
// differ by, the turn what its normals differ by, less what the faces' own normals do. A corner has no such turn. On each side, up from the hub,
// the same is measured across the place where passes of the flank follow on those of the tip. All is that of the swept volume of the poses, as
// the judge has it. Only places count of which both sides are finished.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "flank/feature/recognise_wheel.h"
#include "flank/judge.h"
#include "flank/part.h"
#include "flank/path_file.h"
#include "flank/tool_file.h"
#include "flank/wheel/face_targets.h"

namespace {

using namespace flank;
using namespace flank::internal;

constexpr double kBesideMm = 0.05, kNearMm = 0.02, kToleranceMm = 0.05, kDegrees = 57.29577951308232;
constexpr double kSmooth = 0.2;   ///< that normals of two faces differ by, as vectors: more is a corner
constexpr double kClimbMm = 4.0;  ///< up a side, from the hub

/// What a path leaves beside a border, on one of its faces.
struct Left {
  double height = 0.0;
  Vec3 normal = Vec3::Zero(), turned = Vec3::Zero();  ///< of the face; the normal of what is left, less that
  bool flank = false;                                 ///< by a pass of the flank
};

class Finished {
 public:
  Finished(const Tool& tool, const Path& path) : path_(path), volume_(tool, path) {}
  /// So far from the border. None where too much is left, or the face ends.
  [[nodiscard]] std::optional<Left> beside(const Target& face, const Vec3& border, const Vec3& along,
                                           double far) const {
    const Footpoint at = face.closest(border);
    const Vec3 across = at.normal.cross(along).normalized();
    for (const double sign : {1.0, -1.0}) {
      const Footpoint foot = face.closest(border + sign * far * across);
      if (foot.location != Location::kInside || (foot.point - border).norm() < 0.5 * far) continue;
      const SweptDistance left = volume_.distance(foot.point, 1.0);
      if (left.strip < 0 || left.f > kToleranceMm) return {};
      return Left{left.f, foot.normal, (center(left) - foot.point).normalized() - foot.normal,
                  path_.strips[static_cast<std::size_t>(left.strip)].kind == "flank"};
    }
    return {};
  }

 private:
  [[nodiscard]] Vec3 center(const SweptDistance& at) const {
    const std::vector<Pose>& poses = path_.strips[static_cast<std::size_t>(at.strip)].poses;
    const auto k = std::min(static_cast<std::size_t>(at.t), poses.size() - 2);
    const double t = at.t - static_cast<double>(k);
    const Vec3 axis = ((1.0 - t) * poses[k].axis + t * poses[k + 1].axis).normalized();
    return (1.0 - t) * poses[k].tip + t * poses[k + 1].tip + at.s * axis;
  }
  const Path& path_;
  SweptVolume volume_;
};

struct Joint {
  std::vector<double> steps_um, turns_deg;
  std::size_t points = 0;
};

void compare(const Left& a, const Left& b, Joint& out) {
  out.steps_um.push_back(1000.0 * std::abs(a.height - b.height));
  if ((a.normal - b.normal).norm() < kSmooth) out.turns_deg.push_back(kDegrees * (a.turned - b.turned).norm());
}

void add(const WheelFace& face, const Target& own, const Target& other, const Finished& finished, Joint& out) {
  for (std::size_t k = 1; k + 1 < face.border.size(); ++k) {
    const Vec3 &before = face.border[k - 1], &at = face.border[k], &after = face.border[k + 1];
    // Loops follow each other in the list.
    if ((after - before).norm() > 5.0 || (after - before).norm() < 1e-6) continue;
    if (std::abs(other.closest(at).distance) > kNearMm) continue;
    ++out.points;
    const Vec3 along = (after - before).normalized();
    const std::optional<Left> a = finished.beside(own, at, along, kBesideMm),
                              b = finished.beside(other, at, along, kBesideMm);
    if (a && b) compare(*a, *b, out);
  }
}

/// Up a side from its border at the hub or a fillet: where the flank follows on the tip.
void climb(const WheelFace& face, const Target& own, const Target& foot, const Finished& finished, Joint& out) {
  for (std::size_t k = 1; k + 1 < face.border.size(); ++k) {
    const Vec3 &before = face.border[k - 1], &at = face.border[k], &after = face.border[k + 1];
    if ((after - before).norm() > 5.0 || (after - before).norm() < 1e-6) continue;
    if (std::abs(foot.closest(at).distance) > kNearMm) continue;
    ++out.points;
    std::optional<Left> last;
    for (double far = kBesideMm; far < kClimbMm; far += 2.0 * kBesideMm) {
      const std::optional<Left> here = finished.beside(own, at, (after - before).normalized(), far);
      if (here && last && here->flank && !last->flank) {
        compare(*last, *here, out);
        break;
      }
      last = here;
    }
  }
}

double share(std::vector<double> values, double of) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[static_cast<std::size_t>(of * (static_cast<double>(values.size()) - 1.0))];
}

void tell(const std::string& name, const Joint& joint) {
  if (joint.points == 0) return;
  std::printf("%-14s %6zu of %6zu places  step %6.2f %6.2f %6.2f um   turn %6.2f %6.2f %6.2f degrees\n", name.c_str(),
              joint.steps_um.size(), joint.points, share(joint.steps_um, 0.5), share(joint.steps_um, 0.9),
              share(joint.steps_um, 1.0), share(joint.turns_deg, 0.5), share(joint.turns_deg, 0.9),
              share(joint.turns_deg, 1.0));
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::fprintf(stderr, "usage: bench_wheel_joints PART FOLDER\n");
    return 2;
  }
  const Part part = read_part(words[1], {});
  const std::string folder = words[2];
  const WheelRoles roles = recognise_wheel(part, {});
  const Path path = read_path(folder + "/path.json");
  const Finished finished(read_tool(folder + "/tool.json"), path);
  FaceTargets targets(part);
  std::map<std::string, std::string> role;
  for (const std::string& face : roles.hub) role[face] = "hub";
  const WheelBlade& blade = roles.blades.front();
  for (const std::string& face : blade.sides()) role[face] = "side";
  for (const std::string& face : blade.edges) role[face] = "edge";
  for (const RootFillet& fillet : blade.fillets) role[fillet.face] = "fillet";
  std::map<std::string, Joint> joints;
  const std::vector<WheelFace> faces = wheel_faces(part);
  for (const WheelFace& face : faces) {
    if (!role.contains(face.id) || role[face.id] == "hub") continue;
    for (const auto& [other, what] : role) {
      // Of two faces of a blade each has the border; it is looked at once.
      if (other == face.id || (what != "hub" && other < face.id)) continue;
      const std::string name = std::min(role[face.id], what) + " to " + std::max(role[face.id], what);
      const Target &own = *targets.of({face.id}).front(), &beside = *targets.of({other}).front();
      add(face, own, beside, finished, joints[name]);
      if (role[face.id] == "side" && (what == "hub" || what == "fillet"))
        climb(face, own, beside, finished, joints["tip to flank"]);
    }
  }
  std::printf("median, nine tenths and most, %g mm to either side of a border\n", kBesideMm);
  for (const auto& [name, joint] : joints) tell(name, joint);
  return 0;
}
