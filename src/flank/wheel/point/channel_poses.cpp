#include "flank/wheel/point/channel_poses.h"

#include <algorithm>
#include <cmath>

#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

constexpr int kFewestColumns = 9;  ///< of the net of directions, across
constexpr double kColumnMm = 4.0;  ///< between them, at most
constexpr double kNetMm = 2.5;     ///< and along
constexpr int kAxes = 5;           ///< that are tried at a place

/// The net along the channel: its first and its last row are those of the channel, the others evenly between them.
int net_count(const std::vector<ChannelRow>& rows) {
  return static_cast<int>(std::ceil((rows.back().along - rows.front().along) / kNetMm)) + 1;
}

/// Rows of the channel from one of the net to the next.
double net_stride(const std::vector<ChannelRow>& rows) {
  return (static_cast<double>(rows.size()) - 1.0) / std::max(1, net_count(rows) - 1);
}

int columns_of(const std::vector<ChannelRow>& rows) {
  double widest = 0.0;
  for (const ChannelRow& row : rows)
    if (row.open) widest = std::max(widest, (row.high - row.low) * row.width);
  return std::max(kFewestColumns, static_cast<int>(std::ceil(widest / kColumnMm)) + 1);
}

}  // namespace

ChannelPoses::ChannelPoses(const ChannelRows& channel, const TipRoom& room, const PointOptions& options,
                           const AxisField* below)
    : channel_(channel), room_(room), options_(options), field_(field_of(below)) {}

AxisField ChannelPoses::field_of(const AxisField* below) const {
  const double stride = net_stride(rows());
  const int count = net_count(rows()), columns = below != nullptr ? below->columns() : columns_of(rows());
  std::vector<std::optional<TipRoom::Rest>> places(static_cast<std::size_t>(count * columns));
  parallel_for(places.size(), [&](std::size_t k) {
    const std::size_t across = k % static_cast<std::size_t>(columns), along = k / static_cast<std::size_t>(columns);
    const ChannelRow& row = rows()[static_cast<std::size_t>(std::lround(static_cast<double>(along) * stride))];
    if (row.open) places[k] = channel_.rest(row, static_cast<double>(across) / (columns - 1));
  });
  return {room_, places, count, columns, below};
}

Vec3 ChannelPoses::axis(std::size_t row, double share) const {
  return field_.at(static_cast<double>(row) / net_stride(rows()), share * (field_.columns() - 1));
}

std::optional<Pose> ChannelPoses::at(std::size_t row, double share) const {
  if (!rows()[row].open) return {};
  const std::optional<TipRoom::Rest> rest = channel_.rest(rows()[row], share);
  if (!rest) return {};
  // Beside a blade the axis of a place nearer to the middle may have room where its own has none.
  for (int k = 0; k < kAxes; ++k) {
    const Pose pose{rest->center, axis(row, std::lerp(std::clamp(share, 0.0, 1.0), 0.5, k / (kAxes - 1.0)))};
    if (room_.is_free(pose)) return pose;
  }
  return {};
}

}  // namespace flank::internal
