#include "flank/tool_choice/tool_ranking.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "flank/base/journal.h"
#include "flank/base/parallel.h"
#include "flank/cover/cover_record.h"
#include "flank/error.h"
#include "flank/strip/strip_order.h"
#include "flank/threads.h"
#include "flank/tool/radial_record.h"

namespace flank::internal {
namespace {

/// Shares of the ranking's progress at which its rounds begin, rough guesses at their times. Shown only.
constexpr double kQuickFrom = 0.05, kThoroughFrom = 0.2, kFullFrom = 0.4, kFullTo = 0.9;
/// Share of the area: steps of the worth if strips are free. Covers differ by this much through their samples alone.
constexpr double kLeastWorthStep = 1e-3;
/// Chords of a strip's length. They are too short by their share of (turn)^2 / 24, nothing beside the feeds that are
/// assumed.
constexpr int kLengthChords = 200;
/// After the quick round this share of the tools goes on (1 / kHalving), but never fewer than this many times the
/// finalists: a quick cover may be wrong about the order of tools that are close (decision 0011).
constexpr std::size_t kHalving = 2, kLeastPerFinalist = 2;

/// mm^2 over all targets.
double total_area(std::span<const RankingTarget> targets) {
  double area = 0.0;
  for (const RankingTarget& one : targets) area += one.target->area();
  return area;
}

/// Places of every target.
using AllPlaces = std::vector<ScreenPlaces>;

AllPlaces all_places(std::span<const RankingTarget> targets, const RankingOptions& options) {
  AllPlaces all;
  for (const RankingTarget& one : targets) all.push_back(screen_places(*one.target, options.screen_places));
  return all;
}

void add_share(ToolScreen& sum, const ToolScreen& part, double share) {
  sum.reachable += share * part.reachable;
  sum.fits += share * part.fits;
  sum.accepted += share * part.accepted;
  sum.open += share * part.open;
}

/// All targets added up by area. A tool that works on one target may be used there.
RankedTool screened(std::span<const RankingTarget> targets, const AllPlaces& places, const Tool& tool,
                    const RankingOptions& options) {
  RankedTool ranked;
  ToolScreen& sum = ranked.screen;
  sum.mean_error_mm = 0.0;
  const ScreenOptions screen_options{options.cover.tolerance_mm};
  const double area = total_area(targets);
  bool works = false;
  for (std::size_t k = 0; k < targets.size(); ++k) {
    const ToolScreen one = screen_tool(places[k], tool, *targets[k].obstacles, screen_options);
    // By area: a small target that a tool cannot machine must not outweigh a large one that it can.
    const double share = targets[k].target->area() / area;
    add_share(sum, one, share);
    sum.least_error_mm = std::min(sum.least_error_mm, one.least_error_mm);
    sum.mean_error_mm += share * std::min(one.mean_error_mm, kMostErrorMm);
    works = works || one.reason.empty();
    if (ranked.reason.empty()) ranked.reason = one.reason;
  }
  if (works) ranked.reason.clear();
  sum.reason = ranked.reason;
  return ranked;
}

/// What is saved in a stage: seeds in the quick one, smoothing in all but the last.
CoverOptions options_of(RankingStage stage, const RankingOptions& options) {
  CoverOptions out = options.cover;
  out.smooth = stage == RankingStage::kFull && options.cover.smooth;
  if (stage == RankingStage::kQuick) {
    out.seed_places = std::min(out.seed_places, options.quick_places);
    out.seed_directions = std::min(out.seed_directions, options.quick_directions);
  }
  return out;
}

/// Adds the covers of all targets up to one set of figures.
void measure(std::span<const RankingTarget> targets, const RankingOptions& options, RankedTool& ranked) {
  const double area = total_area(targets);
  double covered = 0.0;
  for (std::size_t k = 0; k < targets.size(); ++k) {
    const CoverResult& result = ranked.results[k];
    const double share = targets[k].target->area() / area;
    ranked.reachable += share * result.reachable;
    // A cover's own coverage is of its reachable part: shares of the whole are what can be added.
    covered += share * result.reachable * result.coverage;
    ranked.strips += static_cast<int>(result.motions.size());
    for (const RuledMotion& motion : result.motions) ranked.strips_mm += strip_length(motion);
    ranked.links_mm += link_length(result.motions);
    if (ranked.reason.empty()) ranked.reason = result.message;
  }
  ranked.coverage = ranked.reachable > 0.0 ? covered / ranked.reachable : 0.0;
  ranked.minutes = ranked.strips_mm / options.rates.feed_mm_min + ranked.links_mm / options.rates.rapid_mm_min;
  // A tool that machines one of several targets has worked; the reason was the other one's.
  if (ranked.strips > 0) ranked.reason.clear();
}

/// Hands the indices of `which` to `body`, as many at a time as there are threads: progress and cancelling come between
/// the batches, while one loop over all would show nothing for minutes.
template <class Body>
void for_batches(const std::vector<std::size_t>& which, std::string_view stage, double from, double to,
                 const Progress& progress, const Body& body) {
  const auto batch = static_cast<std::size_t>(thread_count());
  for (std::size_t first = 0; first < which.size() && !progress.stop(); first += batch) {
    const double done = static_cast<double>(first) / static_cast<double>(which.size());
    progress.step(stage, from + (to - from) * done);
    body(std::span(which).subspan(first, std::min(batch, which.size() - first)));
  }
}

/// Less is better.
struct RankingKey {
  int stage;  ///< negative: what came farther is less; 1: covers nothing; 2: cannot work
  double worth;
  double minutes;
  std::size_t tool;
  auto operator<=>(const RankingKey&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 misreads it
};

RankingKey key_of(const RankedTool& ranked, const RankingOptions& options) {
  if (ranked.strips == 0) return {ranked.reason.empty() ? 1 : 2, -ranked.screen.accepted, 0.0, ranked.tool};
  // Worth in whole steps: below one step the time decides, and not the samples' scatter.
  const double step = std::max(options.cover.strip_price, kLeastWorthStep);
  return {-static_cast<int>(ranked.stage), -std::round(ranking_value(ranked, options) / step), ranked.minutes,
          ranked.tool};
}

/// Those of `alive` that come first and cover something, at most `count`.
std::vector<std::size_t> best_of(const std::vector<RankedTool>& ranked, std::vector<std::size_t> alive,
                                 std::size_t count, const RankingOptions& options) {
  std::erase_if(alive, [&](std::size_t k) { return ranked[k].strips == 0; });
  std::sort(alive.begin(), alive.end(),
            [&](std::size_t a, std::size_t b) { return key_of(ranked[a], options) < key_of(ranked[b], options); });
  alive.resize(std::min(alive.size(), count));
  return alive;
}

}  // namespace

void code(StepCodec& codec, RankedTool& ranked) {
  code_choice(codec, ranked.stage, 4);
  code(codec, ranked.results);
  for (double* value : {&ranked.reachable, &ranked.coverage, &ranked.strips_mm, &ranked.links_mm, &ranked.minutes})
    codec.number(*value);
  code(codec, ranked.strips);
  codec.text(ranked.reason);
}

double strip_length(const RuledMotion& motion) {
  double sum = 0.0;
  Pose last = motion.pose(0.0);
  for (int i = 1; i <= kLengthChords; ++i) {
    const Pose pose = motion.pose(static_cast<double>(i) / kLengthChords);
    sum += 0.5 * ((pose.tip - last.tip).norm() + (pose.at(motion.axis_length) - last.at(motion.axis_length)).norm());
    last = pose;
  }
  return sum;
}

double ranking_value(const RankedTool& ranked, const RankingOptions& options) {
  return ranked.covered() - options.cover.strip_price * ranked.strips;
}

RankedTool cover_stage(std::span<const RankingTarget> targets, const Tool& tool, RankingStage stage,
                       const RankingOptions& options, const Progress& progress) {
  RankedTool ranked;
  ranked.stage = stage;
  const CoverOptions cover_options = options_of(stage, options);
  for (const RankingTarget& one : targets)
    ranked.results.push_back(options.cover_with(*one.target, tool, *one.obstacles, cover_options, progress));
  measure(targets, options, ranked);
  return ranked;
}

std::vector<RankedTool> rank_tools(std::span<const RankingTarget> targets, std::span<const Tool> tools,
                                   const RankingOptions& options, const Progress& progress) {
  std::vector<RankedTool> ranked(tools.size());
  std::vector<std::size_t> alive(tools.size());
  std::iota(alive.begin(), alive.end(), std::size_t{0});
  for (const std::size_t k : alive) ranked[k].tool = k;
  const AllPlaces places = all_places(targets, options);
  for_batches(alive, "screen tools", 0.0, kQuickFrom, progress, [&](std::span<const std::size_t> some) {
    parallel_for(some.size(), [&](std::size_t i) {
      ranked[some[i]] = screened(targets, places, tools[some[i]], options);
      ranked[some[i]].tool = some[i];
    });
  });
  // Several covers at a time have no one line of progress; they can be cancelled.
  const Progress quiet{{}, progress.cancelled};
  const auto advance = [&](RankingStage stage, std::string_view name, double from, double to) {
    for_batches(alive, name, from, to, progress, [&](std::span<const std::size_t> some) {
      std::vector<RankedTool> covered = journaled_for(
          progress, "cover of a tool", some.size(),
          [&](std::size_t i) { return cover_stage(targets, tools[some[i]], stage, options, quiet); },
          [&](std::size_t i) { return tools[some[i]]; });
      for (std::size_t i = 0; i < some.size(); ++i) {
        // A cover that was cancelled says less than the stage before it.
        if (progress.stop()) return;
        if (covered[i].results.size() != targets.size())
          throw InputError("resume.json does not fit this run; start without --resume: a step belongs to other faces");
        const std::size_t k = some[i];
        covered[i].tool = k;
        covered[i].screen = ranked[k].screen;
        ranked[k] = std::move(covered[i]);
      }
    });
  };
  std::erase_if(alive, [&](std::size_t k) { return !ranked[k].reason.empty(); });
  // With no more tools than finalists there is nothing to sort out: they go to the full cover at once.
  const auto finalists = static_cast<std::size_t>(options.finalists);
  if (alive.size() > finalists) {
    advance(RankingStage::kQuick, "try tools", kQuickFrom, kThoroughFrom);
    const std::size_t half = (alive.size() + kHalving - 1) / kHalving;
    alive = best_of(ranked, alive, std::max(kLeastPerFinalist * finalists, half), options);
    advance(RankingStage::kThorough, "try the better half", kThoroughFrom, kFullFrom);
    alive = best_of(ranked, alive, finalists, options);
  }
  advance(RankingStage::kFull, "cover with the best", kFullFrom, kFullTo);
  std::sort(ranked.begin(), ranked.end(),
            [&](const RankedTool& a, const RankedTool& b) { return key_of(a, options) < key_of(b, options); });
  return ranked;
}

}  // namespace flank::internal
