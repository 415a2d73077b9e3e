/// The figures of a program (run.h: post_text, post_json) and the words that others share with them.
#pragma once

#include <string>

namespace flank::internal {

/// "12.3 s", or "4.56 min".
[[nodiscard]] std::string minutes_text(double minutes);

}  // namespace flank::internal
