#include "flank/trochoid/engagement/row_rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

/// Rings of a round end, `shift` of their distance from where the flank ends.
void add_round_end(const RadialFunction& radial, bool tip, int count, double shift, std::vector<ToolRing>& rings) {
  for (int k = 0; k < count; ++k) {
    ToolRing ring = round_end_ring(radial, tip, (k + shift) / count);
    ring.area /= count;
    if (ring.area > 0.0) rings.push_back(ring);
  }
}

std::vector<ToolRing> rings_of(const RadialFunction& radial, int asked, int volume, int every, double shift) {
  const double length = radial.axis_length();
  std::vector<ToolRing> rings = asked > 0 ? tool_rings(radial, asked, 0) : std::vector<ToolRing>();
  for (int k = 0; k < asked; ++k) {
    ToolRing& ring = rings[static_cast<std::size_t>(k)];
    ring.area = 0.0;
    ring.between = k % every != 0 && k + 1 < asked;
  }
  if (volume == 0) return rings;
  for (int k = 0; k < volume; ++k) {
    ToolRing ring = ring_at(radial, length * (k + shift) / volume);
    ring.area = flank_element(radial, ring.s) * length / volume;
    ring.asked = false;
    rings.push_back(ring);
  }
  std::sort(rings.begin(), rings.end(), [](const ToolRing& a, const ToolRing& b) { return a.s < b.s; });
  for (const bool tip : {true, false}) {
    const double quarter = 0.5 * std::numbers::pi * radial.at(tip ? 0.0 : length).r;
    const int count = std::max(1, static_cast<int>(std::ceil(quarter * volume / length)));
    add_round_end(radial, tip, count, shift, rings);
  }
  return rings;
}

}  // namespace

RowRings::RowRings(const RadialFunction& radial, int asked, int volume, int every) {
  for (std::size_t k = 0; k < kSets; ++k)
    sets_.push_back(rings_of(radial, asked, volume, every, (static_cast<double>(k) + 0.5) / kSets));
}

}  // namespace flank::internal
