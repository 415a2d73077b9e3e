/// SMOOTH (MATH section 8): the chosen strips as one fit with the given tool (fit/swept_model.h), then certified.
///
/// f is the least over all strips, so a gap between two neighbours closes from both sides: fitted one by one, each
/// strip would try to reach across the gap alone.
#pragma once

#include <vector>

#include "flank/cover/tiles/tile.h"

namespace flank::internal {

/// A set of strips and its covered share.
struct SmoothResult {
  /// As many as went in, in their order; one that could not be certified may have no cells
  std::vector<CoverStrip> strips;
  double coverage = 0.0;  ///< share of the samples' area in [0, 1]
};

/// Fits all strips together to points of the target; other faces push back where the tool comes near them.
///
/// Needs strips measured with the scene's own samples (remeasured). A pass is kept only if the covered share rises; the
/// first may cost 0.2 % for its fairer rails. A strip whose certificate fails falls back to what it was, or to what can
/// be certified of it. So if every strip that goes in is certified, every strip that comes out is. Deterministic for
/// any number of threads.
[[nodiscard]] SmoothResult smooth_strips(const TileScene& scene, const std::vector<CoverStrip>& strips);

/// The same motions, measured with the scene's own samples. Cells of a CoverStrip are indices into the samples that it
/// was measured with: strips that pass from one scene to another go through here.
[[nodiscard]] std::vector<CoverStrip> remeasured(const TileScene& scene, const std::vector<CoverStrip>& strips);

/// Covered share of the area of the samples, in [0, 1]; each cell counts once. Strips must have been measured with
/// `samples`.
[[nodiscard]] double covered_share(const CoverSamples& samples, const std::vector<CoverStrip>& strips);

}  // namespace flank::internal
