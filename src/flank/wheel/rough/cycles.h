/// Trochoidal cycles that clear a layer of a channel.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "flank/path.h"
#include "flank/wheel/rough/layer.h"
#include "flank/wheel/rough/stock_grid.h"

namespace flank::internal {

/// Whether the tool may go from one pose to the next.
using MotionTest = std::function<bool(const Pose& from, const Pose& to)>;

struct CycleLimits {
  double most_engagement_rad = 1.0;
  MotionTest is_free = [](const Pose&, const Pose&) { return true; };
  double planned_share = 0.85;                            ///< of the engagement, that motions are chosen by
  double apart_share = 0.3;                               ///< of the tip's radius, between poses
  double most_step_share = 0.6, least_step_share = 0.03;  ///< of the tip's radius, from cycle to cycle
};

/// Closed loops from side to side, each a step further along the channel than the one before: a front half that cuts, round ahead, and a back half
/// through what is cut already. A step is as long as the engagement allows. Loops that would cut nothing are left out, and those that would engage too much,
/// or go where they may not, even if they are short and narrow; a strip ends there. They begin where the channel is open to the air; where some engage too much, the rest is tried
/// from the other end. What is cut is taken out of `stock`. Strips of kind "rough".
[[nodiscard]] std::vector<Strip> layer_cycles(const ChannelLayer& layer, const Cutter& cutter,
                                              const CycleLimits& limits, const std::string& face, StockGrid& stock);
/// How far a layer is to go on where it is open, so that a loop begins in the air, mm.
[[nodiscard]] double loop_length(const Cutter& cutter);

}  // namespace flank::internal
