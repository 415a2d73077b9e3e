#include "flank/cover/curves/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/cover/curves/line_clusters.h"
#include "flank/cover/curves/line_groups.h"
#include "flank/cover/tiles/smooth.h"
#include "flank/seed/direction/seeds.h"
#include "flank/strip/certify.h"
#include "flank/strip/strip_record.h"

namespace flank::internal {
namespace {

/// Most control points of a rail through a group's poses: as many as smoothed rails have at most by default. Fewer than
/// the group has lines showed no gain (docs/algorithms/curves.md).
constexpr int kControlPoints = 48;
/// An arc of length L that turns by phi leaves its chord by the sagitta L phi / 8.
constexpr double kSagitta = 8.0;
/// Seeds per task: enough for a fitter's memory to be worth setting up.
constexpr std::size_t kSeedGrain = 16;

double limit_of(const TileScene& scene) {
  return (scene.options.curves.refine ? 1.0 : scene.options.curves.slack) * scene.options.tolerance_mm;
}

/// Lines are refined and measured with what they may be off, not with the tolerance: SMOOTH takes the rest.
LineFitOptions loose_options(const TileScene& scene) {
  LineFitOptions options = line_options(scene);
  options.tolerance_mm = limit_of(scene);
  return options;
}

/// A line beside the curve by x across the normal is off by at most x^2 / (2 r) there, and a curve of length L that
/// turns by phi has a line within x = L phi / 8: so much turning costs slack tolerances and no more.
double straightness_of(const TileScene& scene) {
  const CurvesOptions& from = scene.options.curves;
  if (from.straightness_rad > 0.0) return from.straightness_rad;
  const double length = scene.radial.axis_length(), r = scene.radial.at(0.5 * length).r;
  return std::max(kStraightnessRad, kSagitta * std::sqrt(2.0 * r * from.slack * scene.options.tolerance_mm) / length);
}

IntegralCurveOptions curve_options(const TileScene& scene) {
  const CurvesOptions& from = scene.options.curves;
  IntegralCurveOptions options;
  options.steps = from.steps;
  options.straightness_rad = straightness_of(scene);
  options.step_by_step = from.step_by_step;
  options.filter = {scene.options.tolerance_mm, scene.radial.axis_length(), from.slack};
  return options;
}

/// The lines of all curves, in the order of the seeds.
std::vector<StraightLine> lines_of(const TileScene& scene, CurveCounts& counts) {
  const CurvesOptions& from = scene.options.curves;
  const IntegralCurveOptions options = curve_options(scene);
  StraightLineOptions line_options;
  line_options.most_error_mm = limit_of(scene);
  line_options.refine = from.refine;
  const std::vector<CurveSeed> seeds =
      curve_seeds(scene.target, scene.radial, from.places, from.spheres, options.filter);
  std::vector<std::optional<StraightLine>> found(seeds.size());
  std::vector<char> straight(seeds.size(), 0);
  parallel_blocks(seeds.size(), kSeedGrain, [&](std::size_t begin, std::size_t end) {
    LineFitter fitter(scene.target, scene.radial, loose_options(scene));
    for (std::size_t k = begin; k < end; ++k) {
      const IntegralCurve curve = integral_curve(scene.target, scene.radial, seeds[k], options);
      straight[k] = curve.span() >= line_options.least_span * scene.radial.axis_length() ? 1 : 0;
      found[k] = straight_line(curve, fitter, scene.guard, line_options);
    }
  });
  std::vector<StraightLine> lines;
  for (const auto& line : found)
    if (line) lines.push_back(*line);
  counts.seeds = static_cast<int>(seeds.size());
  counts.straight = static_cast<int>(std::count(straight.begin(), straight.end(), 1));
  counts.lines = static_cast<int>(lines.size());
  return lines;
}

/// The lines that stand for their clusters.
std::vector<StraightLine> representatives(const TileScene& scene, const std::vector<StraightLine>& lines) {
  LineClusterOptions options;
  options.clusters = scene.options.curves.clusters;
  options.seed = scene.options.curves.seed;
  options.ends_alike = is_symmetric(scene.radial);
  std::vector<Pose> poses;
  for (const StraightLine& line : lines) poses.push_back(line.pose);
  std::vector<StraightLine> result;
  for (const int k : cluster_lines(poses, scene.radial.axis_length(), options).representatives)
    result.push_back(lines[static_cast<std::size_t>(k)]);
  return result;
}

std::vector<CoverStrip> strips_through(const TileScene& scene, const std::vector<LineGroup>& groups) {
  std::vector<CoverStrip> strips(groups.size());
  parallel_for(groups.size(), [&](std::size_t k) {
    LineFitter fitter(scene.target, scene.radial, loose_options(scene));
    RuledMotion motion = motion_through(groups[k].poses, scene.radial.axis_length(), kControlPoints);
    strips[k] = measure_strip(scene.samples, std::move(motion), scene.radial, fitter);
  });
  std::erase_if(strips, [](const CoverStrip& strip) { return strip.cells.empty(); });
  return strips;
}

/// The strip that adds most, of those that overlap what is covered by at most a share of their area; -1: none is worth
/// it.
int next_strip(const std::vector<CoverStrip>& pool, const CellCount& covered, double area, double most_overlap,
               double price) {
  int best = -1;
  double most = price;
  for (std::size_t k = 0; k < pool.size(); ++k) {
    const double gain = covered.gain(pool[k]);
    // gain * area: what it adds, mm^2. So this says: at most the share `most_overlap` of the strip is covered already.
    if (gain <= most || gain * area < (1.0 - most_overlap) * pool[k].area) continue;
    most = gain;
    best = static_cast<int>(k);
  }
  return best;
}

/// Paper B's heuristic: the largest strip, then again and again the largest that hardly overlaps those before it. It
/// ends with gaps, so what adds most follows as long as it is worth it.
std::vector<CoverStrip> chosen(const TileScene& scene, const std::vector<CoverStrip>& pool) {
  const CoverOptions& options = scene.options;
  CellCount covered(scene.samples);
  std::vector<CoverStrip> result;
  for (const double overlap : {options.curves.most_overlap, 1.0}) {  // 1: any overlap
    while (static_cast<int>(result.size()) < options.most_strips) {
      const int k = next_strip(pool, covered, scene.samples.area, overlap,
                               std::max(options.strip_price, options.curves.least_gain));
      if (k < 0) break;
      result.push_back(pool[static_cast<std::size_t>(k)]);
      covered.add(result.back());
    }
  }
  return result;
}

}  // namespace

void code(StepCodec& codec, CurveStrips& found) {
  CurveCounts& counts = found.counts;
  code(codec, found.strips);
  for (int* count : {&counts.seeds, &counts.straight, &counts.lines, &counts.clusters, &counts.groups, &counts.strips})
    code(codec, *count);
}

void code(StepCodec& codec, SmoothedCurves& smoothed) {
  codec.number(smoothed.coverage_before);
  code(codec, smoothed.strips);
}

CurveStrips strips_of_curves(const TileScene& scene) {
  CurveStrips result;
  CurveCounts& counts = result.counts;
  const std::vector<StraightLine> lines = representatives(scene, lines_of(scene, counts));
  counts.clusters = static_cast<int>(lines.size());
  LineGroupOptions group_options;
  group_options.ends_alike = is_symmetric(scene.radial);
  const std::vector<LineGroup> groups = group_lines(lines, scene.radial.axis_length(), group_options);
  counts.groups = static_cast<int>(groups.size());
  const std::vector<CoverStrip> pool = strips_through(scene, groups);
  counts.strips = static_cast<int>(pool.size());
  result.strips = chosen(scene, pool);
  return result;
}

SmoothedCurves smoothed_curves(const TileScene& dense, const std::vector<CoverStrip>& strips) {
  std::vector<CoverStrip> start(strips.size()), certain(strips.size());
  parallel_for(strips.size(), [&](std::size_t k) {
    LineFitter fitter(dense.target, dense.radial, line_options(dense));
    start[k] = measure_strip(dense.samples, strips[k].motion, dense.radial, fitter);
    certain[k] =
        cut_to_certified(dense.samples, dense.guard, lifted(dense.samples, dense.guard, start[k], dense.radial, fitter),
                         dense.radial, fitter);
    // Not certified, so it must not count as something to fall back to; its motion is still what SMOOTH starts from.
    if (!is_certified(dense.guard, start[k], dense.options.tolerance_mm)) start[k].cells.clear();
  });
  const auto drop_empty = [](std::vector<CoverStrip>& all) {
    std::erase_if(all, [](const CoverStrip& strip) { return strip.cells.empty(); });
  };
  drop_empty(certain);
  SmoothedCurves result{covered_share(dense.samples, certain), certain};
  if (dense.options.smooth && !start.empty()) {
    SmoothResult smooth = smooth_strips(dense, start);
    drop_empty(smooth.strips);
    if (covered_share(dense.samples, smooth.strips) > result.coverage_before) result.strips = std::move(smooth.strips);
  }
  return result;
}

std::string counts_text(const CurveCounts& counts) {
  return fmt::format(
      "{} curves of the tool axis traced: {} long enough, {} of them straight enough to follow; merged to {} lines "
      "in {} groups, from which {} passes are possible",
      counts.seeds, counts.straight, counts.lines, counts.clusters, counts.groups, counts.strips);
}

}  // namespace flank::internal
