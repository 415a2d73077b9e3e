/// Shape of a cycle: the numbers that are optimised from cycle to cycle, as shares of the gap between the side paths.
#pragma once

#include <array>
#include <cstddef>

#include "flank/trochoid/ways/half_path.h"

namespace flank::internal {

struct CycleShape {
  /// Handles and bulge of the front, the same of the back, and how far the end on the second side is ahead of the one on
  /// the first.
  std::array<double, 7> share = {0.16, 0.16, 0.10, 0.12, 0.12, 0.0, 0.0};
  static constexpr std::size_t kAhead = 6;

  [[nodiscard]] HalfShape front(double gap, double lift) const {
    return {share[0] * gap, share[1] * gap, share[2] * gap, lift};
  }
  [[nodiscard]] HalfShape back(double gap, double lift) const {
    return {share[3] * gap, share[4] * gap, share[5] * gap, lift};
  }
};

/// Bounds of the shares: handles are positive, or the path would have a cusp.
inline constexpr std::array<double, 7> kLeastShare = {0.02, 0.02, -0.3, 0.02, 0.02, -0.3, -0.3};
inline constexpr std::array<double, 7> kMostShare = {0.6, 0.6, 0.8, 0.6, 0.6, 0.5, 0.3};

}  // namespace flank::internal
