/// A language of NC programs as one row: how it is read and written, what gives it away, what it cannot say.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flank/machine/nc/dialect.h"

namespace flank::internal {

/// Up to nine words that give a program away; those that are not there are empty.
using NcMarkWords = std::array<std::string_view, 9>;

struct NcLanguageRow {
  NcLanguage language = NcLanguage::kLinuxCnc;
  std::string_view name{};   ///< of machine files: "linuxcnc"
  std::string_view title{};  ///< for messages: "LinuxCNC"
  /// The operations of a program; one, or more of ours.
  std::vector<NcProgram> (*read)(std::string_view text, const std::string& file, const NcDialect& dialect) = nullptr;
  std::string (*write)(std::span<const NcProgram> operations, const NcDialect& dialect) = nullptr;

  // Words that decide: no other language has them where they are looked for. Comments are taken off before, since a part's name
  // may hold anything.
  bool (*is_first)(std::string_view code) = nullptr;  ///< of a whole line behind its number
  NcMarkWords first{};                                ///< at the beginning of a line, behind its number
  NcMarkWords anywhere{};                             ///< anywhere in a line
  NcMarkWords plain{};                                ///< anywhere, where nothing better is found
  std::string_view always_has{};  ///< what a program without any mark lacks, for messages; empty: nothing

  // What the control cannot say is refused with the machine's file, rather than when the first program is written.
  bool great_circle = true, vectors = true, inverse_time = true;
  bool retract_word =
      true;  ///< a word for where the tool is out of the way; else the machine's file, or its travel, says it
};

}  // namespace flank::internal
