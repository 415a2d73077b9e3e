/// A ranking of tools as ranking.json (docs/schema/ranking.md) and as a table.
#pragma once

#include <string>
#include <vector>

#include "flank/choose/tool_ranking.h"

namespace flank::internal {

/// What was ranked, for whom.
struct RankingReport {
  std::string source;              ///< "catalogue FOLDER" or "barrel, searched: axis ..."
  std::vector<std::string> names;  ///< of the tools, by RankedTool::tool
  std::vector<Tool> tools;
  std::vector<RankedTool> ranked;
  RankingOptions options;
};

[[nodiscard]] std::string ranking_to_json(const RankingReport& report);
/// Lines of a terminal's summary, indented as those are.
[[nodiscard]] std::string ranking_table(const RankingReport& report);

}  // namespace flank::internal
