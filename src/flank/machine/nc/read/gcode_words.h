/// Blocks of letters and numbers, as LinuxCNC and Fanuc have them.
#pragma once

#include <string_view>
#include <vector>

#include "flank/machine/nc/dialect.h"
#include "flank/machine/nc/read/nc_lines.h"

namespace flank::internal {

struct GWord {
  char letter = 0;  ///< upper case
  double value = 0.0;
  bool point = false;     ///< whether the number has a decimal point
  std::string_view text;  ///< as it stands, for messages

  /// Ten times the value of a G or M word, which has at most one decimal: 434 of G43.4; -1 if it has more.
  [[nodiscard]] int code() const;
  /// The value as a whole number from 0 to 99999999; -1 if it is none.
  [[nodiscard]] int whole() const;
};

/// One line taken apart. Views point into the line.
struct GBlock {
  std::vector<GWord> words;
  std::vector<std::string_view> comments;
  bool percent = false;  ///< the line is a %
  bool skipped = false;  ///< it begins with /: the control leaves it out where its operator says so

  [[nodiscard]] const GWord* find(char letter) const;
  [[nodiscard]] bool has_code(char letter, int code) const;
};

/// Takes the line apart (`upper` is the same in upper case): comments in parentheses, and after a semicolon.
/// Refuses what is no letter with a number: parameters, expressions, o words.
void split_gcode(std::string_view line, std::string_view upper, const NcPlace& place, GBlock& block);

/// Refuses a block that may be left out, unless it says the same with and without it: numbers of blocks, stops, coolant, and what
/// the machine's file calls without effect.
void require_same_if_skipped(const GBlock& block, const NcDialect& dialect, const NcPlace& place);
/// Whether a block of these words is there: a word that switches tool-centre control, as "M428" or "G12.1 P1".
[[nodiscard]] bool has_words(const GBlock& block, const std::vector<GWord>& words);

/// The letters of axes: X Y Z, and A B C.
[[nodiscard]] inline bool is_linear(char letter) { return letter >= 'X' && letter <= 'Z'; }
[[nodiscard]] inline bool is_rotary(char letter) { return letter >= 'A' && letter <= 'C'; }

}  // namespace flank::internal
