#include "flank/tool_choice/family_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flank/base/journal.h"
#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/threads.h"
#include "flank/tool/radial_record.h"

namespace flank::internal {
namespace {

/// Share of the face's area that the smooth term is worth at most: two strip prices, so it decides between tools that
/// cover alike and hardly against one that covers more.
constexpr double kTieShare = 0.01;
/// Axis lengths that are tried: the width of the face over 1 to so many strips. Shorter tools are always found to fit
/// by a screen, and need ever more strips.
constexpr int kMostStripsAcross = 4;
constexpr std::size_t kStarts = 2;  ///< of the compass search, of different lengths
/// Of the axis: a face that is wider than n axes by less than this still counts as n strips wide. Lengths are rounded
/// to 0.1 mm, and neighbours overlap, so exact multiples would fall on either side by chance.
constexpr double kWidthSlack = 0.1;
constexpr double kLengthStepMm = 0.1;  ///< what axis lengths are rounded to, and the shortest
/// First step of the compass search, in steps of the grid: half of one, as its neighbours in the grid were screened
/// before.
constexpr double kFirstStep = 0.5;
constexpr double kNotTried = -1e300;                                                ///< value below all others
constexpr double kGridTo = 0.02, kScreenTo = 0.05, kTryTo = 0.2, kCompassTo = 0.4;  ///< shares of progress

/// One tool of the search: where it is, and what is known of it.
struct Member {
  std::size_t chart = 0;
  std::vector<double> x;
  std::optional<RadialFunction> radial;
  ToolScreen screen;
  double value = kNotTried;
};

struct Search {
  std::span<const RankingTarget> targets;
  const FamilySearchOptions& options;
  std::vector<ScreenPlaces> places;  ///< of every target
  std::vector<double> share;         ///< of the area
  std::vector<FamilyChart> charts;   ///< one an axis length, of the first target
  std::vector<double> lengths;
  ScreenOptions screen_options;

  [[nodiscard]] Tool tool(const Member& candidate) const {
    Tool tool = options.equip ? options.equip(*candidate.radial) : Tool{*candidate.radial, "", {}, {}};
    tool.name = family_text(*candidate.radial);
    return tool;
  }
  /// Covered share minus the price of as many strips as lie side by side across the target.
  [[nodiscard]] double estimate(const Member& candidate) const {
    const double across = std::ceil(places.front().width_mm / candidate.radial->axis_length() - kWidthSlack);
    return candidate.screen.open - options.ranking.cover.strip_price * across + tie(candidate.screen);
  }
  /// In (0, kTieShare], falling with the screen's mean error; half of it where the error is what the filter allows.
  [[nodiscard]] double tie(const ToolScreen& screen) const {
    const double slack = screen_options.slack * screen_options.tolerance_mm;
    return kTieShare * slack / (slack + screen.mean_error_mm);
  }
};

/// All targets added up by area. screen(target).
template <class Screen>
ToolScreen screen_all(const Search& search, const Screen& screen) {
  ToolScreen sum;
  sum.mean_error_mm = 0.0;
  for (std::size_t k = 0; k < search.places.size(); ++k) {
    const ToolScreen part = screen(k);
    sum.open += search.share[k] * part.open;
    sum.mean_error_mm += search.share[k] * part.mean_error_mm;
    if (sum.reason.empty()) sum.reason = part.reason;
  }
  if (sum.open > 0.0) sum.reason.clear();
  return sum;
}

/// All legitimate tools at the levels of all coordinates of all charts: counts up in mixed radix, the first coordinate
/// fastest.
std::vector<Member> grid_of(const Search& search) {
  std::vector<Member> grid;
  for (std::size_t c = 0; c < search.charts.size(); ++c) {
    const FamilyChart& chart = search.charts[c];
    const std::size_t n = chart.coordinates().size();
    std::vector<int> index(n, 0);
    for (bool more = true; more;) {
      Member candidate{c, std::vector<double>(n), {}, {}};
      for (std::size_t k = 0; k < n; ++k) candidate.x[k] = double(index[k]) / (chart.levels(k) - 1);
      candidate.radial = chart.at(candidate.x);
      if (candidate.radial) grid.push_back(std::move(candidate));
      more = false;
      for (std::size_t k = 0; k < n && !more; ++k) {
        more = ++index[k] < chart.levels(k);
        if (!more) index[k] = 0;
      }
    }
  }
  return grid;
}

/// Stable, so equal values stay in the order of the grid whatever the number of threads.
void keep_best(std::vector<Member>& candidates, std::size_t count) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Member& a, const Member& b) { return a.value > b.value; });
  if (candidates.size() > count)
    candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(count), candidates.end());
}

/// The same with as many of every chart: screens favour short tools, strips do not.
void keep_best_of_each(const Search& search, std::vector<Member>& candidates, std::size_t count) {
  std::vector<Member> kept;
  for (std::size_t c = 0; c < search.charts.size(); ++c) {
    std::vector<Member> of_chart;
    for (const Member& candidate : candidates)
      if (candidate.chart == c) of_chart.push_back(candidate);
    keep_best(of_chart, std::max<std::size_t>(1, count / search.charts.size()));
    kept.insert(kept.end(), of_chart.begin(), of_chart.end());
  }
  candidates = std::move(kept);
  keep_best(candidates, candidates.size());
}

/// The best, no two of them nearly the same.
std::vector<Tool> best_tools(const Search& search, std::vector<Member> candidates, std::size_t count) {
  /// In every coordinate: about half of the first step of the compass along the curvature, 1/16. Finalists that are all
  /// the same tool would waste the full covers.
  constexpr double kAlike = 0.03;
  keep_best(candidates, candidates.size());
  std::vector<const Member*> kept;
  for (const Member& candidate : candidates) {
    const auto alike = [&](const Member* other) {
      if (other->chart != candidate.chart) return false;
      for (std::size_t k = 0; k < candidate.x.size(); ++k)
        if (std::abs(other->x[k] - candidate.x[k]) > kAlike) return false;
      return true;
    };
    if (kept.size() == count || candidate.value == kNotTried || std::any_of(kept.begin(), kept.end(), alike)) continue;
    kept.push_back(&candidate);
  }
  std::vector<Tool> tools;
  for (const Member* candidate : kept) tools.push_back(search.tool(*candidate));
  return tools;
}

void screen_free(const Search& search, Member& candidate) {
  const Tool tool = search.tool(candidate);
  candidate.screen = screen_all(search, [&](std::size_t k) {
    return screen_tool(search.places[k], tool, *search.targets[k].obstacles, search.screen_options);
  });
  // A tool that cannot work is below all that may, but in the order of how near it came.
  candidate.value = candidate.screen.reason.empty() ? search.estimate(candidate) : candidate.screen.open - 1.0;
}

/// In batches of as many as there are threads; what is cancelled keeps a value below all others.
void cover_quickly(const Search& search, std::vector<Member>& candidates, std::string_view stage, double from,
                   double to, const Progress& progress) {
  const Progress quiet{{}, progress.cancelled};
  const auto batch = static_cast<std::size_t>(thread_count());
  for (std::size_t first = 0; first < candidates.size(); first += batch) {
    progress.step(stage, from + (to - from) * double(first) / double(candidates.size()));
    const std::size_t count = std::min(batch, candidates.size() - first);
    const auto value_of = [&](std::size_t k) {
      const Member& candidate = candidates[first + k];
      if (progress.stop() || !candidate.screen.reason.empty()) return kNotTried;
      const RankedTool covered =
          cover_stage(search.targets, search.tool(candidate), RankingStage::kQuick, search.options.ranking, quiet);
      return covered.strips > 0 ? ranking_value(covered, search.options.ranking) + search.tie(candidate.screen)
                                : kNotTried;
    };
    const std::vector<double> values = journaled_for(progress, "quick cover of a tool", count, value_of,
                                                     [&](std::size_t k) { return *candidates[first + k].radial; });
    for (std::size_t k = 0; k < count; ++k) candidates[first + k].value = values[k];
  }
}

/// Neighbours of the best along every coordinate.
std::vector<Member> neighbours(const Search& search, const Member& best, const std::vector<double>& step) {
  std::vector<Member> around;
  for (std::size_t k = 0; k < best.x.size(); ++k) {
    for (const double sign : {-1.0, 1.0}) {
      Member next{best.chart, best.x, {}, {}};
      next.x[k] = std::clamp(best.x[k] + sign * step[k], 0.0, 1.0);
      if (next.x[k] == best.x[k]) continue;
      next.radial = search.charts[best.chart].at(next.x);
      if (next.radial) around.push_back(std::move(next));
    }
  }
  return around;
}

/// From one tool, in the share [first, last] of the compass' progress. All tools that it covers join `tried`.
void compass(const Search& search, Member best, double first, double last, std::vector<Member>& tried,
             const Progress& progress) {
  std::vector<double> step;
  for (std::size_t k = 0; k < best.x.size(); ++k)
    step.push_back(kFirstStep / (search.charts[best.chart].levels(k) - 1));
  for (int round = 0; round < search.options.rounds && !progress.stop(); ++round) {
    std::vector<Member> around = neighbours(search, best, step);
    parallel_for(around.size(), [&](std::size_t k) { screen_free(search, around[k]); });
    const auto share = [&](int done) {
      return kTryTo + (kCompassTo - kTryTo) * (first + (last - first) * done / search.options.rounds);
    };
    cover_quickly(search, around, "refine the tool", share(round), share(round + 1), progress);
    tried.insert(tried.end(), around.begin(), around.end());
    const auto top = std::max_element(around.begin(), around.end(),
                                      [](const Member& a, const Member& b) { return a.value < b.value; });
    if (top != around.end() && top->value > best.value)
      best = *top;
    else
      for (double& s : step) s *= 0.5;
  }
}

/// A compass search from the best, and from the best of another length: which length wins shows only when both are
/// refined.
void refine(const Search& search, std::vector<Member>& tried, const Progress& progress) {
  std::vector<Member> starts;
  for (const Member& candidate : tried) {
    const bool other_length = starts.empty() || candidate.chart != starts.front().chart;
    if (candidate.value > kNotTried && other_length && starts.size() < kStarts) starts.push_back(candidate);
  }
  for (std::size_t k = 0; k < starts.size(); ++k)
    compass(search, starts[k], double(k) / kStarts, double(k + 1) / kStarts, tried, progress);
}

Search prepare(std::span<const RankingTarget> targets, ToolFamily family, const std::map<std::string, double>& given,
               const FamilySearchOptions& options) {
  Search search{targets, options, {}, {}, {}, {}, {options.ranking.cover.tolerance_mm}};
  double area = 0.0;
  for (const RankingTarget& one : targets) {
    search.places.push_back(screen_places(*one.target, options.ranking.screen_places));
    search.share.push_back(one.target->area());
    area += search.share.back();
  }
  for (double& share : search.share) share /= area;
  const double width = search.places.front().width_mm * (1.0 + options.ranking.cover.overlap_share);
  for (int n = 1; n <= (options.axis_length_mm ? 1 : kMostStripsAcross); ++n) {
    const double over_n = std::round(10.0 * width / n) / 10.0;  // tenths of a millimetre, exact as decimals
    search.lengths.push_back(options.axis_length_mm.value_or(std::max(kLengthStepMm, over_n)));
    search.charts.emplace_back(family, given, search.lengths.back(), search.places.front(),
                               search.screen_options.tolerance_mm);
  }
  return search;
}

std::string searched_text(const Search& search) {
  const std::string lengths =
      search.options.axis_length_mm
          ? fmt::format("{:.4g} mm (given)", search.lengths.front())
          : fmt::format("{:.4g} mm (the face is {:.3g} mm wide: 1 to {} passes)", fmt::join(search.lengths, ", "),
                        search.places.front().width_mm, search.lengths.size());
  return fmt::format("axis {}; {}", lengths, search.charts.front().text());
}

}  // namespace

FamilySearchResult search_family(std::span<const RankingTarget> targets, ToolFamily family,
                                 const std::map<std::string, double>& given, const FamilySearchOptions& options,
                                 const Progress& progress) {
  if (family == ToolFamily::kPower || family == ToolFamily::kSpline)
    throw UsageError("tool", std::string(family_name(family)),
                     "this family cannot be searched; give all parameters, or use another family");
  progress.step("grid of tools", 0.0);
  const Search search = prepare(targets, family, given, options);
  FamilySearchResult result;
  result.searched = searched_text(search);
  std::vector<Member> candidates = grid_of(search);
  result.grid = static_cast<int>(candidates.size());
  parallel_for(candidates.size(), [&](std::size_t i) {
    candidates[i].screen = screen_all(search, [&](std::size_t k) {
      return screen_meridian(search.places[k], *candidates[i].radial, search.screen_options);
    });
    candidates[i].value = search.estimate(candidates[i]);
  });
  keep_best_of_each(search, candidates, options.screened);
  progress.step("screen tools", kGridTo);
  parallel_for(candidates.size(), [&](std::size_t k) { screen_free(search, candidates[k]); });
  result.screened = static_cast<int>(candidates.size());
  keep_best_of_each(search, candidates, options.tried);
  if (candidates.empty())
    throw UsageError("tool", std::string(family_name(family)), "none of these is a valid tool: " + result.searched);
  // If nothing covers anything, the user still gets a tool to look at, with the reason why it does not.
  const Tool nearest = search.tool(candidates.front());
  cover_quickly(search, candidates, "try tools", kScreenTo, kTryTo, progress);
  keep_best(candidates, options.tried);
  refine(search, candidates, progress);
  result.covered = static_cast<int>(candidates.size());
  result.tools = best_tools(search, std::move(candidates), options.kept);
  if (result.tools.empty()) result.tools.push_back(nearest);
  return result;
}

}  // namespace flank::internal
