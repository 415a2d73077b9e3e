#include "flank/fit/ways.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/fit/polish.h"
#include "flank/fit/swept_polish.h"

namespace flank::internal {
namespace {

/// Coverage is known to one of about 2,000 samples: nearer than that the score decides.
constexpr double kSameCoverage = 1e-3;
/// A clean result that covers less than this share of what another one covers is not what anybody asked for.
constexpr double kWorthHaving = 0.5;

/// The draft of a result, with what is in the way.
FitDraft draft_of(const Target& target, const ToolModel& tool, const FlankFitResult& result,
                  const ObstacleField* obstacles) {
  FitDraft draft;
  draft.targets.assign(result.motions.size(), &target);
  draft.obstacles.assign(result.motions.size(), obstacles);
  draft.motions = result.motions;
  draft.tool = result.tool;
  draft.free_tool = tool.free();
  draft.free_parameters = tool.free_parameters;
  return draft;
}

/// The deepest that the flank enters an obstacle at `count` places along the axis, over all motions and times, mm.
std::vector<double> depths_along(const FitDraft& draft, int count) {
  constexpr double kSight = 1.02;  // radii: what is farther than that is not entered
  constexpr std::size_t kPoses = kRankingPoses;
  std::vector<double> deepest(static_cast<std::size_t>(count), 0.0);
  parallel_for(deepest.size(), [&](std::size_t j) {
    const double s = draft.tool.axis_length() * static_cast<double>(j) / (count - 1.0), r = draft.tool.at(s).r;
    for (std::size_t m = 0; m < draft.motions.size(); ++m) {
      if (draft.obstacles[m] == nullptr) continue;
      for (std::size_t i = 0; i <= kPoses; ++i) {
        const Vec3 p = draft.motions[m].pose(static_cast<double>(i) / kPoses).at(s);
        deepest[j] = std::max(deepest[j], r - draft.obstacles[m]->at(p, kSight * r).distance_mm);
      }
    }
  });
  return deepest;
}

/// The motion of the axis' part from `from` on, `length` long.
RuledMotion part_of(const RuledMotion& motion, double from, double length) {
  constexpr int kPerControlPoint = 8;  // poses, as stages.cpp has them
  std::vector<Pose> poses;
  std::vector<double> times;
  const int samples = kPerControlPoint * motion.tip.count();
  for (int i = 0; i <= samples; ++i) {
    times.push_back(static_cast<double>(i) / samples);
    const Pose pose = motion.pose(times.back());
    poses.push_back({pose.at(from), pose.axis});
  }
  return fit_motion(poses, times, length, motion.tip.count());
}

RadialFunction part_of(const RadialFunction& tool, double from, double length) {
  constexpr int kSamples = 24;  // a coefficient
  const int count = tool.parameter_count();
  std::vector<Vec2> samples;
  for (int j = 0; j <= kSamples * count; ++j) {
    const double s = length * j / (kSamples * count);
    samples.emplace_back(s, tool.at(std::min(from + s, tool.axis_length())).r);
  }
  return RadialFunction::spline_through(length, samples, count);
}

/// The last passes with obstacles in the way, from a draft that was found without them.
Polished led_clear(const FitDraft& draft, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options) {
  const Polished start = assess(draft, samples, options);
  return settled(without_overcut(last_passes(start, samples, options, nullptr), samples, options), options);
}

struct Way {
  std::string_view name;
  Polished polished;
};

}  // namespace

bool is_clean(const CoverageEstimate& estimate, double tolerance_mm) {
  return estimate.overcut_mm <= tolerance_mm && estimate.gouge_mm <= tolerance_mm;
}

bool is_better(const CoverageEstimate& a, const CoverageEstimate& b, double tolerance_mm) {
  const bool clean_a = is_clean(a, tolerance_mm), clean_b = is_clean(b, tolerance_mm);
  if (clean_a != clean_b) {
    const double clean = clean_a ? a.at_tolerance : b.at_tolerance, other = clean_a ? b.at_tolerance : a.at_tolerance;
    return (clean >= kWorthHaving * other) == clean_a;
  }
  if (clean_a && std::abs(a.at_tolerance - b.at_tolerance) > kSameCoverage) return a.at_tolerance > b.at_tolerance;
  return a.score(tolerance_mm) > b.score(tolerance_mm);
}

std::optional<FitDraft> shortened(const FitDraft& draft, double tolerance_mm) {
  constexpr int kPlaces = 61;
  constexpr double kLeastLeft = 1.0 / 3.0;  // of the axis
  if (!draft.free_tool) return std::nullopt;
  const std::vector<double> depths = depths_along(draft, kPlaces);
  // The longest stretch of the axis that enters nothing.
  int from = 0, to = -1;
  for (int begin = 0; begin < kPlaces;) {
    int end = begin;
    while (end < kPlaces && depths[static_cast<std::size_t>(end)] <= tolerance_mm) ++end;
    if (end - 1 - begin > to - from) {
      from = begin;
      to = end - 1;
    }
    begin = end + 1;
  }
  const double length = draft.tool.axis_length(), step = length / (kPlaces - 1);
  if (to - from == kPlaces - 1 || (to - from) * step < kLeastLeft * length) return std::nullopt;
  FitDraft part = draft;
  part.tool = part_of(draft.tool, from * step, (to - from) * step);
  for (RuledMotion& motion : part.motions) motion = part_of(motion, from * step, (to - from) * step);
  return part;
}

FlankFitResult best_way(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                        FlankFitResult first, const StartSearch& search, const Progress& progress) {
  FlankFitOptions free_options = options;
  free_options.obstacles = nullptr;
  free_options.kept_after_polish = 1;  // a start for what follows, not a result
  const FlankFitResult free = search(free_options);
  if (free.motions.empty()) return first;
  const double tolerance = options.tolerance_mm;
  const FitDraft draft = draft_of(target, tool, free, options.obstacles);
  const std::vector<SurfaceSample> samples = ranking_samples(target, options.obstacles, options);
  std::vector<Way> ways;
  ways.push_back({"found without the other faces", settled(assess(draft, samples, options), options)});
  if (!is_clean(ways.front().polished.estimate, tolerance) && !progress.stop()) {
    ways.push_back({"found without the other faces and then led clear of them", led_clear(draft, samples, options)});
    const bool fixed_length = tool.axis_length || options.axis_length_mm;
    std::optional<FitDraft> part;
    if (!fixed_length && !is_clean(ways.back().polished.estimate, tolerance)) part = shortened(draft, tolerance);
    if (part) ways.push_back({"found without the other faces and then shortened", led_clear(*part, samples, options)});
  }
  const Way* best = nullptr;
  for (const Way& way : ways) {
    const CoverageEstimate& rival = best != nullptr ? best->polished.estimate : first.after;
    if ((best == nullptr && first.motions.empty()) || is_better(way.polished.estimate, rival, tolerance)) best = &way;
  }
  if (best == nullptr) return first;
  FlankFitResult result;
  result.before = free.before;
  result.trace = free.trace;
  result.candidates = first.candidates + free.candidates;
  result.notes = first.notes;
  result.notes.push_back(
      fmt::format("the motion was {}: it covers {:.1f} % (estimate); keeping clear from the start, {:.1f} %",
                  best->name, 100.0 * best->polished.estimate.at_tolerance, 100.0 * first.after.at_tolerance));
  return finish(best->polished, options, std::move(result));
}

}  // namespace flank::internal
