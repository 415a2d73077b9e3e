/// What the judge's stock says of a program: lines for people, JSON for programs (docs/schema/verify.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "flank/judge.h"

namespace flank::internal {

/// What a kind of move (StockKind::kind) is called in messages: "cutting move".
[[nodiscard]] std::string move_words(const std::string& kind);
[[nodiscard]] std::string stock_text(const StockReport& stock);
[[nodiscard]] nlohmann::ordered_json stock_to_json(const StockReport& stock);
/// Throws nlohmann::json::exception for a field that is missing or of the wrong type.
[[nodiscard]] StockReport stock_from_json(const nlohmann::ordered_json& json);

}  // namespace flank::internal
