#include "flank/wheel/rough/channel_section.h"

#include <algorithm>
#include <cmath>

#include "flank/wheel/point/floor_map.h"

namespace flank::internal {
namespace {

constexpr double kMapStepMm = 0.5;

}  // namespace

double distance_to(const std::vector<Vec2>& line, const Vec2& p) {
  double least = 1e300;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const Vec2 side = line[k + 1] - line[k];
    const double t =
        side.squaredNorm() > 0.0 ? std::clamp((p - line[k]).dot(side) / side.squaredNorm(), 0.0, 1.0) : 0.0;
    least = std::min(least, (p - line[k] - t * side).norm());
  }
  return least;
}

ChannelSection::ChannelSection(const FloorChannel& channel, const std::vector<Vec2>& outline)
    : axis_(channel.axis), outline_(outline) {
  const FloorMap map(channel.floor, channel.axis);
  for (double way = 0.0; way <= map.length(); way += kMapStepMm) hub_.push_back(flat(map.place(way, 0.0)));
}

double ChannelSection::height() const {
  double most = 0.0;
  for (const Vec2& p : outline_) most = std::max(most, distance_to(hub_, p));
  return most;
}

}  // namespace flank::internal
