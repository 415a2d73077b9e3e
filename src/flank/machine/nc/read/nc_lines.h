/// The lines of a program, and how they are refused.
#pragma once

#include <string>
#include <string_view>

namespace flank::internal {

/// No block of a program has more words; what is longer is refused, so that no line costs more than its length.
inline constexpr std::size_t kMostNcWords = 100;

/// Where a program is read; every complaint names it.
struct NcPlace {
  std::string file;
  int line = 0;  ///< from 1; 0: the file as a whole

  /// Throws InputError: "file, line 7: why".
  [[noreturn]] void refuse(const std::string& why) const;
  /// The same for a word that is not of the subset of the language.
  [[noreturn]] void refuse_word(std::string_view word, std::string_view language) const;
};

/// Walks over a text line by line; the text must outlive this.
class NcLines {
 public:
  explicit NcLines(std::string_view text) : rest_(text) {}

  /// Goes to the next line; false at the end.
  bool next();
  /// As it stands, without its end.
  [[nodiscard]] std::string_view line() const { return line_; }
  /// The same in upper case.
  [[nodiscard]] const std::string& upper() const { return upper_; }
  [[nodiscard]] int number() const { return number_; }

 private:
  std::string_view rest_, line_;
  std::string upper_;
  int number_ = 0;
};

/// Without spaces at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);
/// In upper case (ASCII).
[[nodiscard]] std::string upper_case(std::string_view text);
/// The word in quotes, as a message can show it: printable, and not longer than a line has room for.
[[nodiscard]] std::string quoted(std::string_view word);

}  // namespace flank::internal
