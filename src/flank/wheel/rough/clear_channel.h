/// A channel of a wheel cleared by trochoidal cycles, layer by layer.
#pragma once

#include <string>
#include <vector>

#include "flank/path.h"
#include "flank/wheel/point/channel.h"

namespace flank::internal {

struct ClearingRequest {
  double keep_mm = 0.3;  ///< that is left on floor and sides
  double most_engagement_rad = 1.0;
  double layer_mm = 1.0;      ///< from layer to layer
  std::string face;           ///< that the strips name
  std::vector<Vec2> outline;  ///< of the blank: along the wheel's axis and radius, mm
};

/// Strips of kind "rough", the highest layer first; layer 1 is the one on the floor. Nothing engages more than is allowed, as far as a grid of distances tells; what could not be
/// cleared so is left. `options`: what keeps off sides and shank.
[[nodiscard]] std::vector<Strip> clear_channel(const FloorChannel& channel, const RadialFunction& radial,
                                               const PointOptions& options, const ClearingRequest& request);

}  // namespace flank::internal
