/// SHA-256 (FIPS 180-4), to tell whether bytes are those that they were. Not for secrets.
#pragma once

#include <string>
#include <string_view>

namespace flank::internal {

/// 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace flank::internal
