/// A family with open parameters: the tools of it that suit a surface best (docs/algorithms/catalogue.md).
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flank/choose/family_chart.h"
#include "flank/choose/tool_ranking.h"

namespace flank::internal {

struct FamilySearchOptions {
  RankingOptions ranking;
  std::optional<double> axis_length_mm;  ///< none: the target's width over 1, 2, 3 and 4 strips, all tried
  std::size_t screened = 32;             ///< of the grid, by their meridians: these are asked whether they stand free
  std::size_t tried = 8;                 ///< of these, by what they can cover: these get a quick cover
  std::size_t kept = 3;                  ///< tools that come back
  int rounds = 6;                        ///< of the compass search
  /// Tool of a radial function: shank and holder put on.
  std::function<Tool(const RadialFunction&)> equip;
};

struct FamilySearchResult {
  /// Best first, by quick covers; named as --tool takes them. Where none covers anything, the one that came nearest.
  std::vector<Tool> tools;
  std::string searched;                     ///< "axis 20 mm (given); radius from a tenth of the axis to 13 mm, ..."
  int grid = 0, screened = 0, covered = 0;  ///< tools looked at: by meridian, by obstacles, by a quick cover
};

/// Grid over the chart (meridians only), the best of it screened with all obstacles, the best of those covered quickly;
/// from the best, and from the best of another length, a compass search: one coordinate up or down by a step, which is halved where none is better. What it
/// maximises is ranking_value plus a small term of the screen's mean error, which tells tools apart that cover alike.
/// Deterministic, for any number of threads. Throws UsageError for a family without named sizes (power, spline),
/// and where what is given leaves no legitimate tool.
[[nodiscard]] FamilySearchResult search_family(std::span<const RankingTarget> targets, ToolFamily family,
                                               const std::map<std::string, double>& given,
                                               const FamilySearchOptions& options, const Progress& progress);

}  // namespace flank::internal
