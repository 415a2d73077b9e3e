/// Whole files, as the bytes that they are.
#pragma once

#include <string>
#include <string_view>

namespace flank::internal {

/// The three bytes with which some programs begin a text in UTF-8. They mean nothing.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Without a byte order mark and blanks in front.
[[nodiscard]] std::string_view without_blanks_in_front(std::string_view content);

/// The whole file. Throws InputError for a missing file, a folder, an empty or an unreadable file, and says what would be
/// accepted: "STL (.stl)"; empty: nothing is said.
[[nodiscard]] std::string read_bytes(const std::string& file, std::string_view accepted = {});

}  // namespace flank::internal
