#include "flank/verify/buried.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "flank/verify/clearance/winding.h"

namespace flank::internal::verify {
namespace {

/// Most samples of a sheet that are asked for the side of the tool.
constexpr std::size_t kVotes = 4096;
/// A strip machines a sheet from behind by at least this share of the sheet and of what it touches of all of them, and by this share of
/// what it touches of that one: where a tool goes round a rim, along a narrow edge, or machines the other side of what is thinner than the
/// tolerance there, a few places look behind.
constexpr double kLeastShare = 0.03, kMost = 0.8;
/// Cosine between a place's normal and the way to the axis: a flank that ends before a rim comes near to the sheet round it, which may be
/// hardly wider than the tolerance, across its normal.
constexpr double kAlongNormal = 0.5;

}  // namespace

std::vector<BuriedStrip> strips_in_solids(std::span<const TriangleMesh> solids, const Tool& tool, const Path& path) {
  std::vector<BuriedStrip> out;
  std::vector<char> found(path.strips.size(), 0);
  for (const TriangleMesh& solid : solids) {
    const Box3 box = solid.box();
    std::optional<Winding> winding;
    for (std::size_t k = 0; k < path.strips.size(); ++k) {
      if (path.strips[k].poses.empty() || found[k] != 0) continue;
      const Vec3 x = path.strips[k].poses.front().at(0.5 * tool.radial.axis_length());
      if ((x.array() < box.low.array()).any() || (x.array() > box.high.array()).any()) continue;
      if (!winding) winding.emplace(solid);
      if (!winding->inside(x)) continue;
      found[k] = 1;
      out.push_back({static_cast<int>(k), x});
    }
  }
  std::sort(out.begin(), out.end(), [](const BuriedStrip& a, const BuriedStrip& b) { return a.strip < b.strip; });
  return out;
}

int SheetVotes::side() const {
  int sum = 0;
  for (const SideVotes& strip : strips) sum += strip.in_front - strip.behind;
  return sum < 0 ? -1 : +1;
}

SheetVotes side_votes(const SweptVolume& volume, const Path& path, const FaceSamples& sheet, double within_mm) {
  const std::size_t stride = std::max<std::size_t>(1, sheet.points.size() / kVotes);
  FaceSamples some;
  std::vector<Vec3> normals;
  for (std::size_t i = 0; i < sheet.points.size(); i += stride) {
    some.points.push_back(sheet.points[i]);
    normals.push_back(sheet.normals[i]);
  }
  const std::vector<SweptDistance> distances = swept_distances(volume, some, within_mm);
  std::vector<SideVotes> votes(path.strips.size());
  std::vector<double> nearest(path.strips.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const SweptDistance& d = distances[i];
    if (d.strip < 0 || std::abs(d.f) > within_mm) continue;
    const auto k = static_cast<std::size_t>(d.strip);
    const auto& poses = path.strips[k].poses;
    const Pose& pose = poses[std::min(poses.size() - 1, static_cast<std::size_t>(std::lround(d.t)))];
    const Vec3 way = pose.at(d.s) - some.points[i];
    const double up = way.dot(normals[i]);
    ++(up >= 0.0 ? votes[k].in_front : votes[k].behind);
    if (up < -kAlongNormal * way.norm()) ++votes[k].from_behind;
    if (std::abs(d.f) >= nearest[k]) continue;
    nearest[k] = std::abs(d.f);
    votes[k].point = some.points[i];
  }
  double area = 0.0;
  for (const double mm2 : sheet.areas) area += mm2;
  return {std::move(votes), static_cast<int>(some.points.size()),
          area / std::max(1.0, static_cast<double>(some.points.size()))};
}

std::vector<BuriedStrip> strips_behind(std::span<const SheetVotes> votes) {
  std::vector<BuriedStrip> out;
  if (votes.empty()) return out;
  for (std::size_t k = 0; k < votes.front().strips.size(); ++k) {
    double touched = 0.0;
    for (const SheetVotes& sheet : votes)
      touched += sheet.place_mm2 * (sheet.strips[k].in_front + sheet.strips[k].behind);
    for (const SheetVotes& sheet : votes) {
      const SideVotes& strip = sheet.strips[k];
      if (strip.from_behind > kLeastShare * sheet.asked &&
          strip.from_behind > kMost * (strip.in_front + strip.behind) &&
          strip.from_behind * sheet.place_mm2 > kLeastShare * touched)
        out.push_back({static_cast<int>(k), strip.point});
    }
  }
  return out;
}

}  // namespace flank::internal::verify
