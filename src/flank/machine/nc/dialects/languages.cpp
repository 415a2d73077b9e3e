#include "flank/machine/nc/dialects/languages.h"

#include <array>

#include "flank/error.h"
#include "flank/machine/nc/dialects/apt.h"
#include "flank/machine/nc/dialects/fanuc.h"
#include "flank/machine/nc/dialects/heidenhain.h"
#include "flank/machine/nc/dialects/linuxcnc.h"
#include "flank/machine/nc/dialects/siemens.h"

namespace flank::internal {

std::span<const NcLanguageRow* const> nc_languages() {
  static constexpr std::array kRows{&kLinuxCncRow, &kFanucRow, &kSiemensRow, &kHeidenhainRow, &kAptRow};
  return kRows;
}

std::vector<std::string> nc_language_names() {
  std::vector<std::string> names;
  for (const NcLanguageRow* row : nc_languages()) names.emplace_back(row->name);
  return names;
}

NcLanguage nc_language(std::string_view name) {
  std::string accepted;
  const auto rows = nc_languages();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k]->name == name) return rows[k]->language;
    accepted += (k == 0 ? "" : k + 1 == rows.size() ? " and " : ", ") + std::string(rows[k]->name);
  }
  throw UsageError("dialect", "\"" + std::string(name) + "\"", "expected " + accepted);
}

void require_rotary_letters(const std::string& letters) {
  const auto is_one = [](char c) { return c == 'A' || c == 'B' || c == 'C'; };
  if (letters.size() != 2 || !is_one(letters[0]) || !is_one(letters[1]) || letters[0] == letters[1])
    throw UsageError("rotary axes", "\"" + letters + "\"", "expected two different letters of A, B and C");
}

}  // namespace flank::internal
