/// Passes along the sides of a channel between its layers.
#pragma once

#include <string>
#include <vector>

#include "flank/path.h"
#include "flank/wheel/rough/cycles.h"
#include "flank/wheel/rough/layer.h"
#include "flank/wheel/rough/stock_grid.h"

namespace flank::internal {

/// Of a layer that lies in air, its outermost poses on both sides: the flank takes what the layers above and below have left there, climb milling.
/// Where that engages too much it stays. What is cut is taken out of `stock`. Strips of kind "rough".
[[nodiscard]] std::vector<Strip> side_passes(const ChannelLayer& layer, const Cutter& cutter, const CycleLimits& limits,
                                             const std::string& face, StockGrid& stock);

}  // namespace flank::internal
