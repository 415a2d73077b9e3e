/// Names of files, which may hold any bytes, in what people read.
#pragma once

#include <string>
#include <string_view>

namespace flank {

/// The text with every control character, and every byte that is not UTF-8, as \xNN, so that no name of a file can move
/// the cursor or end a line of a terminal. Line ends are control characters unless `lines`.
[[nodiscard]] std::string printable(std::string_view text, bool lines = false);

/// Whether all of the text is UTF-8 (no overlong forms, no surrogates).
[[nodiscard]] bool is_utf8(std::string_view text);

}  // namespace flank
