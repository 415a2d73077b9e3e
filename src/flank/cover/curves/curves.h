/// Strategy `curves`: paper B's own pipeline as far as it goes, for comparison with `grow` (docs/algorithms/curves.md).
///
/// Deterministic for any number of threads; CurvesOptions::seed decides the clusters.
#pragma once

#include <string>
#include <vector>

#include "flank/cover/tiles/tile.h"

namespace flank::internal {

/// How many there were of each: what the next stage had to choose from.
struct CurveCounts {
  int seeds = 0;                             ///< pairs of a sphere at rest and an admissible direction
  int straight = 0;                          ///< curves that run along enough of the axis
  int lines = 0;                             ///< of those, with a line within slack tolerances
  int clusters = 0, groups = 0, strips = 0;  ///< strips: groups that cover something
};

struct CurveStrips {
  std::vector<CoverStrip> strips;  ///< chosen; measured with slack tolerances, not yet certified
  CurveCounts counts;
};

/// Among the values of a finished step (base/step_codec.h).
void code(StepCodec& codec, CurveStrips& found);

/// Seeds, integral curves, lines, clusters, groups, choice: paper B's initial motions of the tool. No strips if no line
/// is within slack tolerances, or fewer than five of them follow each other; the counts say which.
[[nodiscard]] CurveStrips strips_of_curves(const TileScene& scene);

/// The strips measured at the tolerance itself. Those that fail their certificate count for nothing before SMOOTH, but
/// are what it starts from. What it leaves is certified, without strips that are not worth their price.
struct SmoothedCurves {
  double coverage_before = 0.0;  ///< by the strips as they were, cut short to what could be certified
  std::vector<CoverStrip> strips;
};
void code(StepCodec& codec, SmoothedCurves& smoothed);
[[nodiscard]] SmoothedCurves smoothed_curves(const TileScene& dense, const std::vector<CoverStrip>& strips);

/// The counts as a note for the user: "5321 curves of the tool axis traced: 1712 long enough, ...".
[[nodiscard]] std::string counts_text(const CurveCounts& counts);

}  // namespace flank::internal
