/// SMOOTH (MATH section 8): the chosen strips as one fit with the given tool (fit/swept_model.h), then certified.
#pragma once

#include <vector>

#include "flank/cover/tiles/tile.h"

namespace flank::internal {

/// A set of strips that is free of overcut and of other faces, and its covered share.
struct SmoothResult {
  std::vector<CoverStrip> strips;
  double coverage = 0.0;
};

/// All strips together are fitted to the target's points; other faces push back where the tool comes near them. Passes
/// are kept only where the covered share rises; a strip whose certificate fails falls back to the strip that it was.
[[nodiscard]] SmoothResult smooth_strips(const TileScene& scene, const std::vector<CoverStrip>& strips);

/// The strips measured afresh, with the scene's own samples.
[[nodiscard]] std::vector<CoverStrip> remeasured(const TileScene& scene, const std::vector<CoverStrip>& strips);

/// Covered share of the area.
[[nodiscard]] double covered_share(const CoverSamples& samples, const std::vector<CoverStrip>& strips);

}  // namespace flank::internal
