/// view.json (docs/schema/view.md, schema "openflank/view/1"): what the page of `flank report` draws.
#pragma once

#include <string>

#include "flank/results/view.h"

namespace flank::internal {

[[nodiscard]] std::string view_to_json(const View& view);

}  // namespace flank::internal
