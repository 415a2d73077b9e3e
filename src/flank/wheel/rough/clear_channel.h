/// A channel of a wheel cleared by trochoidal cycles, layer by layer.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "flank/path.h"
#include "flank/wheel/point/channel.h"
#include "flank/wheel/rough/cycles.h"

namespace flank::internal {

struct ClearingRequest {
  double keep_mm = 0.3;  ///< that is left on floor and sides
  double most_engagement_rad = 1.0;
  double layer_mm = 1.0;      ///< from layer to layer
  int layers = 1;             ///< of the highest channel of all: its highest layer is 1
  std::string face;           ///< that the strips name
  std::vector<Vec2> outline;  ///< of the blank: along the wheel's axis and radius, mm
  /// Of a tool that goes nowhere but near some strips, what it may do. It is asked once, before the first motion.
  std::function<MotionTest(const Path& around)> guard = [](const Path&) { return CycleLimits().is_free; };
};

/// How many layers there are over a channel's floor: the highest one is above the outline of the blank.
[[nodiscard]] int layer_count(const FloorChannel& channel, const std::vector<Vec2>& outline, double layer_mm);

/// Strips of kind "rough", the highest layer first; layers as high over the floor have the same number in all channels. Nothing engages more than
/// is allowed, as far as a grid of distances tells; what could not be cleared so is left. `options`: what keeps off sides and shank.
[[nodiscard]] std::vector<Strip> clear_channel(const FloorChannel& channel, const RadialFunction& radial,
                                               const PointOptions& options, const ClearingRequest& request);

}  // namespace flank::internal
