#include "flank/wheel/rest_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>

#include "flank/results/view.h"
#include "flank/wheel/judge_whole.h"
#include "flank/wheel/point/tip_room.h"

namespace flank::internal {
namespace {

constexpr double kLeastAreaMm2 = 0.5;  ///< smaller places are not listed
constexpr double kTouching = 0.98;     ///< of a ball's radius: what it only touches, it does not enter
constexpr int kDirectionsRound = 12;
constexpr int kDirectionsTilted = 6;  ///< 12 degrees apart

/// Who is asked about a place: all faces but one, and the tool.
struct Around {
  std::vector<const Target*> hub, others;
  FloorChannel channel;
  const Tool* tool;
  double tolerance = 0.0;
  PointOptions options;              ///< of any pass: the directions that a machine holds among them
  std::vector<const Target*> sides;  ///< of the sector's blades
  double pitch = 0.0;
  int copies = 1;

  /// The hub of a piece of a wheel goes on below blades that the piece lacks.
  [[nodiscard]] bool below_a_blade(const Vec3& x, const Vec3& normal) const {
    for (int k = 0; k < copies; ++k) {
      const Vec3 p = channel.axis.turn(k * pitch) * Vec3(x + tolerance * normal);
      const Footpoint foot = nearest_foot(sides, p, 1e300);
      if (foot.patch >= 0 && foot.location == Location::kInside && foot.distance < 0.0) return true;
    }
    return false;
  }
  [[nodiscard]] bool lets_in(const Vec3& x, const Vec3& normal, double radius) const {
    return nearest_foot(others, x + radius * normal, kTouching * radius).patch < 0;
  }
  /// A ball of some tolerances touches it, and it is not below the hub.
  [[nodiscard]] bool open(const Vec3& x, const Vec3& normal) const {
    if (!lets_in(x, normal, kOpenBall * tolerance)) return false;
    const Footpoint foot = nearest_foot(hub, x, 1e300);
    return foot.patch < 0 || foot.location != Location::kInside || foot.distance > -tolerance;
  }
  [[nodiscard]] std::string reason(const Vec3& x, const Vec3& normal) const {
    const double tip = tool->radial.at(0.0).r;
    if (below_a_blade(x, normal)) return "a blade of the wheel stands there";
    if (!lets_in(x, normal, tip)) return fmt::format("a corner that a tip of radius {:.2f} mm does not fit into", tip);
    const TipRoom room(channel, tool->radial, options);
    const Vec3 center = x + room.lift_mm() * normal, e = normal.unitOrthogonal(), f = normal.cross(e);
    for (int tilt = 1; tilt <= kDirectionsTilted; ++tilt)
      for (int round = 0; round < kDirectionsRound; ++round) {
        const double a = 12.0 * tilt * std::numbers::pi / 180.0, b = 2.0 * std::numbers::pi * round / kDirectionsRound;
        const Vec3 axis = std::cos(a) * normal + std::sin(a) * (std::cos(b) * e + std::sin(b) * f);
        if (room.is_free({center, axis})) return "accessible, but no pass goes there";
      }
    return "the tool collides in every direction tried";
  }
};

Around around(WheelWork& work, const std::string& face) {
  Around out;
  out.tool = &*work.tool, out.tolerance = work.job.tolerance_mm;
  const auto holds = [](const std::vector<std::string>& some, const std::string& one) {
    return std::find(some.begin(), some.end(), one) != some.end();
  };
  if (!holds(work.roles.hub, face)) out.hub = work.targets.of(work.roles.hub);
  std::vector<std::string> names;
  for (const WheelFace& one : work.faces) {
    bool counts = !holds(work.roles.debris, one.id);
    for (const WheelBlade& blade : work.roles.blades) counts = counts && !holds(blade.buried, one.id);
    if (counts) names.push_back(one.id);
  }
  out.options = work.point_options({face});
  out.channel.axis = work.roles.axis;
  out.channel.wheel = &work.wheel_triangles(), out.channel.reach_mm = work.reach_mm();
  out.pitch = work.sector.pitch_rad, out.copies = work.sector.copies;
  if (holds(work.roles.hub, face)) out.sides = work.targets.of(work.sector.sides());
  const std::vector<const Target*> missing = work.missing();
  out.channel.walls = work.targets.of(names);
  out.channel.walls.insert(out.channel.walls.end(), missing.begin(), missing.end());
  names.erase(std::remove(names.begin(), names.end(), face), names.end());
  out.others = work.targets.of(names);
  out.others.insert(out.others.end(), missing.begin(), missing.end());
  return out;
}

int root_of(std::vector<int>& parent, int k) {
  while (parent[static_cast<std::size_t>(k)] != k) k = parent[static_cast<std::size_t>(k)];
  return k;
}

struct Patch {
  std::vector<std::size_t> triangles;
  double area = 0.0;
};

/// Triangles that share corners, of those on which too much is left.
std::vector<Patch> patches_of(const ViewFace& face, double tolerance) {
  std::vector<int> parent(face.mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  std::vector<std::size_t> left;
  for (std::size_t k = 0; k < face.mesh.triangles.size(); ++k) {
    const auto& t = face.mesh.triangles[k];
    double mean = 0.0;
    for (const int v : t) mean += face.f_mm[static_cast<std::size_t>(v)] / 3.0;
    if (mean <= tolerance) continue;
    left.push_back(k);
    for (const int v : t) parent[static_cast<std::size_t>(root_of(parent, v))] = root_of(parent, t[0]);
  }
  std::map<int, Patch> found;
  for (const std::size_t k : left) {
    const auto& t = face.mesh.triangles[k];
    const auto corner = [&](std::size_t i) { return face.mesh.vertices[static_cast<std::size_t>(t[i])]; };
    Patch& patch = found[root_of(parent, t[0])];
    patch.triangles.push_back(k);
    patch.area += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  }
  std::vector<Patch> out;
  for (auto& [key, patch] : found)
    if (patch.area >= kLeastAreaMm2) out.push_back(std::move(patch));
  return out;
}

void add_patch(const Around& around, const ViewFace& face, const Target& target, const Patch& patch, WheelRest& out) {
  RestPlace place{.face = face.face, .point = Vec3::Zero(), .area_mm2 = 0.0, .depth_mm = 0.0, .reason = {}};
  Vec3 normal = Vec3::UnitZ();
  for (const std::size_t k : patch.triangles) {
    const auto& t = face.mesh.triangles[k];
    const auto corner = [&](std::size_t i) { return face.mesh.vertices[static_cast<std::size_t>(t[i])]; };
    const Footpoint foot = target.closest((corner(0) + corner(1) + corner(2)) / 3.0);
    if (!around.open(foot.point, foot.normal)) continue;
    place.area_mm2 += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    const double f = face.f_mm[static_cast<std::size_t>(t[0])];
    if (f > place.depth_mm) place.depth_mm = f, place.point = foot.point, normal = foot.normal;
    const int first = static_cast<int>(out.mesh.vertices.size());
    for (std::size_t i = 0; i < 3; ++i) out.mesh.vertices.push_back(corner(i));
    out.mesh.triangles.push_back({first, first + 1, first + 2});
  }
  if (place.area_mm2 < kLeastAreaMm2 || !(place.depth_mm > 0.0)) return;
  place.reason = around.reason(place.point, normal);
  out.places.push_back(std::move(place));
}

}  // namespace

WheelRest rest_of(WheelWork& work, const Result& whole) {
  WheelRest out;
  if (!whole.drawings || !work.tool) return out;
  for (const ViewFace& face : whole.drawings->view.bodies) {
    if (!face.target || face.f_mm.size() != face.mesh.vertices.size()) continue;
    const Around near = around(work, face.face);
    const Target& target = *work.targets.of({face.face}).front();
    for (const Patch& patch : patches_of(face, work.job.tolerance_mm)) add_patch(near, face, target, patch, out);
  }
  std::stable_sort(out.places.begin(), out.places.end(),
                   [](const RestPlace& a, const RestPlace& b) { return a.area_mm2 > b.area_mm2; });
  return out;
}

}  // namespace flank::internal
