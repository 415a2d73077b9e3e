#include "flank/feature/recognise_wheel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "flank/error.h"
#include "flank/feature/blade_roles.h"

namespace flank::internal {
namespace {

constexpr double kSameArea = 0.04;   ///< blades whose areas and places differ by less are equal
constexpr double kSamePlace = 0.01;  ///< of the size
constexpr double kSpacingDeg = 0.5;  ///< by which equal blades may stand off their places
constexpr int kOutlinePoints = 24;
constexpr double kDebrisShare =
    0.01;  ///< of the size: solids that are smaller and touch nothing are no part of the wheel
constexpr double kOverTipsShare = 0.5;  ///< of the blades' height, by which the tips are nearer than the hub

[[noreturn]] void refuse(const Part& part, const std::string& what) {
  throw InputError(fmt::format("{}: not recognised as a wheel: {}", part.file, what));
}

std::vector<const WheelFace*> faces_named(const Part& part, const std::vector<WheelFace>& faces,
                                          const std::string& list) {
  const std::vector<int> indices = parse_face_list(part, list);
  std::vector<const WheelFace*> out;
  for (const WheelFace& face : faces)
    if (std::find(indices.begin(), indices.end(), face.index) != indices.end()) out.push_back(&face);
  return out;
}

/// Where the middle of a blade is, along the axis and from it.
Vec2 middle(const BladeFaces& blade, const WheelAxis& axis) {
  Vec2 sum = Vec2::Zero();
  double area = 0.0;
  for (const WheelFace* face : blade.faces)
    for (const FaceSample& s : face->samples)
      sum += s.area * Vec2(axis.along(s.point), axis.radius(s.point)), area += s.area;
  return sum / area;
}

/// Equal blades, each group with its members, the largest blades first.
std::vector<std::vector<std::size_t>> equal_blades(const std::vector<BladeFaces>& blades, const WheelAxis& axis,
                                                   double size_mm) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < blades.size(); ++k) {
    const auto same = [&](const std::vector<std::size_t>& group) {
      const BladeFaces& first = blades[group.front()];
      return std::abs(blades[k].area - first.area) < kSameArea * first.area &&
             (middle(blades[k], axis) - middle(first, axis)).norm() < kSamePlace * size_mm;
    };
    const auto found = std::find_if(groups.begin(), groups.end(), same);
    if (found == groups.end())
      groups.push_back({k});
    else
      found->push_back(k);
  }
  return groups;
}

/// Sectors in a whole turn, from the angles of equal blades. 0: they do not stand evenly, or there is one alone.
int sectors_of(std::vector<double> angles) {
  if (angles.size() < 2) return 0;
  std::sort(angles.begin(), angles.end());
  double least = 360.0;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double next = k + 1 < angles.size() ? angles[k + 1] : angles.front() + 360.0;
    least = std::min(least, next - angles[k]);
  }
  const int count = static_cast<int>(std::lround(360.0 / least));
  const double pitch = 360.0 / count;
  for (const double angle : angles) {
    const double steps = (angle - angles.front()) / pitch;
    if (std::abs(steps - std::round(steps)) * pitch > kSpacingDeg) return 0;
  }
  return count;
}

/// Of a sector with one blade: the angle between the planes through the axis that it is cut with.
int sectors_of_cuts(const std::vector<WheelFace>& faces, const WheelAxis& axis, double size_mm) {
  std::vector<Vec3> normals;
  for (const WheelFace& face : faces) {
    const FaceSample& s = face.samples.front();
    if (face.type == "plane" && std::abs(s.normal.dot(axis.direction)) < 1e-3 &&
        std::abs(s.normal.dot(s.point - axis.point)) < 1e-3 * size_mm)
      normals.push_back(s.normal);
  }
  if (normals.size() != 2) return 0;
  const double between = std::acos(std::clamp(-normals[0].dot(normals[1]), -1.0, 1.0));
  return between > 1e-3 ? static_cast<int>(std::lround(2.0 * 3.141592653589793 / between)) : 0;
}

/// Over the tips of the main blades, from the one end to the other.
std::vector<Vec2> outline_of(const WheelRoles& roles, const std::vector<WheelFace>& faces) {
  std::set<std::string> tips;
  for (const WheelBlade& blade : roles.blades)
    if (!blade.splitter) tips.insert(blade.tips.begin(), blade.tips.end());
  std::vector<Vec2> all;
  for (const WheelFace& face : faces)
    if (tips.count(face.id) > 0)
      for (const FaceSample& s : face.samples) all.emplace_back(roles.axis.along(s.point), roles.axis.radius(s.point));
  if (all.size() < 2) return {};
  Box3 box;
  for (const Vec2& p : all) box.add(Vec3(p.x(), p.y(), 0.0));
  const auto by_x = [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); };
  const Vec2 first = *std::min_element(all.begin(), all.end(), by_x),
             last = *std::max_element(all.begin(), all.end(), by_x);
  const Vec2 along = (last - first).norm() > 0.0 ? Vec2((last - first).normalized()) : Vec2(1.0, 0.0);
  std::sort(all.begin(), all.end(), [&](const Vec2& a, const Vec2& b) { return along.dot(a) < along.dot(b); });
  std::vector<Vec2> out;
  for (int k = 0; k < kOutlinePoints; ++k)
    out.push_back(all[static_cast<std::size_t>(k) * (all.size() - 1) / (kOutlinePoints - 1)]);
  return out;
}

struct Found {
  std::vector<BladeFaces> blades;
  std::vector<bool> splitter;
};

Found blades_given(const Part& part, const std::vector<WheelFace>& faces, const WheelChoice& choice, double size_mm) {
  Found out;
  for (const auto* lists : {&choice.blades, &choice.splitters})
    for (const std::string& list : *lists) {
      BladeFaces blade{faces_named(part, faces, list), 0.0};
      leave_out_hollows(blade, touch_mm(size_mm));
      if (blade.faces.empty()) throw UsageError("blade", list, "none of these faces could be read");
      out.blades.push_back(std::move(blade));
      out.splitter.push_back(lists == &choice.splitters);
    }
  return out;
}

/// Main blades and splitters among the candidates, and the count of sectors.
Found blades_found(const Part& part, const std::vector<BladeFaces>& candidates, const WheelAxis& axis, double size_mm) {
  Found out;
  const auto groups = equal_blades(candidates, axis, size_mm);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    // As many of each kind as there are main blades; a sector may have one less of them.
    if (g > 0 && groups[g].size() + 1 < groups.front().size()) continue;
    for (const std::size_t k : groups[g]) {
      out.blades.push_back(candidates[k]);
      out.splitter.push_back(g > 0);
    }
  }
  if (out.blades.empty())
    refuse(part, "no blade found: no connected faces have two sides, one towards each direction of rotation");
  return out;
}

void add_rest(const std::vector<WheelFace>& faces, WheelRoles& out) {
  std::set<std::string> known(out.hub.begin(), out.hub.end());
  known.insert(out.shroud.begin(), out.shroud.end());
  for (const WheelBlade& blade : out.blades) {
    for (const auto* some : {&blade.ahead, &blade.behind, &blade.edges, &blade.tips, &blade.buried})
      known.insert(some->begin(), some->end());
    for (const RootFillet& fillet : blade.fillets) known.insert(fillet.face);
  }
  for (const WheelFace& face : faces)
    if (known.count(face.id) == 0 && known.count("F" + std::to_string(face.index + 1)) == 0)
      out.rest.push_back(face.id);
}

/// Solids that are small and touch nothing: what a CAD program left behind.
void add_debris(const std::vector<WheelFace>& faces, double size_mm, WheelRoles& out) {
  std::map<int, Box3> solids;
  for (const WheelFace& face : faces)
    if (face.solid >= 0) solids[face.solid].add(face.box);
  for (const auto& [solid, box] : solids) {
    if (!(box.diagonal() < kDebrisShare * size_mm)) continue;
    std::vector<const WheelFace*> others;
    for (const WheelFace& face : faces)
      if (face.solid != solid) others.push_back(&face);
    if (others.empty() || std::abs(nearest(others, box.center()).height) < box.diagonal()) continue;
    for (const WheelFace& face : faces)
      if (face.solid == solid) out.debris.push_back(face.id);
  }
}

/// Whether a place lies over the tips, seen from the hub.
bool is_over_tips(const Vec3& p, const std::vector<const WheelFace*>& hub, const WheelRoles& roles) {
  const Vec2 q(roles.axis.along(p), roles.axis.radius(p));
  double tips = 1e300, height = 0.0;
  for (const Vec2& tip : roles.outline) tips = std::min(tips, (tip - q).norm());
  for (const WheelBlade& blade : roles.blades) height = std::max(height, blade.height_mm);
  return std::abs(nearest(hub, p).height) > tips + kOverTipsShare * height;
}

/// Solids without a role that reach over the tips: the housing and the cover of an assembly are not there while its wheel is machined.
void add_covers(const std::vector<WheelFace>& faces, const std::vector<const WheelFace*>& hub, WheelRoles& out) {
  std::set<int> own, covers;
  const std::set<std::string> rest(out.rest.begin(), out.rest.end());
  for (const WheelFace& face : faces)
    if (rest.count(face.id) == 0) own.insert(face.solid);
  for (const WheelFace& face : faces) {
    if (face.solid < 0 || own.count(face.solid) > 0 || covers.count(face.solid) > 0) continue;
    const std::vector<Vec3>& all = face.mesh.vertices;
    if (std::any_of(all.begin(), all.end(), [&](const Vec3& p) { return is_over_tips(p, hub, out); }))
      covers.insert(face.solid);
  }
  const std::set<std::string> known(out.debris.begin(), out.debris.end());
  for (const WheelFace& face : faces)
    if (covers.count(face.solid) > 0 && known.count(face.id) == 0) out.debris.push_back(face.id);
}

void add_count(const Part& part, const std::vector<WheelFace>& faces, const WheelChoice& choice, WheelRoles& out) {
  std::vector<double> angles;
  for (const WheelBlade& blade : out.blades)
    if (!blade.splitter) angles.push_back(blade.angle_deg);
  out.count = choice.count ? *choice.count : sectors_of(angles);
  if (out.count == 0 && angles.size() == 1) out.count = sectors_of_cuts(faces, out.axis, part.box.diagonal());
  if (out.count == 0)
    refuse(part, angles.size() == 1 ? "it has one blade, and no two flat faces through the axis from which the number "
                                      "of sectors follows; give `count`"
                                    : "its blades are not evenly spaced round the axis");
  out.whole = static_cast<int>(angles.size()) == out.count;
}

}  // namespace

WheelRoles recognise_wheel(const Part& part, const WheelChoice& choice) {
  const std::vector<WheelFace> faces = wheel_faces(part);
  const double size = part.box.diagonal();
  WheelRoles out;
  out.file = part.file, out.part_sha256 = part.sha256;
  const std::optional<WheelAxis> axis = find_axis(faces, part.box);
  if (!axis) refuse(part, "no axis found: the part has no surface of revolution");
  out.axis = *axis;
  const Found found = choice.blades.empty() ? blades_found(part, blade_candidates(faces, *axis, size), *axis, size)
                                            : blades_given(part, faces, choice, size);
  TurnedRoles turned;
  if (choice.hub)
    turned.hub = faces_named(part, faces, *choice.hub);
  else
    turned = turned_roles(faces, found.blades, *axis, size);
  if (turned.hub.empty())
    refuse(part, "no hub found: the blades stand on no surface of revolution about the axis; give `hub`");
  for (const WheelFace* face : turned.hub) out.hub.push_back(face->id);
  for (const WheelFace* face : turned.shroud) out.shroud.push_back(face->id);
  for (std::size_t k = 0; k < found.blades.size(); ++k) {
    out.blades.push_back(blade_roles(found.blades[k], turned.hub, *axis, size));
    out.blades.back().splitter = found.splitter[k];
  }
  std::stable_sort(out.blades.begin(), out.blades.end(),
                   [](const auto& a, const auto& b) { return a.angle_deg < b.angle_deg; });
  add_count(part, faces, choice, out);
  add_rest(faces, out);
  add_debris(faces, size, out);
  out.outline = outline_of(out, faces);
  add_covers(faces, turned.hub, out);
  return out;
}

}  // namespace flank::internal
