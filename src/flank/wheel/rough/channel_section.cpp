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
  polygon_ = hub_;
  if (hub_.empty() || outline_.empty()) return;
  const bool same = (hub_.back() - outline_.front()).norm() < (hub_.back() - outline_.back()).norm();
  polygon_.insert(polygon_.end(), outline_.begin(), outline_.end());
  if (!same) std::reverse(polygon_.end() - static_cast<std::ptrdiff_t>(outline_.size()), polygon_.end());
}

bool ChannelSection::is_air(const Vec3& center, double radius) const {
  const Vec2 p = flat(center);
  bool inside = false;
  for (std::size_t k = 0; k < polygon_.size(); ++k) {
    const Vec2 &a = polygon_[k], &b = polygon_[(k + 1) % polygon_.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  if (inside) return false;
  std::vector<Vec2> closed = polygon_;
  closed.push_back(polygon_.front());
  return distance_to(closed, p) > radius;
}

double ChannelSection::height() const {
  double most = 0.0;
  for (const Vec2& p : outline_) most = std::max(most, distance_to(hub_, p));
  return most;
}

}  // namespace flank::internal
