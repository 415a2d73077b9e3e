/// Walls that are higher than the flank: at which heights a tour passes them, and how a closed one goes from one to the next.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "flank/tour/legs.h"

namespace flank::internal {

/// A stretch of a tour at any height: the pose at a share of the stretch with s = foot_s (mm) over the feet of the walls.
using TourStretch = std::function<Pose(double share, double foot_s)>;

struct Heights {
  double axis_length_mm = 0.0;
  std::vector<double> foot_s;  ///< of each level, mm, the highest first
};

/// Levels that overlap, evenly between the lowest and the one that ends above the heads. `over_mm`: axis over the longest line of the walls.
/// A length that is open is as long as one level needs.
[[nodiscard]] Heights heights_of(double lowest_foot_s, double over_mm, const std::optional<double>& axis_length_mm);

/// All round at every level, the highest first. Begins in the middle of the longest stretch. From one level to the next the tool sinks
/// along the walls while it goes on: a tool that moves along its axis cuts with its tip alone.
[[nodiscard]] std::vector<Leg> round_in_levels(const std::vector<TourStretch>& stretches,
                                               const std::vector<double>& levels, double axis_length_mm);

}  // namespace flank::internal
