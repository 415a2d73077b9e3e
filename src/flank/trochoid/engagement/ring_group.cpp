#include "flank/trochoid/engagement/ring_group.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flank::internal {

std::size_t end_of_group(std::span<const ToolRing> rings, std::size_t first, double height_mm) {
  const ToolRing& begin = rings[first];
  std::size_t end = first + 1;
  while (end < rings.size() && rings[end].flank == begin.flank && std::abs(rings[end].z - begin.z) <= height_mm) ++end;
  return end;
}

RingGroup group_of(std::span<const ToolRing> rings) {
  double low = rings[0].z, high = low, narrow = rings[0].radius, wide = narrow;
  for (const ToolRing& ring : rings) {
    low = std::min(low, ring.z), high = std::max(high, ring.z);
    narrow = std::min(narrow, ring.radius), wide = std::max(wide, ring.radius);
  }
  return {0.5 * (low + high), 0.5 * (high - low), 0.5 * (narrow + wide), 0.5 * (wide - narrow)};
}

void OpenSectors::add(double low, double high) {
  for (Sector& sector : sectors_) {
    const double turns = std::round((sector.low + sector.high - low - high) / (4.0 * std::numbers::pi));
    const double turn = 2.0 * std::numbers::pi * turns;
    if (low + turn > sector.high || high + turn < sector.low) continue;
    sector = {std::min(sector.low, low + turn), std::max(sector.high, high + turn)};
    return;
  }
  sectors_.push_back({low, high});
}

void OpenSectors::arcs_on(double radius, std::vector<OpenArc>& out) const {
  const auto place = [&](double angle) { return Vec2(radius * std::cos(angle), radius * std::sin(angle)); };
  out.clear();
  for (const Sector& sector : sectors_)
    out.push_back({place(sector.low), place(sector.high), sector.high - sector.low > kWide});
}

}  // namespace flank::internal
