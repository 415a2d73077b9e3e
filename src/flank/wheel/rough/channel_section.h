/// The section of a wheel between its hub and an outline over it.
#pragma once

#include <vector>

#include "flank/wheel/point/channel.h"

namespace flank::internal {

/// Half of it, along the axis and away from it. Immutable.
class ChannelSection {
 public:
  ChannelSection(const FloorChannel& channel, const std::vector<Vec2>& outline);
  /// Of the outline over the hub, mm, at most.
  [[nodiscard]] double height() const;

 private:
  [[nodiscard]] Vec2 flat(const Vec3& p) const { return {axis_.along(p), axis_.radius(p)}; }
  WheelAxis axis_;
  std::vector<Vec2> outline_, hub_;
};

/// Of a place to a line in a section, mm.
[[nodiscard]] double distance_to(const std::vector<Vec2>& line, const Vec2& p);

}  // namespace flank::internal
