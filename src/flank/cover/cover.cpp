#include "flank/cover.h"
#include "flank/base/stopping.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "flank/base/journal.h"
#include "flank/base/parallel.h"
#include "flank/base/tolerance_budget.h"
#include "flank/cover/cover_record.h"
#include "flank/cover/curves/curves.h"
#include "flank/cover/reasons.h"
#include "flank/cover/tiles/smooth.h"
#include "flank/error.h"
#include "flank/seed/direction/seeds.h"
#include "flank/seed/direction/shape_places.h"
#include "flank/strip/certify.h"
#include "flank/strip/strip_order.h"
#include "flank/strip/strip_record.h"
#include "flank/tool/radial_record.h"

namespace flank {
using namespace internal;

namespace {

/// Share of the area that smooth rails may cost: the same as smooth.cpp lets its first pass cost, less than half a
/// strip's default price.
constexpr double kSmoothWorth = 0.002;

/// Axis samples of certificates. Surfaces may ripple at their borders within a fraction of a millimetre.
/// 17 found 0.008 mm of depth on a real blade where there were 0.022 mm (docs/algorithms/cover.md).
constexpr int kCertifySamples = 81;

/// Most rounds of smoothing and adding. Each costs a whole SMOOTH, so this balances time against the last gaps; rounds
/// end before if no gap is worth a strip.
constexpr int kSmoothRounds = 3;
/// Most strips that are taken away again one after the other; each try costs a whole SMOOTH.
constexpr int kDrops = 2;
/// Share of the area that neighbours may be able to take over: a strip that adds more is not tried, as a try costs a
/// whole SMOOTH. A balance again: the more a strip adds, the less likely are the others to take it over.
constexpr double kTakenOver = 0.06;

/// Progress shown at the beginning of each stage, about its share of the time.
constexpr double kSamplesAt = 0.05, kGrowAt = 0.1, kTileAt = 0.35, kSmoothAt = 0.55, kSmoothRoundStep = 0.1,
                 kThinAt = 0.8;

/// The strips that a step leaves, measured with these samples.
template <class Work>
std::vector<CoverStrip> kept_strips(const Progress& progress, const char* step, const CoverSamples& samples,
                                    const Work& work) {
  std::vector<CoverStrip> strips = journaled(progress, step, work);
  require_cells(strips, samples);
  return strips;
}

/// Wall time of the stages, for people; nothing is decided by it.
class Stopwatch {
 public:
  explicit Stopwatch(CoverResult& result) : result_(result) {}
  void lap(const char* stage) {
    const auto now = std::chrono::steady_clock::now();
    result_.seconds.emplace_back(stage, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }

 private:
  CoverResult& result_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Leaves out the cells that a ball of the tool's smallest radius cannot touch without entering an obstacle; returns
/// the area share of the others.
double keep_reachable(CoverSamples& samples, const PoseGuard& guard) {
  std::vector<char> open(samples.cells.size());
  parallel_for(samples.cells.size(), [&](std::size_t k) {
    const SurfaceSample& cell = samples.cells[k];
    open[k] = guard.ball_is_clear(cell.point + guard.ball_radius() * cell.normal) ? 1 : 0;
  });
  CoverSamples kept;
  kept.border = samples.border;
  for (std::size_t k = 0; k < open.size(); ++k) {
    if (open[k] == 0) continue;
    kept.cells.push_back(samples.cells[k]);
    kept.area += samples.cells[k].area;
  }
  const double share = kept.area / samples.area;
  samples = std::move(kept);
  return share;
}

/// The tool as it is planned with: where nothing is said to stand above its flank, a rod in its axis to beyond everything, somewhat thicker
/// than the one that the judge asks for.
Tool held_tool(const Tool& tool, const Target& target, const Obstacles& obstacles) {
  constexpr double kThicker = 1.5;
  Tool held = tool;
  if (!tool.shank.empty() || !tool.holder.empty() || obstacles.meshes.empty()) return held;
  Box3 box = target.box();
  for (const ObstacleMesh& mesh : obstacles.meshes) box.add(mesh.mesh.box());
  const double length = tool.radial.axis_length(), radius = kThicker * kRodShare * tool.radial.at(length).r;
  held.shank = {{length, radius}, {length + box.diagonal(), radius}};
  return held;
}

/// How much more the strips cover one by one than together, as a share of the latter.
double overlap_of(const CoverSamples& samples, const std::vector<CoverStrip>& strips) {
  double sum = 0.0;
  for (const CoverStrip& strip : strips) sum += strip.area;
  const double covered = covered_share(samples, strips) * samples.area;
  return covered > 0.0 ? sum / covered - 1.0 : 0.0;
}

/// Strips were chosen by coarse samples: what cuts too deep between those is lifted, or else cut short.
std::vector<CoverStrip> certify_all(const TileScene& dense, std::vector<CoverStrip> strips) {
  parallel_for(strips.size(), [&](std::size_t k) {
    LineFitter fitter(dense.target, dense.radial, line_options(dense));
    const CoverStrip raised = lifted(dense.samples, dense.guard, std::move(strips[k]), dense.radial, fitter);
    strips[k] = cut_to_certified(dense.samples, dense.guard, raised, dense.radial, fitter);
  });
  std::erase_if(strips, [](const CoverStrip& strip) { return strip.cells.empty(); });
  return strips;
}

/// The pieces of all strips between their kinks.
std::vector<CoverStrip> between_kinks(const TileScene& dense, const std::vector<CoverStrip>& strips) {
  std::vector<std::vector<CoverStrip>> pieces(strips.size());
  parallel_for(strips.size(), [&](std::size_t k) {
    LineFitter fitter(dense.target, dense.radial, line_options(dense));
    pieces[k] = cut_at_kinks(dense.samples, dense.guard, strips[k], dense.radial, fitter, turn_limit(dense));
  });
  std::vector<CoverStrip> steady;
  for (std::vector<CoverStrip>& of_strip : pieces)
    for (CoverStrip& piece : of_strip) steady.push_back(std::move(piece));
  return steady;
}

/// The worth of a set: covered share less a price for each strip, by which all choices here are made.
double value_of(const TileScene& scene, const std::vector<CoverStrip>& strips) {
  return covered_share(scene.samples, strips) - scene.options.strip_price * static_cast<double>(strips.size());
}

/// Smooths; if that leaves gaps that are worth a strip, adds it and smooths again. Returns the best set on the way.
std::vector<CoverStrip> smoothed(const TileScene& coarse, const TileScene& dense, const std::vector<CoverStrip>& pool,
                                 std::vector<CoverStrip> strips, const Progress& progress) {
  if (stopping()) return strips;
  // Certified before they are compared: a strip's share counts only as far as it may be cut.
  strips =
      kept_strips(progress, "certify", dense.samples, [&] { return certify_all(dense, remeasured(dense, strips)); });
  std::vector<CoverStrip> best = between_kinks(dense, strips);
  for (int round = 0; round < kSmoothRounds && dense.options.smooth && !progress.stop(); ++round) {
    progress.step("smooth", kSmoothAt + kSmoothRoundStep * round);
    strips = kept_strips(progress, "smooth", dense.samples,
                         [&] { return pruned(dense, smooth_strips(dense, strips).strips); });
    // The first round may cost a little: rails that were fitted are fairer than rails that were grown.
    if (value_of(dense, strips) > value_of(dense, best) - (round == 0 ? kSmoothWorth : 0.0)) best = strips;
    if (round + 1 == kSmoothRounds) break;
    const std::vector<CoverStrip> more = kept_strips(progress, "add", dense.samples, [&] {
      return certify_all(dense, remeasured(dense, additions(coarse, pool, remeasured(coarse, strips))));
    });
    if (more.empty()) break;
    strips.insert(strips.end(), more.begin(), more.end());
  }
  return best;
}

/// Drops the strip that adds least if the others, smoothed again, take over what it covered.
std::vector<CoverStrip> drop_redundant(const TileScene& dense, std::vector<CoverStrip> strips,
                                       const Progress& progress) {
  for (int k = 0; k < kDrops && dense.options.smooth && !progress.stop(); ++k) {
    progress.step("drop redundant passes", kThinAt);
    CellCount covered(dense.samples);
    for (const CoverStrip& strip : strips) covered.add(strip);
    std::size_t least = 0;
    double worth = kTakenOver;
    bool found = false;
    for (std::size_t i = 0; i < strips.size() && strips.size() > 1; ++i) {
      covered.add(strips[i], -1);
      const double gain = covered.gain(strips[i]);
      covered.add(strips[i]);
      if (gain >= worth) continue;
      worth = gain;
      least = i;
      found = true;
    }
    if (!found) break;
    std::vector<CoverStrip> fewer = strips;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(least));
    fewer = kept_strips(progress, "drop redundant passes", dense.samples,
                        [&] { return smooth_strips(dense, fewer).strips; });
    if (value_of(dense, fewer) <= value_of(dense, strips)) break;
    strips = std::move(fewer);
  }
  return strips;
}

/// The last and finest check of each strip, which is cut where it has a kink.
std::vector<CoverStrip> certify_finely(const TileScene& dense, std::vector<CoverStrip> strips) {
  if (stopping()) return strips;
  parallel_for(strips.size(), [&](std::size_t k) {
    LineFitter fitter(dense.target, dense.radial, line_options(dense));
    strips[k] = cut_finely(dense.samples, dense.guard, std::move(strips[k]), dense.radial, fitter);
  });
  std::erase_if(strips, [](const CoverStrip& strip) { return strip.cells.empty(); });
  return pruned(dense, between_kinks(dense, strips));
}

/// Fills the result from the strips that are left.
void describe(const TileScene& coarse, const TileScene& dense, const std::vector<CoverStrip>& strips,
              CoverResult& result) {
  result.status = strips.empty() ? CoverStatus::kNoStrip : CoverStatus::kCovered;
  result.coverage = covered_share(dense.samples, strips);
  result.overlap = overlap_of(dense.samples, strips);
  for (const CoverStrip& strip : strips) {
    result.overcut_mm = std::max(result.overcut_mm, strip.overcut_mm);
    result.motions.push_back(strip.motion);
  }
  result.motions = ordered(result.motions);
  if (stopping()) return;
  result.message =
      reason_of(coarse.target, coarse.radial, coarse.samples, remeasured(coarse, strips), coarse.options.tolerance_mm);
}

/// A set out of a pool, and the strips by which that has grown.
struct Choice {
  StripSet set;
  std::vector<CoverStrip> grown;
};

void code(StepCodec& codec, Choice& choice) {
  code(codec, choice.set);
  code(codec, choice.grown);
}

/// Grows the strips of these seeds, and notes their numbers in the result.
CandidatePool counted_pool(const TileScene& scene, const std::vector<LineSeed>& seeds, CoverResult& result,
                           const Progress& progress) {
  CandidatePool pool = journaled(
      progress, "grow", [&] { return grow_pool(scene, seeds); }, seeds.size());
  require_cells(pool.strips, scene.samples);
  result.seeds = static_cast<int>(seeds.size());
  result.lines = pool.lines;
  return pool;
}

/// Strips of the first seeds. What the filter leaves is a third of all directions; if none of it leads to a strip, all
/// are tried.
CandidatePool first_pool(const TileScene& scene, CoverResult& result, const Progress& progress) {
  const CoverOptions& options = scene.options;
  if (!options.seeds.empty()) return counted_pool(scene, options.seeds, result, progress);
  const std::vector<SurfaceSample> places = options.places == SeedPlaces::kShape
                                                ? shape_places(scene.target, options.seed_places)
                                                : grid_places(scene.target, options.seed_places);
  if (options.directions == SeedDirections::kAdmissible) {
    CandidatePool pool = counted_pool(
        scene, admissible_seeds(scene.target, places, scene.radial, options.seed_spheres, options.tolerance_mm), result,
        progress);
    if (!pool.strips.empty() || stopping()) return pool;
  }
  return counted_pool(scene, even_seeds(places, scene.radial, options.seed_directions), result, progress);
}

/// The strips that were chosen; `pool` gets those that were grown meanwhile.
std::vector<CoverStrip> chosen(const TileScene& scene, std::vector<CoverStrip>& pool, const Progress& progress) {
  const std::size_t before = pool.size();
  Choice choice = journaled(progress, "tile", [&] {
    std::vector<CoverStrip> all = pool;
    StripSet set = choose_set(scene, all);
    return Choice{std::move(set), {all.begin() + static_cast<std::ptrdiff_t>(before), all.end()}};
  });
  require_cells(choice.grown, scene.samples);
  pool.insert(pool.end(), choice.grown.begin(), choice.grown.end());
  std::vector<CoverStrip> strips;
  for (const int k : choice.set) {
    if (k < 0 || static_cast<std::size_t>(k) >= pool.size())
      throw InputError(
          "resume.json does not fit this run; start without --resume: a step names a pass that does not exist");
    strips.push_back(pool[static_cast<std::size_t>(k)]);
  }
  return strips;
}

/// The samples by which strips are certified and reported.
CoverSamples dense_samples(const TileScene& scene, const PoseGuard& guard, CoverResult& result) {
  CoverSamples dense = cover_samples(scene.target, scene.options.dense_share * std::sqrt(scene.target.area()));
  result.reachable = keep_reachable(dense, guard);
  return dense;
}

/// Nothing to choose from.
CoverResult empty_result(const TileScene& scene, int lines, CoverResult result) {
  result.status = lines == 0 ? CoverStatus::kNoLine : CoverStatus::kNoStrip;
  result.message = scene.samples.cells.empty()
                       ? "this tool is too thick: a ball of its smallest radius touches the face nowhere without "
                         "gouging another face"
                       : reason_of(scene.target, scene.radial, scene.samples, {}, scene.options.tolerance_mm);
  return result;
}

/// Strategy `curves`, once there are samples.
CoverResult curves_cover(const TileScene& scene, const PoseGuard& guard, CoverResult result, const Progress& progress) {
  Stopwatch watch(result);
  progress.step("curves", kGrowAt);
  const CurveStrips found = journaled(progress, "curves", [&] { return strips_of_curves(scene); });
  require_cells(found.strips, scene.samples);
  result.seeds = found.counts.seeds;
  result.lines = found.counts.lines;
  result.grown = found.counts.strips;
  result.notes.push_back(counts_text(found.counts));
  watch.lap("curves");
  if (found.strips.empty()) return empty_result(scene, found.counts.lines, std::move(result));

  progress.step("smooth", kSmoothAt);
  const CoverSamples dense = dense_samples(scene, guard, result);
  const TileScene dense_scene{scene.target, scene.radial, dense, guard, scene.options, kCertifySamples};
  const SmoothedCurves smooth =
      journaled(progress, "smooth", [&] { return smoothed_curves(dense_scene, found.strips); });
  require_cells(smooth.strips, dense);
  result.coverage_before = smooth.coverage_before;
  watch.lap("smooth");
  describe(scene, dense_scene, certify_finely(dense_scene, smooth.strips), result);
  watch.lap("order");
  return result;
}

CoverResult search_strips(const Target& target, const Tool& tool, const Obstacles& obstacles,
                          const CoverOptions& options, const Progress& progress) {
  CoverResult result;
  Stopwatch watch(result);
  progress.step("samples", kSamplesAt);
  // How deep the tool may enter other faces: less than the tolerance in a certificate, and less still while strips
  // grow (tolerance_budget.h).
  const PoseGuard guard(held_tool(tool, target, obstacles), obstacles,
                        -kToleranceBudget.others.certified * options.tolerance_mm);
  const PoseGuard grow_guard = guard.with_floor(-kToleranceBudget.others.growing * options.tolerance_mm);
  CoverSamples samples = cover_samples(target, options.sample_share * std::sqrt(target.area()));
  result.reachable = keep_reachable(samples, guard);
  // Strips grow on coarse samples and under the stricter guard; they are certified by dense ones.
  const TileScene scene{target, tool.radial, samples, grow_guard, options};
  watch.lap("samples");
  if (options.strategy == CoverStrategy::kCurves) return curves_cover(scene, guard, std::move(result), progress);

  progress.step("grow", kGrowAt);
  CandidatePool pool = first_pool(scene, result, progress);
  watch.lap("grow");
  if (pool.strips.empty() || samples.cells.empty()) return empty_result(scene, pool.lines, std::move(result));

  progress.step("tile", kTileAt);
  std::vector<CoverStrip> strips = chosen(scene, pool.strips, progress);
  result.grown = static_cast<int>(pool.strips.size());
  result.coverage_before = covered_share(samples, strips);
  watch.lap("tile");

  progress.step("smooth", kSmoothAt);
  const CoverSamples dense = dense_samples(scene, guard, result);
  const TileScene dense_scene{target, tool.radial, dense, guard, options, kCertifySamples};
  strips = drop_redundant(dense_scene, smoothed(scene, dense_scene, pool.strips, strips, progress), progress);
  watch.lap("smooth");

  strips = kept_strips(progress, "last check", dense, [&] { return certify_finely(dense_scene, strips); });
  describe(scene, dense_scene, strips, result);
  watch.lap("order");
  return result;
}

}  // namespace

CoverResult cover(const Target& target, const Tool& tool, const Obstacles& obstacles, const CoverOptions& options,
                  const Progress& progress) {
  return journaled(
      progress, "cover", [&] { return search_strips(target, tool, obstacles, options, progress); }, options,
      tool.radial);
}

}  // namespace flank
