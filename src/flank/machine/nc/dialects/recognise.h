/// Which language a program is written in.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "flank/machine/nc/dialect.h"

namespace flank::internal {

/// What gave a program away.
struct NcMark {
  NcLanguage language = NcLanguage::kLinuxCnc;
  int line = 0;
  std::string word;
};

/// How many lines are looked at.
inline constexpr int kRecognisedLines = 300;

/// The language by the first word that no other has, in the first kRecognisedLines lines; plain G-code without such a
/// word is LinuxCNC's. Nothing if there is nothing of the kind.
[[nodiscard]] std::optional<NcMark> recognised_language(std::string_view text);

}  // namespace flank::internal
