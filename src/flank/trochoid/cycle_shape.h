/// Shape of a cycle: the numbers that are optimised from cycle to cycle, as shares of the gap between the side paths.
#pragma once

#include <array>

#include "flank/trochoid/paths/half_path.h"

namespace flank::internal {

/// Of a half: see HalfShape.
struct HalfShares {
  double leave = 0.0, arrive = 0.0, bulge = 0.0;
  [[nodiscard]] HalfShape of(double gap_mm, double lift_mm) const {
    return {leave * gap_mm, arrive * gap_mm, bulge * gap_mm, lift_mm};
  }
};

struct CycleShape {
  HalfShares front{0.16, 0.16, 0.10}, back{0.12, 0.12, 0.0};
  double ahead = 0.0;    ///< how far the end on the second side is ahead of the one on the first
  double lift_mm = 0.0;  ///< of both halves, see HalfShape; no share, and not optimised: it is what the floor asks for

  static constexpr std::size_t kShares = 7;
  /// The shares, in the order of their bounds.
  [[nodiscard]] std::array<double*, kShares> shares() {
    return {&front.leave, &front.arrive, &front.bulge, &back.leave, &back.arrive, &back.bulge, &ahead};
  }
};

/// Bounds of the shares: handles are positive, or the path would have a cusp.
inline constexpr std::array<double, CycleShape::kShares> kLeastShare = {0.02, 0.02, -0.3, 0.02, 0.02, -0.3, -0.3};
inline constexpr std::array<double, CycleShape::kShares> kMostShare = {0.6, 0.6, 0.8, 0.6, 0.6, 0.5, 0.3};

}  // namespace flank::internal
