/// A ranking of tools as ranking.json (docs/schema/ranking.md) and as a table.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "flank/run.h"

namespace flank::internal {

/// The tools alone: "tools" of ranking.json, "ranking" of summary.json.
[[nodiscard]] nlohmann::ordered_json ranking_entries(const Ranking& ranking);
[[nodiscard]] std::string ranking_to_json(const Ranking& ranking);
/// Lines of a terminal's summary, indented as those are.
[[nodiscard]] std::string ranking_table(const Ranking& ranking);

}  // namespace flank::internal
