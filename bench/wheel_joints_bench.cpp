// How smooth a wheel is where its operations meet (docs/MATH.md, section 15).
//
// usage: bench_wheel_joints PART FOLDER
//
// FOLDER is what `flank wheel` wrote of PART. At places of every border between two faces of a blade the surface that one operation leaves is
// compared with the surface that the other one leaves at the same place: the step is what their heights over the place differ by, the turn what
// their normals differ by. On each side, up from the hub, the cusp is measured between the passes of the tip and those of the flank: what the
// surfaces to either side of it differ by, a twentieth of a millimetre away. All is that of the swept volume of the poses, as the judge has it.
// Only places count that both have finished.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "flank/feature/recognise_wheel.h"
#include "flank/io/face_names.h"
#include "flank/judge.h"
#include "flank/part.h"
#include "flank/path_file.h"
#include "flank/tool_file.h"
#include "flank/wheel/face_targets.h"

namespace {

using namespace flank;
using namespace flank::internal;

constexpr double kBesideMm = 0.05, kNearMm = 0.02, kToleranceMm = 0.05, kDegrees = 57.29577951308232;
constexpr double kSmooth = 0.98;  ///< the least cosine between normals of two faces: else their border is a corner
constexpr double kClimbMm = 4.0;  ///< up a side, from the hub

/// What a path leaves beside a border, on one of its faces.
struct Left {
  double height = 0.0;
  Vec3 normal = Vec3::Zero(), turned = Vec3::Zero();  ///< of the face; the normal of what is left, less that
  bool flank = false;                                 ///< by a pass of the flank
};

class Finished {
 public:
  Finished(const Tool& tool, Path path) : path_(std::move(path)), volume_(tool, path_) {}
  /// What is left at a place itself; none where that is too much.
  [[nodiscard]] std::optional<Left> at(const Vec3& x) const {
    const SweptDistance left = volume_.distance(x, 1.0);
    if (left.strip < 0 || std::abs(left.f) > kToleranceMm) return {};
    return Left{left.f, (center(left) - x).normalized()};
  }
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
  Path path_;
  SweptVolume volume_;
};

struct Joint {
  std::vector<double> steps_um, turns_deg;
  std::size_t points = 0;
};

void compare(const Left& a, const Left& b, Joint& out) {
  out.steps_um.push_back(1000.0 * std::abs(a.height - b.height));
  out.turns_deg.push_back(kDegrees * (a.turned - b.turned).norm());
}

/// The strips of a kind over a face.
Path strips_of(const Path& path, const std::string& kind, const std::string& face) {
  Path out;
  for (const Strip& strip : path.strips) {
    const std::vector<std::string> faces = face_list_items(strip.face);
    if (strip.kind == kind && std::find(faces.begin(), faces.end(), face) != faces.end()) out.strips.push_back(strip);
  }
  return out;
}

/// Along the border between a side and a face whose operation is another one.
void add(const WheelFace& face, const Target& own, const Target& other, const Finished& flank, const Finished& tip,
         Joint& out) {
  // Each second place is in the middle of a chord, and not on the border.
  for (std::size_t k = 0; k < face.border.size(); k += 2) {
    const Vec3& at = face.border[k];
    const Footpoint foot = other.closest(at);
    if (std::abs(foot.distance) > kNearMm || own.closest(at).normal.dot(foot.normal) < kSmooth) continue;
    ++out.points;
    const std::optional<Left> a = flank.at(at), b = tip.at(at);
    if (!a || !b) continue;
    out.steps_um.push_back(1000.0 * std::abs(a->height - b->height));
    out.turns_deg.push_back(kDegrees * std::acos(std::clamp(a->normal.dot(b->normal), -1.0, 1.0)));
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
  const Tool tool = read_tool(folder + "/tool.json");
  const Finished finished(tool, path);
  FaceTargets targets(part);
  const WheelBlade& blade = roles.blades.front();
  std::map<std::string, std::string> beside;
  for (const std::string& face : blade.edges) beside[face] = "edge";
  for (const RootFillet& fillet : blade.fillets) beside[fillet.face] = "fillet";
  std::map<std::string, Joint> joints;
  for (const WheelFace& face : wheel_faces(part)) {
    const std::vector<std::string> sides = blade.sides();
    if (std::find(sides.begin(), sides.end(), face.id) == sides.end()) continue;
    const Path flank = strips_of(path, "flank", face.id);
    for (const auto& [other, kind] : beside) {
      const Path passes = strips_of(path, kind, other);
      if (!flank.strips.empty() && !passes.strips.empty())
        add(face, *targets.of({face.id}).front(), *targets.of({other}).front(), {tool, flank}, {tool, passes},
            joints["side to " + kind]);
    }
    const Target& own = *targets.of({face.id}).front();
    for (const std::string& hub : roles.hub)
      climb(face, own, *targets.of({hub}).front(), finished, joints["cusp at flank"]);
  }
  std::printf("median, nine tenths and most; cusps %g mm to either side\n", kBesideMm);
  for (const auto& [name, joint] : joints) tell(name, joint);
  return 0;
}
