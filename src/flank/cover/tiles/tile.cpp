#include "flank/cover/tiles/tile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "flank/base/parallel.h"
#include "flank/base/stopping.h"
#include "flank/path/turning.h"
#include "flank/seed/direction/seeds.h"
#include "flank/strip/certify.h"
#include "flank/strip/strip_record.h"

namespace flank::internal {
namespace {

/// Tilings that are tried, each from another first strip. Greedy choice depends on where it begins; each costs the
/// growing of its neighbours, and they run in parallel.
constexpr std::size_t kTilings = 6;
/// Two strips that share more than this of their cells are one as a first strip: their tilings would be the same.
constexpr double kAlike = 0.6;
/// Places along a strip (in t) where a neighbour is tried, in this order: the middle first, as a line there is most
/// likely to grow along the whole edge. One that adds enough ends it: kGoodNeighbour of what the strip itself covers.
constexpr std::array<double, 5> kPlaces = {0.5, 0.25, 0.75, 0.1, 0.9};
constexpr double kGoodNeighbour = 0.8;
/// Poses of a strip's edge that a neighbour follows: polygon segments a sixtieth long are straight beside the overlap.
constexpr int kGuidePoses = 60;
/// Least share of a line's footpoints that lie inside the target. A seed's line: what hangs over the border determines
/// little (MATH section 8). A line in a gap: gaps lie along borders and in corners, where lines hang over. A neighbour:
/// it starts an axis length further, often mostly past the border, and is led by the edge.
constexpr double kLeastInside = 0.8, kLeastInsideOfGaps = 0.25, kLeastInsideOfNeighbours = 0.05;
/// LineHold::slide_share of a line that was slid out of another face: firm enough that the correction leaves it there.
constexpr double kClearedSlide = 4.0;
/// Fewest poses of a strip (motion_through needs them), and most control points of its rails: those of grown strips are
/// many, so that little of what was certified is lost.
constexpr std::size_t kLeastPoses = 5;
constexpr int kGrownControlPoints = 48;
/// Places of gaps that get seeds in one round, and how near to each other (in axis lengths) they may be: a line through
/// one sees what is nearer.
constexpr std::size_t kMostGapPlaces = 8;
constexpr double kGapSpacing = 0.25;
/// Shares of the axis that touch at a gap's place: the middle, and near either end, which reaches into corners.
constexpr std::array<double, 3> kGapSpheres = {0.5, 0.15, 0.85};
/// Share of the area by which an exchange must be better: round-off of the sums of areas must not make it go round in
/// circles.
constexpr double kLeastImprovement = 1e-6;

/// What came of a pose.
struct NearStrip {
  CoverStrip strip;      ///< no cells: none
  bool line = false;     ///< a line within tolerance was found, whether or not it is clear and grows
  bool blocked = false;  ///< something else is in the way of the line, or ended its strip
};

/// The strip of a line near `pose`.
NearStrip strip_near(const TileScene& scene, LineFitter& fitter, const Pose& pose, const GrowGuide& guide,
                     double least_inside) {
  NearStrip near;
  const double tolerance = scene.options.tolerance_mm, length = scene.radial.axis_length();
  fitter.forget();
  LineFit line = fitter.refine(pose);
  if (line.touches() && line.largest_mm <= tolerance && !scene.guard.clear(line.pose))
    line = fitter.refine(slid_clear(scene.guard, line.pose, length), {Vec3::Zero(), kClearedSlide});
  if (!line.touches() || line.largest_mm > tolerance || line.inside_share < least_inside ||
      fitter.overcut(line.pose, tolerance) > tolerance)
    return near;
  near.line = true;
  near.blocked = !scene.guard.clear(line.pose);
  if (near.blocked) return near;
  const GrownStrip grown = grow(fitter, scene.guard, line, guide);
  near.blocked = grown.first == GrowEnd::kCheck || grown.last == GrowEnd::kCheck;
  if (grown.poses.size() < kLeastPoses) return near;
  CoverStrip strip =
      measure_strip(scene.samples, motion_through(grown.poses, length, kGrownControlPoints), scene.radial, fitter);
  // Its poses are clear; what lies between them is checked for the strips that are chosen: a guard without obstacles
  // here.
  near.strip = cut_to_certified(scene.samples, PoseGuard(), std::move(strip), scene.radial, fitter);
  return near;
}

/// The larger of two strips: near the pose, and, where something is in its way and the tool's ends are alike, near the pose turned end for
/// end. What holds the tool is at one end alone.
NearStrip strip_either_way(const TileScene& scene, LineFitter& fitter, const Pose& pose, double least_inside) {
  NearStrip near = strip_near(scene, fitter, pose, {}, least_inside);
  if (!near.blocked || !is_symmetric(scene.radial)) return near;
  NearStrip turned = strip_near(scene, fitter, {pose.at(scene.radial.axis_length()), -pose.axis}, {}, least_inside);
  return turned.strip.area > near.strip.area ? turned : near;
}

/// Strips beside `strip`, past its tip and past its holder end, that add to what is covered: the best of each side, two
/// at most. They start from the strip's own axis, shifted along itself by its length less the overlap.
std::vector<CoverStrip> neighbours(const TileScene& scene, const CoverStrip& strip, const CellCount& covered) {
  const double length = scene.radial.axis_length(), overlap = scene.options.overlap_share * length;
  std::vector<Pose> poses;
  for (int i = 0; i <= kGuidePoses; ++i) poses.push_back(strip.motion.pose(static_cast<double>(i) / kGuidePoses));
  std::vector<CoverStrip> found;
  LineFitter fitter(scene.target, scene.radial, line_options(scene));
  for (const bool beyond_tip : {true, false}) {
    const GrowGuide guide{&poses, beyond_tip, overlap};
    CoverStrip best;
    double most = 0.0;
    for (const double place : kPlaces) {
      if (stopping()) break;
      Pose pose = strip.motion.pose(place);
      pose.tip += (beyond_tip ? overlap - length : length - overlap) * pose.axis;
      CoverStrip trial = strip_near(scene, fitter, pose, guide, kLeastInsideOfNeighbours).strip;
      const double gain = covered.gain(trial);
      if (gain > most) {
        most = gain;
        best = std::move(trial);
      }
      if (most > kGoodNeighbour * strip.area / scene.samples.area) break;
    }
    if (most > 0.0) found.push_back(std::move(best));
  }
  return found;
}

/// Seeds at places that nothing covers, in even directions. The next place is the open cell farthest from those before
/// it (farthest-point sampling), so large gaps and far ones come first.
std::vector<LineSeed> gap_seeds(const TileScene& scene, const CellCount& covered) {
  std::vector<std::size_t> open = covered.open();
  std::vector<double> far(open.size(), 1e300);
  std::vector<LineSeed> seeds;
  const auto cell = [&](std::size_t i) -> const SurfaceSample& { return scene.samples.cells[open[i]]; };
  std::size_t next = 0;
  for (std::size_t places = 0; places < kMostGapPlaces && next < open.size(); ++places) {
    for (const double share : kGapSpheres)
      for (const Vec3& direction : seed_directions(cell(next).normal, scene.radial, scene.options.seed_directions))
        seeds.push_back({cell(next).point, cell(next).normal, direction, share * scene.radial.axis_length()});
    for (std::size_t i = 0; i < open.size(); ++i)
      far[i] = std::min(far[i], (cell(i).point - cell(next).point).squaredNorm());
    next = static_cast<std::size_t>(std::max_element(far.begin(), far.end()) - far.begin());
    if (far[next] < std::pow(kGapSpacing * scene.radial.axis_length(), 2)) break;
  }
  return seeds;
}

/// One tiling: the first strip, then always the one that adds most, until none is worth its price. `grown` are
/// the strips that were grown meanwhile; the set's indices at or above pool.size() count into it.
struct Tiling {
  StripSet set;
  std::vector<CoverStrip> grown;
};

Tiling tile_from(const TileScene& scene, const std::vector<CoverStrip>& pool, int first) {
  Tiling tiling;
  CellCount covered(scene.samples);
  const auto strip_at = [&](int k) -> const CoverStrip& {
    const auto i = static_cast<std::size_t>(k);
    return i < pool.size() ? pool[i] : tiling.grown[i - pool.size()];
  };
  const auto take = [&](int k) {
    tiling.set.push_back(k);
    covered.add(strip_at(k));
    for (CoverStrip& strip : neighbours(scene, strip_at(k), covered)) tiling.grown.push_back(std::move(strip));
  };
  take(first);
  while (static_cast<int>(tiling.set.size()) < scene.options.most_strips &&
         covered.covered() < scene.options.enough_coverage && !stopping()) {
    int best = -1;
    double most = scene.options.strip_price;
    for (int k = 0; k < static_cast<int>(pool.size() + tiling.grown.size()); ++k) {
      const double gain = covered.gain(strip_at(k));
      if (gain <= most) continue;
      most = gain;
      best = k;
    }
    if (best < 0) break;
    take(best);
  }
  return tiling;
}

/// Share of a's cells that b covers as well. Cells ascend in both.
double shared_cells(const CoverStrip& a, const CoverStrip& b) {
  std::vector<int> both;
  std::set_intersection(a.cells.begin(), a.cells.end(), b.cells.begin(), b.cells.end(), std::back_inserter(both));
  return static_cast<double>(both.size()) / static_cast<double>(std::max<std::size_t>(1, a.cells.size()));
}

/// The strips of most area, no two alike.
std::vector<int> first_strips(const std::vector<CoverStrip>& pool) {
  std::vector<int> order(pool.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](int k) -> const CoverStrip& { return pool[static_cast<std::size_t>(k)]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return at(a).area > at(b).area; });
  std::vector<int> firsts;
  for (const int k : order) {
    if (firsts.size() == kTilings) break;
    if (std::none_of(firsts.begin(), firsts.end(), [&](int f) { return shared_cells(at(k), at(f)) > kAlike; }))
      firsts.push_back(k);
  }
  return firsts;
}

/// Exchanges one for one, drops and adds while the value rises. It ends: every change raises the value by at least
/// kLeastImprovement, or takes away a strip.
StripSet improved(const TileScene& scene, const std::vector<CoverStrip>& pool, StripSet set) {
  CellCount covered(scene.samples);
  const auto at = [&](int k) -> const CoverStrip& { return pool[static_cast<std::size_t>(k)]; };
  for (const int k : set) covered.add(at(k));
  const auto best_addition = [&](double& most) {
    int best = -1;
    for (int k = 0; k < static_cast<int>(pool.size()); ++k) {
      const double gain = covered.gain(at(k));
      if (gain <= most) continue;
      most = gain;
      best = k;
    }
    return best;
  };
  for (bool changed = true; changed && !stopping();) {
    changed = false;
    for (std::size_t i = 0; i < set.size();) {
      covered.add(at(set[i]), -1);
      double most = std::max(covered.gain(at(set[i])), scene.options.strip_price) + kLeastImprovement;
      const int better = best_addition(most);
      if (better >= 0) {
        set[i] = better;
        changed = true;
      } else if (covered.gain(at(set[i])) < scene.options.strip_price) {
        set.erase(set.begin() + static_cast<std::ptrdiff_t>(i));
        changed = true;
        continue;
      }
      covered.add(at(set[i]));
      ++i;
    }
    double most = scene.options.strip_price + kLeastImprovement;
    const bool may_add =
        static_cast<int>(set.size()) < scene.options.most_strips && covered.covered() < scene.options.enough_coverage;
    const int more = may_add ? best_addition(most) : -1;
    if (more >= 0) {
      set.push_back(more);
      covered.add(at(more));
      changed = true;
    }
  }
  return set;
}

/// Strips of the seeds, in their order, without those that came to nothing; `lines` counts seeds with a line.
std::vector<CoverStrip> strips_of(const TileScene& scene, const std::vector<LineSeed>& seeds, double least_inside,
                                  int* lines) {
  std::vector<CoverStrip> strips(seeds.size());
  std::vector<char> is_line(seeds.size(), 0);
  parallel_for(seeds.size(), [&](std::size_t k) {
    if (stopping()) return;
    LineFitter fitter(scene.target, scene.radial, line_options(scene));
    NearStrip near = strip_either_way(scene, fitter, seed_pose(seeds[k], scene.radial), least_inside);
    strips[k] = std::move(near.strip);
    is_line[k] = near.line ? 1 : 0;
  });
  if (lines) *lines = static_cast<int>(std::count(is_line.begin(), is_line.end(), 1));
  std::erase_if(strips, [](const CoverStrip& strip) { return strip.cells.empty(); });
  return strips;
}

}  // namespace

void code(StepCodec& codec, CandidatePool& pool) {
  code(codec, pool.strips);
  code(codec, pool.lines);
}

LineFitOptions line_options(const TileScene& scene) {
  LineFitOptions options;
  options.tolerance_mm = scene.options.tolerance_mm;
  options.samples = scene.line_samples;
  return options;
}

TurnLimit turn_limit(const TileScene& scene) {
  /// The judge's window is that of a box about the cells of its own samples, which is hardly larger.
  constexpr double kSpare = 0.95;
  const double window = scene.options.turn_window_mm;
  return {kSpare * scene.options.most_turn_rad, window > 0.0 ? window : turn_window(scene.target.diagonal())};
}

CandidatePool grow_pool(const TileScene& scene, const std::vector<LineSeed>& seeds) {
  CandidatePool pool;
  pool.strips = strips_of(scene, seeds, kLeastInside, &pool.lines);
  return pool;
}

double set_value(const TileScene& scene, const std::vector<CoverStrip>& pool, const StripSet& set) {
  CellCount covered(scene.samples);
  for (const int k : set) covered.add(pool[static_cast<std::size_t>(k)]);
  return covered.covered() - scene.options.strip_price * static_cast<double>(set.size());
}

StripSet choose_set(const TileScene& scene, std::vector<CoverStrip>& pool) {
  const std::vector<int> firsts = first_strips(pool);
  std::vector<Tiling> tilings(firsts.size());
  parallel_for(firsts.size(), [&](std::size_t k) { tilings[k] = tile_from(scene, pool, firsts[k]); });
  // Each tiling numbers its own strips from the pool's size on: they are shifted as the pools are joined.
  const int seeded = static_cast<int>(pool.size());
  for (Tiling& tiling : tilings) {
    const int shift = static_cast<int>(pool.size()) - seeded;
    for (int& k : tiling.set) k += k >= seeded ? shift : 0;
    for (CoverStrip& strip : tiling.grown) pool.push_back(std::move(strip));
  }
  StripSet best;
  double most = -1.0;
  for (const Tiling& tiling : tilings) {
    const StripSet set = improved(scene, pool, tiling.set);
    const double value = set_value(scene, pool, set);
    if (value <= most) continue;
    most = value;
    best = set;
  }
  return best;
}

std::vector<CoverStrip> additions(const TileScene& scene, const std::vector<CoverStrip>& pool,
                                  const std::vector<CoverStrip>& strips) {
  CellCount covered(scene.samples);
  for (const CoverStrip& strip : strips) covered.add(strip);
  std::vector<std::vector<CoverStrip>> beside(strips.size());
  parallel_for(strips.size(), [&](std::size_t k) { beside[k] = neighbours(scene, strips[k], covered); });
  const std::vector<CoverStrip> in_gaps = strips_of(scene, gap_seeds(scene, covered), kLeastInsideOfGaps, nullptr);
  // Those from the gaps first: of equal gains the first wins, and they were made for what is open.
  std::vector<const CoverStrip*> candidates;
  for (const CoverStrip& strip : in_gaps) candidates.push_back(&strip);
  for (const auto& found : beside)
    for (const CoverStrip& strip : found) candidates.push_back(&strip);
  for (const CoverStrip& strip : pool) candidates.push_back(&strip);
  std::vector<CoverStrip> added;
  while (strips.size() + added.size() < static_cast<std::size_t>(scene.options.most_strips) &&
         covered.covered() < scene.options.enough_coverage) {
    const CoverStrip* best = nullptr;
    double most = scene.options.strip_price;
    for (const CoverStrip* strip : candidates) {
      const double gain = covered.gain(*strip);
      if (gain <= most) continue;
      most = gain;
      best = strip;
    }
    if (!best) break;
    covered.add(*best);
    added.push_back(*best);
  }
  return added;
}

std::vector<CoverStrip> pruned(const TileScene& scene, std::vector<CoverStrip> strips) {
  CellCount covered(scene.samples);
  for (const CoverStrip& strip : strips) covered.add(strip);
  while (strips.size() > 1) {
    std::size_t least = 0;
    double worth = scene.options.strip_price;
    bool found = false;
    for (std::size_t k = 0; k < strips.size(); ++k) {
      covered.add(strips[k], -1);
      const double gain = covered.gain(strips[k]);
      covered.add(strips[k]);
      if (gain >= worth) continue;
      worth = gain;
      least = k;
      found = true;
    }
    if (!found) break;
    covered.add(strips[least], -1);
    strips.erase(strips.begin() + static_cast<std::ptrdiff_t>(least));
  }
  return strips;
}

}  // namespace flank::internal
