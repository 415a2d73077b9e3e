#include "flank/trochoid/engagement/ring_group.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

/// Radians: so little more than the largest is not looked for between rings; peaks there are found by golden section.
constexpr double kHair = 5e-4;
/// Radians: a rough look that leaves more than this too much open says nothing of the rings beside. Where the layer above ends, it
/// knows nothing of that at one ring, and all at the next.
constexpr double kMostSpare = 5e-3;

}  // namespace

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

RowDisc discs_of(std::span<const RingArc> arcs, std::span<const ToolRing> rings, double largest_mm,
                 std::vector<RowDisc>& parts) {
  // Small discs let only those poses through that come near to what is open: one for each sector of directions.
  constexpr int kSectors = 24;
  constexpr double kPiece = 2.0 * std::numbers::pi / kSectors;
  std::array<OpenPart, kSectors> sectors;
  OpenPart all;
  for (const RingArc& found : arcs) {
    const ToolRing& ring = rings[found.ring];
    const double low = found.motion_angle + found.arc.low, length = found.arc.high - found.arc.low;
    const int pieces = std::max(1, static_cast<int>(std::ceil(length / kPiece)));
    // Every half of a piece is a turn farther.
    const double half = 0.5 * length / pieces;
    const Vec2 turned(std::cos(half), std::sin(half));
    Vec2 at(ring.radius * std::cos(low), ring.radius * std::sin(low));
    const auto next = [&] {
      at = Vec2(turned.x() * at.x() - turned.y() * at.y(), turned.y() * at.x() + turned.x() * at.y());
      return at;
    };
    for (int k = 0; k < pieces; ++k) {
      const double turn = (low + length * (k + 0.5) / pieces) / (2.0 * std::numbers::pi);
      const int sector = static_cast<int>((turn - std::floor(turn)) * kSectors) % kSectors;
      for (const Vec2& x : {at, next(), next()}) {
        sectors[static_cast<std::size_t>(sector)].add(ring, {x.x(), x.y(), 0.0});
        all.add(ring, {x.x(), x.y(), 0.0});
      }
    }
  }
  // How far an arc bows out between points that are half a piece apart.
  const double bow = largest_mm * (1.0 - std::cos(0.25 * kPiece));
  parts.clear();
  for (const OpenPart& part : sectors)
    if (part.low <= part.high) parts.push_back(part.disc(bow));
  return all.disc(bow);
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

void WantedRings::begin(std::span<const ToolRing> rings) {
  wanted_.resize(rings.size());
  for (std::size_t k = 0; k < rings.size(); ++k) wanted_[k] = rings[k].between ? 0 : 1;
}

bool WantedRings::go_on(std::span<const ToolRing> rings, const std::function<double(std::size_t)>& rough,
                        std::span<const RingArc> found) {
  found_.assign(rings.size(), 0.0);
  for (const RingArc& arc : found) found_[arc.ring] += arc.arc.high - arc.arc.low;
  double largest = 0.0;
  for (std::size_t k = 0; k < rings.size(); ++k)
    if (rings[k].flank && rings[k].asked) largest = std::max(largest, found_[k]);
  const auto excess = [&](std::size_t k) { return rough(k) - found_[k]; };
  const auto is_base = [&](std::size_t k) { return rings[k].flank && !rings[k].between; };
  bool some = false;
  for (std::size_t k = 0, before = rings.size(); k < rings.size(); ++k) {
    wanted_[k] = 0;
    if (is_base(k)) before = k;
    if (!rings[k].between) continue;
    std::size_t after = k + 1;
    while (after < rings.size() && !is_base(after)) ++after;
    const double more = rough(k) - largest - kHair;
    if (more <= 0.0) continue;
    const double spare = before < rings.size() && after < rings.size() ? std::min(excess(before), excess(after)) : 0.0;
    if (spare <= kMostSpare && more <= spare) continue;
    wanted_[k] = 1;
    some = true;
  }
  return some;
}

}  // namespace flank::internal
