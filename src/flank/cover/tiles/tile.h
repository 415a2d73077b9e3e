/// TILE (MATH section 8): candidates for strips, and the set of them that covers most for its price.
#pragma once

#include <vector>

#include "flank/cover/cover.h"
#include "flank/strip/grow.h"
#include "flank/strip/strip_measure.h"

namespace flank::internal {

/// What candidates are grown with; all by reference, for many threads.
struct TileScene {
  const Target& target;
  const RadialFunction& radial;
  const CoverSamples& samples;
  const LineGuard& guard;
  const CoverOptions& options;
  int line_samples = 17;  ///< of the axis, where lines and depths are measured
};

[[nodiscard]] LineFitOptions line_options(const TileScene& scene);

struct CandidatePool {
  std::vector<CoverStrip> strips;
  int lines = 0;  ///< seeds that refined to within tolerance
};

/// Strips grown from the seeds, in their order, each clear of other faces and without overcut.
[[nodiscard]] CandidatePool grow_pool(const TileScene& scene, const std::vector<LineSeed>& seeds);

/// A set of strips: indices into a pool.
using StripSet = std::vector<int>;

/// What a set is worth: covered share of the area less the price of its strips.
[[nodiscard]] double set_value(const TileScene& scene, const std::vector<CoverStrip>& pool, const StripSet& set);

/// The best set that was found. Several tilings are tried, each from another first strip: strips that follow the edge
/// of a chosen one are grown as they are needed and join the pool. Then strips are exchanged one for one, added and
/// dropped as long as the value rises.
[[nodiscard]] StripSet choose_set(const TileScene& scene, std::vector<CoverStrip>& pool);

/// Strips of the pool, and new ones beside `strips`, that add more than their price to what `strips` cover; each adds to
/// those before it.
[[nodiscard]] std::vector<CoverStrip> additions(const TileScene& scene, const std::vector<CoverStrip>& pool,
                                                const std::vector<CoverStrip>& strips);

/// The strips without those that are not worth their price, the least first.
[[nodiscard]] std::vector<CoverStrip> pruned(const TileScene& scene, std::vector<CoverStrip> strips);

}  // namespace flank::internal
