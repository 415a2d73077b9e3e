/// Files in one: a ZIP without compression.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flank::internal {

/// CRC-32 of ISO 3309, as ZIP wants it.
[[nodiscard]] std::uint32_t crc32(std::string_view bytes);

/// A ZIP file (PKWARE's APPNOTE, method 0) of names and contents, in this order and without times: the same files give the same bytes.
/// All together must be below 4 GB; throws InputError else.
[[nodiscard]] std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace flank::internal
