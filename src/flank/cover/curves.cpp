#include "flank/cover/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "flank/base/parallel.h"
#include "flank/cover/certify.h"
#include "flank/cover/line_clusters.h"
#include "flank/cover/line_groups.h"
#include "flank/cover/smooth.h"

namespace flank {
namespace {

constexpr int kControlPoints = 48;  ///< most, of a rail through a group's poses
/// Paper B's rule ends where every strip that is left overlaps by more than it allows, and leaves gaps. Then this factor
/// widens it, as long as strips add their price.
constexpr double kWiden = 2.0;

double limit_of(const TileScene& scene) {
  return (scene.options.curves.refine ? 1.0 : scene.options.curves.slack) * scene.options.tolerance_mm;
}

LineFitOptions loose_options(const TileScene& scene) {
  LineFitOptions options = line_options(scene);
  options.tolerance_mm = limit_of(scene);
  return options;
}

IntegralCurveOptions curve_options(const TileScene& scene) {
  const CurvesOptions& from = scene.options.curves;
  IntegralCurveOptions options;
  options.steps = from.steps;
  options.straightness_rad = from.straightness_rad;
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
  constexpr std::size_t kGrain = 16;
  parallel_blocks(seeds.size(), kGrain, [&](std::size_t begin, std::size_t end) {
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

/// Paper B's heuristic: the largest strip, then again and again the largest that overlaps those before it by less than a
/// share of its area.
std::vector<CoverStrip> chosen(const TileScene& scene, std::vector<CoverStrip> pool) {
  const CoverOptions& options = scene.options;
  std::stable_sort(pool.begin(), pool.end(), [](const CoverStrip& a, const CoverStrip& b) { return a.area > b.area; });
  CellCount covered(scene.samples);
  std::vector<CoverStrip> result;
  std::vector<char> taken(pool.size(), 0);
  for (double overlap = options.curves.most_overlap; overlap < kWiden; overlap *= kWiden) {
    for (std::size_t k = 0; k < pool.size() && static_cast<int>(result.size()) < options.most_strips; ++k) {
      const double gain = covered.gain(pool[k]);
      const bool apart = gain * scene.samples.area >= (1.0 - overlap) * pool[k].area;
      if (taken[k] != 0 || !apart || gain < options.strip_price) continue;
      taken[k] = 1;
      covered.add(pool[k]);
      result.push_back(pool[k]);
    }
  }
  return result;
}

}  // namespace

CurveStrips strips_of_curves(const TileScene& scene) {
  CurveStrips result;
  CurveCounts& counts = result.counts;
  const std::vector<StraightLine> lines = representatives(scene, lines_of(scene, counts));
  counts.clusters = static_cast<int>(lines.size());
  LineGroupOptions group_options;
  group_options.ends_alike = is_symmetric(scene.radial);
  const std::vector<LineGroup> groups = group_lines(lines, scene.radial.axis_length(), group_options);
  counts.groups = static_cast<int>(groups.size());
  std::vector<CoverStrip> pool = strips_through(scene, groups);
  counts.strips = static_cast<int>(pool.size());
  result.strips = chosen(scene, std::move(pool));
  return result;
}

SmoothedCurves smoothed_curves(const TileScene& dense, const std::vector<CoverStrip>& strips) {
  std::vector<CoverStrip> start(strips.size()), certain(strips.size());
  parallel_for(strips.size(), [&](std::size_t k) {
    LineFitter fitter(dense.target, dense.radial, line_options(dense));
    start[k] = measure_strip(dense.samples, strips[k].motion, dense.radial, fitter);
    certain[k] = cut_to_certified(dense.samples, dense.guard, lifted(dense.samples, start[k], dense.radial, fitter),
                                  dense.radial, fitter);
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
  result.strips = pruned(dense, std::move(result.strips));
  return result;
}

std::string counts_text(const CurveCounts& counts) {
  return fmt::format("{} integral curves, {} long enough, {} lines, {} clusters, {} groups, {} strips to choose from",
                     counts.seeds, counts.straight, counts.lines, counts.clusters, counts.groups, counts.strips);
}

}  // namespace flank
