/// A family with open parameters: the tools of it that suit a surface best (docs/algorithms/catalogue.md).
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flank/tool_choice/family_chart.h"
#include "flank/tool_choice/tool_ranking.h"

namespace flank::internal {

struct FamilySearchOptions {
  RankingOptions ranking;  ///< of the quick covers; its cover options hold the tolerance and the strip price
  std::optional<double> axis_length_mm;  ///< > 0; none: the target's width over 1, 2, 3 and 4 strips, all tried
  /// Tools of the grid that are screened among the obstacles, best meridians first, >= 1; at least one of each axis
  /// length. Milliseconds to a second each. More helps if obstacles leave little room.
  std::size_t screened = 32;
  /// Of these, those that get a quick cover, >= 1; at least one of each axis length. Seconds each.
  std::size_t tried = 8;
  std::size_t kept = 3;  ///< tools that come back, >= 1: finalists of the ranking that follows
  /// Of the compass search, >= 0, from either start: each covers up to two tools per coordinate. A step is halved at
  /// most so often, so six refine the grid by up to 64.
  int rounds = 6;
  /// Tool of a radial function, with shank and holder. None: the flank alone.
  std::function<Tool(const RadialFunction&)> equip;
};

struct FamilySearchResult {
  /// Best first, by quick covers; named as --tool takes them. Where none covers anything, the one that came nearest.
  std::vector<Tool> tools;
  std::string searched;  ///< "axis 20 mm (given); radius from a tenth of the axis length to 13 mm, ..."
  int grid = 0, screened = 0, covered = 0;  ///< tools measured: by meridian, among obstacles, by a quick cover
};

/// Grid over the chart (meridians only), the best of it screened with all obstacles, the best of those covered quickly;
/// from the best, and from the best of another length, a compass search: one coordinate up or down by a step, which is
/// halved if none is better. What it maximises is ranking_value plus a small term of the screen's mean error, which
/// tells tools apart that cover alike. Deterministic, for any number of threads. Throws UsageError for a family without
/// named sizes (power, spline), and if what is given leaves no legitimate tool.
[[nodiscard]] FamilySearchResult search_family(std::span<const RankingTarget> targets, ToolFamily family,
                                               const std::map<std::string, double>& given,
                                               const FamilySearchOptions& options, const Progress& progress);

}  // namespace flank::internal
