#include "flank/wheel/sector.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/error.h"
#include "flank/io/face_names.h"

namespace flank::internal {
namespace {

/// Degrees from one angle on to the next, from 0 to 360.
double ahead_of(double from, double to) {
  const double d = std::fmod(to - from + 720.0, 360.0);
  return d;
}

constexpr double kSamePlaceDeg = 1.0;  ///< a blade so near to where a copy would stand is that copy

/// From a blade to another one, or all round to itself.
double way_to(const WheelBlade& from, const WheelBlade& to) {
  return &from == &to ? 360.0 : ahead_of(from.angle_deg, to.angle_deg);
}

/// The blade that follows within a pitch and a little more, the main blade a pitch on at last; none at the end of a part that is a piece.
const WheelBlade* next_of(const WheelRoles& roles, const WheelBlade& blade) {
  const WheelBlade* best = nullptr;
  double least = 360.0 / roles.count + kSamePlaceDeg;
  for (const WheelBlade& other : roles.blades) {
    const double d = way_to(blade, other);
    if (d <= 1e-6 || d > least) continue;
    best = &other, least = d;
  }
  return best;
}

/// The main blade that stands a pitch on; null: the part has none.
const WheelBlade* pitch_on(const WheelRoles& roles, const WheelBlade& blade) {
  for (const WheelBlade& other : roles.blades)
    if (!other.splitter && std::abs(way_to(blade, other) - 360.0 / roles.count) < kSamePlaceDeg) return &other;
  return nullptr;
}

/// Whether the part has no blade where a turned copy of this one would stand.
bool lacks(const WheelRoles& roles, const WheelBlade& blade, int turns) {
  const double there = blade.angle_deg + turns * 360.0 / roles.count;
  return std::none_of(roles.blades.begin(), roles.blades.end(), [&](const WheelBlade& other) {
    const double off = ahead_of(there, other.angle_deg);
    return other.splitter == blade.splitter && std::min(off, 360.0 - off) < kSamePlaceDeg;
  });
}

}  // namespace

std::vector<std::string> WheelSector::sides() const {
  std::vector<std::string> out;
  for (const WheelBlade& blade : blades) {
    const std::vector<std::string> own = blade.sides();
    out.insert(out.end(), own.begin(), own.end());
  }
  return out;
}

std::vector<WheelSector> all_sectors(const WheelRoles& roles) {
  std::vector<WheelSector> all;
  for (const WheelBlade& blade : roles.blades) {
    const WheelBlade* last = blade.splitter ? nullptr : pitch_on(roles, blade);
    const auto holds = [&](const WheelSector& sector) {
      return std::any_of(sector.blades.begin(), sector.blades.end(),
                         [&](const WheelBlade& other) { return other.angle_deg == blade.angle_deg; });
    };
    if (last == nullptr || std::any_of(all.begin(), all.end(), holds)) continue;
    WheelSector out;
    out.pitch_rad = 2.0 * std::numbers::pi / roles.count;
    out.copies = roles.count;
    out.blades = {blade};
    const WheelBlade* at = &blade;
    while (const WheelBlade* next = next_of(roles, *at)) {
      const bool end = next == last;
      out.channels.push_back({at->ahead, next->behind, end ? blade.behind : next->behind, end});
      if (end) break;
      out.blades.push_back(*next);
      at = next;
    }
    if (!out.channels.empty() && out.channels.back().turned) all.push_back(std::move(out));
  }
  return all;
}

WheelSector make_sector(const WheelRoles& roles) {
  const std::vector<WheelSector> all = all_sectors(roles);
  if (all.empty())
    throw InputError(fmt::format("{}: no two main blades are adjacent, so there is no channel to machine", roles.file));
  return all.front();
}

std::string face_list(const std::vector<std::string>& faces) { return fmt::format("{}", fmt::join(faces, ",")); }

std::vector<Strip> strips_of(const Path& path, const std::vector<std::string>& faces) {
  std::vector<Strip> out;
  for (const Strip& strip : path.strips) {
    const std::vector<std::string> named = face_list_items(strip.face);
    if (std::any_of(named.begin(), named.end(), [&](const std::string& face) {
          return std::find(faces.begin(), faces.end(), face) != faces.end();
        }))
      out.push_back(strip);
  }
  return out;
}

std::vector<Pose> turned(const std::vector<Pose>& poses, const WheelAxis& axis, double radians) {
  const Eigen::Isometry3d motion = axis.turn(radians);
  std::vector<Pose> out = poses;
  for (Pose& pose : out) {
    pose.tip = motion * pose.tip;
    pose.axis = (motion.linear() * pose.axis).normalized();
  }
  return out;
}

double hub_looks_along(const WheelRoles& roles, const std::vector<WheelFace>& faces) {
  double sum = 0.0, area = 0.0;
  for (const WheelFace& face : faces) {
    if (face.solid < 0 || std::find(roles.hub.begin(), roles.hub.end(), face.id) == roles.hub.end()) continue;
    for (const FaceSample& s : face.samples) sum += s.area * s.normal.dot(roles.axis.direction), area += s.area;
  }
  return area > 0.0 ? sum / area : 0.0;
}

bool is_machined_from_ahead(double hub_looks, const std::vector<Strip>& strips, const WheelAxis& axis) {
  constexpr double kLeans = 0.3;
  if (std::abs(hub_looks) > kLeans) return hub_looks > 0.0;
  double along = 0.0;
  for (const Strip& strip : strips) {
    if (strip.kind != "flank") continue;
    for (const Pose& pose : strip.poses) along += pose.axis.dot(axis.direction);
  }
  return along >= 0.0;
}

double sectors_of_hub(const WheelRoles& roles, const std::vector<WheelFace>& faces) {
  std::vector<double> angles;
  for (const WheelFace& face : faces) {
    if (std::find(roles.hub.begin(), roles.hub.end(), face.id) == roles.hub.end()) continue;
    for (const FaceSample& s : face.samples) angles.push_back(roles.axis.angle(s.point));
    for (const Vec3& p : face.border) angles.push_back(roles.axis.angle(p));
  }
  if (angles.size() < 2) return 1.0;
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 2.0 * std::numbers::pi - angles.back();
  for (std::size_t k = 1; k < angles.size(); ++k) gap = std::max(gap, angles[k] - angles[k - 1]);
  // Samples have gaps, too; where a piece ends, a sector is missing at least.
  const double pitch = 2.0 * std::numbers::pi / roles.count;
  if (gap < 0.5 * pitch) return roles.count;
  return std::max(1.0, (2.0 * std::numbers::pi - gap) / pitch);
}

std::vector<MissingBlade> missing_blades(const WheelRoles& roles, const WheelSector& sector) {
  std::vector<MissingBlade> out;
  for (const WheelBlade& blade : sector.blades)
    for (int turns = 1; turns < roles.count; ++turns)
      if (lacks(roles, blade, turns)) out.push_back({blade, turns});
  return out;
}

std::vector<MissingBlade> missing_beside(const WheelRoles& roles, const WheelSector& sector) {
  std::vector<MissingBlade> out;
  for (const WheelBlade& blade : sector.blades)
    for (const int turns : {-1, 1})
      if (lacks(roles, blade, turns)) out.push_back({blade, turns});
  return out;
}

bool is_within_pitch(const Vec3& p, const WheelAxis& axis, double middle_rad, double pitch_rad) {
  return std::abs(std::remainder(axis.angle(p) - middle_rad, 2.0 * std::numbers::pi)) <= 0.5 * pitch_rad;
}

Path copied(const Path& sector, const WheelAxis& axis, double pitch_rad, int copies) {
  Path out;
  for (int k = 0; k < copies; ++k)
    for (const Strip& strip : sector.strips) {
      out.strips.push_back(strip);
      if (k != 0) out.strips.back().poses = turned(strip.poses, axis, k * pitch_rad);
      out.strips.back().id = static_cast<int>(out.strips.size());
    }
  return out;
}

}  // namespace flank::internal
