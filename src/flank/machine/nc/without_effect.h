/// Words that move nothing on a machine: its file names them, and programs that hold them are read.
#pragma once

#include <string>
#include <string_view>

#include "flank/machine/nc/dialect.h"

namespace flank::internal {

/// Why a machine's file cannot call this word one without effect: it is known to have one, or it is no word. Empty: it can.
/// Words are M or G with a number ("M10", "G187"), or a name ("PLANE RESET STAY"); "CYCLE800()" is that name without
/// arguments. In upper case.
[[nodiscard]] std::string why_not_without_effect(std::string_view word);

/// Whether the machine's file names a word of a letter and a number.
[[nodiscard]] bool is_without_effect(const NcDialect& dialect, char letter, double value);
/// Whether it names these words; `text` in upper case, without spaces at both ends.
[[nodiscard]] bool is_without_effect(const NcDialect& dialect, std::string_view text);

/// Letters of words that only say more about a G or M word in the same block.
[[nodiscard]] bool is_parameter_letter(char letter);

}  // namespace flank::internal
