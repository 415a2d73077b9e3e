/// TILE (MATH section 8): candidates for strips, and the set of them that covers most for its price.
///
/// Which set covers most is a set-cover problem, which is hard; greedy choice from several beginnings and local
/// exchanges come near it. All functions are deterministic for any number of threads. Strips and scenes go together:
/// cells of a strip are indices into the samples of the scene that measured it (smooth.h, remeasured).
#pragma once

#include <vector>

#include "flank/base/step_codec.h"
#include "flank/cover_options.h"
#include "flank/obstacle/pose_guard.h"
#include "flank/radial_function.h"
#include "flank/strip/grow.h"
#include "flank/strip/kinks.h"
#include "flank/strip/strip_measure.h"
#include "flank/target.h"

namespace flank::internal {

/// What candidates are grown with; all by reference, for many threads. Everything referred to must outlive it.
struct TileScene {
  const Target& target;
  const RadialFunction& radial;
  const CoverSamples& samples;
  const PoseGuard& guard;
  const CoverOptions& options;
  /// Of the axis, where lines and depths are measured, >= 2. Few while candidates are grown; certificates take 81
  /// (cover.cpp), because ripples of a spline at its border slip between few.
  int line_samples = 17;
};

/// What its strips may turn by.
[[nodiscard]] TurnLimit turn_limit(const TileScene& scene);

/// Options of a LineFitter for the scene: its tolerance and its samples of the axis.
[[nodiscard]] LineFitOptions line_options(const TileScene& scene);

/// Candidates that were grown from seeds.
struct CandidatePool {
  std::vector<CoverStrip> strips;
  int lines = 0;  ///< seeds that refined to within tolerance
};

/// Among the values of a finished step (base/step_codec.h).
void code(StepCodec& codec, CandidatePool& pool);

/// Strips grown from the seeds, in their order, without those that came to nothing. Each is certified not to cut too
/// deep; its poses are clear of other faces, what lies between them is checked only for strips that are chosen.
[[nodiscard]] CandidatePool grow_pool(const TileScene& scene, const std::vector<LineSeed>& seeds);

/// A set of strips: indices into a pool.
using StripSet = std::vector<int>;

/// What a set is worth: covered share of the area minus strip_price for each of its strips.
[[nodiscard]] double set_value(const TileScene& scene, const std::vector<CoverStrip>& pool, const StripSet& set);

/// The best set that was found. Several tilings are tried, each from another first strip: strips that follow the edge
/// of a chosen one are grown as they are needed and join the pool. Then strips are exchanged one for one, added and
/// dropped as long as the value rises. `pool` gets longer; indices of the set count into what it is afterwards. Empty
/// for an empty pool; never more than most_strips.
[[nodiscard]] StripSet choose_set(const TileScene& scene, std::vector<CoverStrip>& pool);

/// Strips that each add more than their price to what `strips` and those before it cover, the best first: from the
/// pool, new ones beside `strips`, and new ones from seeds in the gaps.
[[nodiscard]] std::vector<CoverStrip> additions(const TileScene& scene, const std::vector<CoverStrip>& pool,
                                                const std::vector<CoverStrip>& strips);

/// The strips without those that add less than their price to what the others cover: the one that adds least is dropped
/// first, and then the rest is checked again. At least one strip stays.
[[nodiscard]] std::vector<CoverStrip> pruned(const TileScene& scene, std::vector<CoverStrip> strips);

}  // namespace flank::internal
