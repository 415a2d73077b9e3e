#include "flank/wheel/point/wall_passes.h"

#include <algorithm>
#include <cmath>

#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

constexpr int kMostSteps = 400;  ///< of a climb
constexpr int kInwards = 5;      ///< axes that are tried at a place, from beside the side to the middle
constexpr double kMostInwards = 0.5;

/// One climb: places of the sphere's centre up the side at a row, from its corner; absent where the side ends.
struct Climb {
  std::vector<Vec3> centers, contacts;
};

Climb climb(const WallWork& work, std::size_t index, double step) {
  Climb out;
  const ChannelRow& row = work.rows.rows()[index];
  const std::vector<const Target*>& side = work.at_first ? work.channel.first : work.channel.second;
  if (!row.open) return out;
  const std::optional<TipRoom::Rest> corner = work.rows.rest(row, work.at_first ? 0.0 : 1.0),
                                     ahead = work.rows.rest(row, 0.5);
  if (!corner || !ahead) return out;
  const double lift = work.room.lift_mm(), near = 4.0 * lift;
  const Vec3 inwards = ahead->center - corner->center;
  Vec3 at = corner->center, up = corner->normal;
  const Vec3 along = up.cross(inwards).normalized();
  for (int k = 0; k < kMostSteps; ++k) {
    const Footpoint foot = nearest_foot(side, at, near);
    // The corner may be beside the side, before or behind the blade.
    if (foot.patch < 0 || foot.location != Location::kInside || (k == 0 && foot.distance > 1.2 * lift)) return out;
    out.centers.push_back(foot.point + lift * foot.normal), out.contacts.push_back(foot.point);
    Vec3 way = foot.normal.cross(along);
    if (!(way.norm() > 1e-3)) return out;
    way = way.normalized() * (way.dot(up) < 0.0 ? -1.0 : 1.0);
    up = way, at = out.centers.back() + step * way;
  }
  return out;
}

std::optional<Pose> pose_at(const WallWork& work, std::size_t row, const Vec3& center, const Vec3& contact) {
  if (work.options.is_finished && work.options.is_finished(contact)) return {};
  if (!work.room.tip_is_free(center)) return {};
  for (int k = 0; k < kInwards; ++k) {
    const Pose pose{center, work.axis(row, kMostInwards * k / (kInwards - 1.0))};
    if (work.room.is_free(pose)) return pose;
  }
  return {};
}

}  // namespace

std::vector<PoseRow> wall_rows(const WallWork& work) {
  const std::size_t count = work.rows.rows().size();
  const double step = std::sqrt(8.0 * work.options.scallop_share * work.options.tolerance_mm * work.room.tip_mm());
  std::vector<std::vector<std::optional<Pose>>> columns(count);
  parallel_for(count, [&](std::size_t i) {
    const Climb up = climb(work, i, step);
    for (std::size_t k = 0; k < up.centers.size(); ++k)
      columns[i].push_back(pose_at(work, i, up.centers[k], up.contacts[k]));
  });
  std::size_t passes = 0;
  for (const auto& column : columns) passes = std::max(passes, column.size());
  std::vector<PoseRow> out;
  for (std::size_t k = 0; k < passes; ++k) {
    PoseRow row(count);
    bool any = false;
    for (std::size_t i = 0; i < count; ++i)
      if (k < columns[i].size() && columns[i][k]) row[i] = columns[i][k], any = true;
    if (any) out.push_back(std::move(row));
  }
  return out;
}

}  // namespace flank::internal
