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

/// The blade that follows, main or not, within a pitch and a little more; none at the end of a part that is a sector.
const WheelBlade* next_of(const WheelRoles& roles, const WheelBlade& blade, bool main_only) {
  const WheelBlade* best = nullptr;
  double least = 360.0 / roles.count + 1.0;
  for (const WheelBlade& other : roles.blades) {
    const double d = ahead_of(blade.angle_deg, other.angle_deg);
    if (&other == &blade || (main_only && other.splitter) || d <= 1e-6 || d > least) continue;
    best = &other, least = d;
  }
  return best;
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
    if (blade.splitter) continue;
    const WheelBlade* last = next_of(roles, blade, true);
    if (last == nullptr) continue;
    WheelSector out;
    out.pitch_rad = 2.0 * std::numbers::pi / roles.count;
    out.copies = roles.whole ? roles.count : roles.mains();
    out.blades = {blade};
    const WheelBlade* at = &blade;
    while (const WheelBlade* next = next_of(roles, *at, false)) {
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

Path copied(const Path& sector, const WheelAxis& axis, double pitch_rad, int copies, bool whole) {
  Path out;
  // A part that is a sector may have its blades on either side of the one that was computed.
  const int first = whole ? 0 : 1 - copies, last = copies - 1;
  for (int k = first; k <= last; ++k)
    for (const Strip& strip : sector.strips) {
      out.strips.push_back(strip);
      if (k != 0) out.strips.back().poses = turned(strip.poses, axis, k * pitch_rad);
      out.strips.back().id = static_cast<int>(out.strips.size());
    }
  return out;
}

}  // namespace flank::internal
