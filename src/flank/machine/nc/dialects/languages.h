/// The languages of NC programs, a row each.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flank/machine/nc/dialects/language_row.h"

namespace flank::internal {

/// In the order of NcLanguage.
[[nodiscard]] std::span<const NcLanguageRow* const> nc_languages();
[[nodiscard]] inline const NcLanguageRow& row_of(NcLanguage language) {
  return *nc_languages()[static_cast<std::size_t>(language)];
}

/// "linuxcnc", "fanuc" and so on: the names in machine files.
[[nodiscard]] std::vector<std::string> nc_language_names();
[[nodiscard]] inline std::string_view nc_language_name(NcLanguage language) { return row_of(language).name; }
/// The other way round. Throws UsageError with the accepted names.
[[nodiscard]] NcLanguage nc_language(std::string_view name);

/// Letters of two rotary axes, "AC": readers and writers index by them. They come from a machine's file or from a caller. Throws
/// UsageError for what is none.
void require_rotary_letters(const std::string& letters);

}  // namespace flank::internal
