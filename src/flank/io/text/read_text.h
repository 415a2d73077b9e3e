/// Words and numbers of text files, with the line for messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flank::internal {

/// Walks over a text line by line. Views point into the content, which must outlive this.
class TextLines {
 public:
  TextLines(std::string file, std::string_view content, std::size_t begin = 0)
      : file_(std::move(file)), content_(content), at_(begin) {}

  /// Goes to the next line that has words; false at the end.
  bool next();
  [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }
  [[nodiscard]] std::string_view word(std::size_t i) const {
    return i < words_.size() ? words_[i] : std::string_view{};
  }
  [[nodiscard]] long line() const { return line_; }
  /// Index in the content of what follows the current line.
  [[nodiscard]] std::size_t position() const { return at_; }

  /// The i-th word as a finite number. Throws InputError naming file and line.
  [[nodiscard]] double number(std::size_t i) const;
  /// The i-th word as a whole number (what follows a "/" is ignored, as OBJ has it). Throws InputError naming file and
  /// line.
  [[nodiscard]] long integer(std::size_t i) const;
  [[noreturn]] void refuse(const std::string& why) const;

 private:
  std::string file_;
  std::string_view content_;
  std::size_t at_ = 0;
  long line_ = 0;
  std::vector<std::string_view> words_;
};

}  // namespace flank::internal
