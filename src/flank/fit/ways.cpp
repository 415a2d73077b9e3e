#include "flank/fit/ways.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/journal.h"
#include "flank/base/parallel.h"
#include "flank/base/stopping.h"
#include "flank/base/tolerance_budget.h"
#include "flank/error.h"
#include "flank/fit/coverage.h"
#include "flank/fit/fit_record.h"
#include "flank/fit/polish.h"
#include "flank/fit/rank.h"
#include "flank/fit/rejected.h"
#include "flank/fit/swept_polish.h"

namespace flank::internal {
namespace {

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

/// Places along the axis and times at which a flank is asked how deep it enters something.
constexpr int kPlaces = 61;
constexpr int kTimes = kRankingPoses + 1;

/// Less than any depth. Depths below zero count: where one is reached lies between two of them.
constexpr double kFree = -1e300;

/// How deep the flank of one motion enters obstacles, mm: the most of each place of the axis, and of each time.
struct Depths {
  std::vector<double> along = std::vector<double>(kPlaces, kFree), over = std::vector<double>(kTimes, kFree);
};

Depths depths_of(const FitDraft& draft, std::size_t motion) {
  constexpr double kSight = 2.0;  // radii: what is farther than that decides nothing, not even between two places
  std::vector<std::array<double, kPlaces>> all(kTimes);
  parallel_for(all.size(), [&](std::size_t i) {
    const Pose pose = draft.motions[motion].pose(static_cast<double>(i) / (kTimes - 1.0));
    for (std::size_t j = 0; j < kPlaces; ++j) {
      const double s = draft.tool.axis_length() * static_cast<double>(j) / (kPlaces - 1.0), r = draft.tool.at(s).r;
      all[i][j] = r - draft.obstacles[motion]->at(pose.at(s), kSight * r).distance_mm;
    }
  });
  Depths depths;
  for (std::size_t i = 0; i < kTimes; ++i) {
    for (std::size_t j = 0; j < kPlaces; ++j) {
      depths.along[j] = std::max(depths.along[j], all[i][j]);
      depths.over[i] = std::max(depths.over[i], all[i][j]);
    }
  }
  return depths;
}

/// A part of the whole, as first and last share of it.
struct Stretch {
  double from = 0.0, to = 0.0;
};

/// Where between a place within the limit and one beyond it, as a share of the way, the limit is reached.
double crossing(double within, double beyond, double limit) { return (limit - within) / (beyond - within); }

/// The longest run that is no deeper than the limit, to the places between two depths where that is reached.
Stretch longest_free(const std::vector<double>& depths, double limit) {
  const std::size_t n = depths.size();
  const auto last = static_cast<double>(n - 1);
  Stretch longest;
  for (std::size_t begin = 0; begin < n;) {
    std::size_t end = begin;
    while (end < n && depths[end] <= limit) ++end;
    if (end > begin + 1) {
      const double before = begin > 0 ? crossing(depths[begin], depths[begin - 1], limit) : 0.0;
      const double after = end < n ? crossing(depths[end - 1], depths[end], limit) : 0.0;
      const double from = (static_cast<double>(begin) - before) / last;
      const double to = (static_cast<double>(end - 1) + after) / last;
      if (to - from > longest.to - longest.from) longest = {from, to};
    }
    begin = end + 1;
  }
  return longest;
}

/// Less than this of the axis or of the path is not the same fit any more.
constexpr double kLeastLeft = 1.0 / 3.0;

/// The motion from one time to another, of the axis' part that begins at `from_s` and is `length` long.
RuledMotion part_of(const RuledMotion& motion, const Stretch& times, double from_s, double length) {
  constexpr int kPerControlPoint = 8;  // poses, as stages.cpp has them
  std::vector<Pose> poses;
  std::vector<double> t;
  const int samples = kPerControlPoint * motion.tip.count();
  for (int i = 0; i <= samples; ++i) {
    t.push_back(static_cast<double>(i) / samples);
    const Pose pose = motion.pose(times.from + (times.to - times.from) * t.back());
    poses.push_back({pose.at(from_s), pose.axis});
  }
  return fit_motion(poses, t, length, motion.tip.count());
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

struct Way {
  std::string name;
  Polished polished;
};

void code(StepCodec& codec, Way& way) {
  codec.text(way.name);
  code(codec, way.polished);
}

}  // namespace

double least_to_win(const CoverageEstimate& rival, const FlankFitOptions& options) {
  constexpr double kLastPassesGain = 0.1;  // of the face: they rarely gain more
  const double behind = is_clean(rival, options.tolerance_mm) ? rival.at_tolerance - kLastPassesGain : 0.0;
  return std::max(options.least_coverage_for_last_passes, behind);
}

bool cannot_win(const CoverageEstimate& way, const CoverageEstimate& rival, const FlankFitOptions& options) {
  constexpr double kLastLookGain = 0.01;  // of the face: it mends what is too deep, and hardly covers more
  if (!is_clean(rival, options.tolerance_mm) || !is_steady(rival)) return false;
  if (way.at_tolerance + kLastLookGain < rival.at_tolerance) return true;
  const bool too_deep = std::max(way.overcut_mm, way.gouge_mm) > kMendable * options.tolerance_mm;
  return too_deep && is_better(rival, way, options);
}

std::optional<FitDraft> shortened_axis(const FitDraft& draft, double depth_mm) {
  if (!draft.free_tool) return std::nullopt;
  std::vector<double> deepest(kPlaces, kFree);
  for (std::size_t m = 0; m < draft.motions.size(); ++m) {
    const Depths depths = depths_of(draft, m);
    for (std::size_t j = 0; j < kPlaces; ++j) deepest[j] = std::max(deepest[j], depths.along[j]);
  }
  const Stretch free = longest_free(deepest, depth_mm);
  const double share = free.to - free.from, length = draft.tool.axis_length();
  if (share >= 1.0 || share < kLeastLeft) return std::nullopt;
  FitDraft part = draft;
  part.tool = part_of(draft.tool, free.from * length, share * length);
  for (RuledMotion& motion : part.motions) motion = part_of(motion, {0.0, 1.0}, free.from * length, share * length);
  return part;
}

std::optional<FitDraft> shortened_path(const FitDraft& draft, double depth_mm) {
  FitDraft part = draft;
  bool any = false;
  for (std::size_t m = 0; m < draft.motions.size(); ++m) {
    const Stretch free = longest_free(depths_of(draft, m).over, depth_mm);
    if (free.to - free.from < kLeastLeft) return std::nullopt;
    if (free.to - free.from >= 1.0) continue;
    part.motions[m] = part_of(draft.motions[m], free, 0.0, draft.motions[m].axis_length);
    any = true;
  }
  return any ? std::optional(part) : std::nullopt;
}

namespace {

/// Whether a way covers too little to be looked at closely, or to win.
bool is_beaten(const Way& way, const CoverageEstimate& rival, const FlankFitOptions& options) {
  return way.polished.estimate.at_tolerance < options.least_coverage_for_close_look ||
         cannot_win(way.polished.estimate, rival, options);
}

/// The last look at the ways, the most promising ones first. It costs as much as a fit, so that a way that is beaten by the rival, or by one
/// that has been looked at, goes without it.
void settle_in_turn(std::vector<Way>& ways, CoverageEstimate rival, const FlankFitOptions& options) {
  std::vector<Way*> turn;
  for (Way& way : ways) turn.push_back(&way);
  std::stable_sort(turn.begin(), turn.end(), [&](const Way* a, const Way* b) {
    return is_better(a->polished.estimate, b->polished.estimate, options);
  });
  for (Way* way : turn) {
    if (is_beaten(*way, rival, options)) continue;
    way->polished = repair_closely(way->polished, options);
    if (is_better(way->polished.estimate, rival, options)) rival = way->polished.estimate;
  }
}

/// Whether passes may lead a draft out of what it enters: not where its axis itself is in there, because the points on both
/// sides of it push against each other.
bool can_be_led_out(const Polished& polished) { return polished.estimate.gouge_mm < polished.draft.tool.largest(); }

/// The draft as it was found without the other faces, and, if it enters them, what can be made of it that can win against
/// the rival.
std::vector<Way> ways_from(const FitDraft& draft, bool fixed_length, const CoverageEstimate& rival,
                           const FlankFitOptions& options, const Progress& progress) {
  const std::vector<SurfaceSample> samples = ranking_samples(*draft.targets.front(), options.obstacles, options);
  const double tolerance = options.tolerance_mm, depth = kToleranceBudget.others.last_look * tolerance;
  std::vector<Way> ways;
  ways.push_back({"planned without the neighbouring faces", assess(draft, samples, options)});
  if (!is_clean(ways.front().polished.estimate, tolerance) && !progress.stop()) {
    std::optional<FitDraft> shorter = fixed_length ? std::nullopt : shortened_axis(draft, depth);
    if (shorter)
      ways.push_back({"planned without the neighbouring faces, then shortened along the axis",
                      assess(*shorter, samples, options)});
    shorter = shortened_path(draft, depth);
    if (shorter)
      ways.push_back({"planned without the neighbouring faces, then shortened along the path",
                      assess(*shorter, samples, options)});
    const Way start = *std::min_element(ways.begin(), ways.end(), [&](const Way& a, const Way& b) {
      return is_better(a.polished.estimate, b.polished.estimate, options);
    });
    if (can_be_led_out(start.polished)) {
      Polished clear = first_passes(start.polished, samples, options, nullptr);
      if (clear.estimate.at_tolerance >= least_to_win(rival, options))
        clear = without_overcut(last_passes(clear, samples, options, nullptr, nullptr, true), samples, options);
      ways.push_back({start.name, std::move(clear)});
    }
  }
  settle_in_turn(ways, rival, options);
  return ways;
}

/// What forbids more, with the figures; nothing if the result covers nearly what can be covered without other faces.
void note_limits(const CoverageEstimate& free, double tolerance_mm, FlankFitResult& result) {
  constexpr double kMore = 0.01;  // of the face: less is not worth a sentence
  const CoverageEstimate& found = result.after;
  if (found.gouge_mm > tolerance_mm) {
    result.notes.push_back(
        fmt::format("no motion found finishes as much without gouging other faces: this one finishes {:.1f} % "
                    "(estimate) and gouges them by {:.3g} mm",
                    100.0 * found.at_tolerance, found.gouge_mm));
  } else if (free.at_tolerance > found.at_tolerance + kMore && free.gouge_mm > tolerance_mm) {
    result.notes.push_back(
        fmt::format("neighbouring faces limit the finished area: a motion that ignores them finishes {:.1f} % "
                    "(estimate) and gouges them by {:.3g} mm",
                    100.0 * free.at_tolerance, free.gouge_mm));
  }
}

}  // namespace

FlankFitResult best_way(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                        FlankFitResult first, const StartSearch& search, const Progress& progress) {
  FlankFitOptions free_options = options;
  free_options.obstacles = nullptr;
  free_options.finalists = 1;  // a start for what follows, not a result
  free_options.least_coverage_for_last_passes = least_to_win(first.after, options);
  const FlankFitResult free = search(free_options);
  first.unobstructed_search = UnobstructedSearch::kBeaten;
  if (free.motions.empty() || (stopping() && !first.motions.empty())) return first;
  const double tolerance = options.tolerance_mm;
  const bool fixed_length = tool.axis_length || tool.longest_axis || options.axis_length_mm;
  std::vector<Way> ways = journaled(
      progress, "ways",
      [&] {
        return ways_from(draft_of(target, tool, free, options.obstacles), fixed_length, first.after, options, progress);
      },
      free);
  if (ways.empty()) throw InputError("resume.json is damaged: this step holds no candidate; start without --resume");
  for (Way& way : ways) reattach_targets(way.polished.draft, target, options.obstacles);
  const Way* best = nullptr;
  for (const Way& way : ways) {
    const CoverageEstimate& rival = best != nullptr ? best->polished.estimate : first.after;
    if ((best == nullptr && first.motions.empty()) || is_better(way.polished.estimate, rival, options)) best = &way;
  }
  FlankFitResult result = first;
  if (best != nullptr) {
    result.rejected.clear();
    add_rejected(result, first, options.bounds);
    result.before = free.before;
    result.trace = free.trace;
    result.candidates = first.candidates + free.candidates;
    result.notes.push_back(
        fmt::format("the motion was {}: it finishes {:.1f} % (estimate); one planned around them, {:.1f} %", best->name,
                    100.0 * best->polished.estimate.at_tolerance, 100.0 * first.after.at_tolerance));
    result = make_result(best->polished, options, std::move(result));
    result.unobstructed_search = UnobstructedSearch::kBest;
    result.closely_measured = best->polished.estimate.at_tolerance >= options.least_coverage_for_close_look;
  }
  for (const Way& way : ways)
    if (&way != best)
      result.rejected.push_back(rejected_tool(way.polished.draft.tool, way.polished.draft.motions.size(),
                                              way.polished.estimate, options.bounds));
  note_limits(ways.front().polished.estimate, tolerance, result);
  return result;
}

}  // namespace flank::internal
