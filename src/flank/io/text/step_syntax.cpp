#include "flank/io/text/step_syntax.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "flank/error.h"

namespace flank::internal {
namespace {

/// ASCII classes of the exchange format (ISO 10303-21); "!" begins the names of user-defined entities.
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '!'; }
bool is_word(char c) { return is_letter(c) || is_digit(c) || c == '-'; }

/// Walks over one data section.
/// Nothing is kept of what it reads: only whether it follows the grammar matters.
class Section {
 public:
  Section(const std::string& file, std::string_view text, std::size_t at) : file_(file), text_(text), at_(at) {}

  /// To the end of the section; returns where that is.
  std::size_t walk() {
    for (space(); !starts_with("ENDSEC"); space()) instance();
    return at_;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    // Counted only when there is something to complain about.
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    throw InputError(fmt::format("{}, line {}: {}; export the STEP file again", file_, line, why));
  }
  [[nodiscard]] bool starts_with(std::string_view word) const { return text_.substr(at_, word.size()) == word; }
  /// The next byte, 0 at the end.
  [[nodiscard]] char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  /// Over blanks and comments.
  void space() {
    for (;; ++at_) {
      while (starts_with("/*")) {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string_view::npos) refuse("a comment is not closed");
        at_ = end + 2;
      }
      if (at_ >= text_.size()) refuse("the section is not closed by ENDSEC");
      if (std::isspace(static_cast<unsigned char>(text_[at_])) == 0) return;
    }
  }

  void expect(char c) {
    space();
    if (peek() != c) refuse(fmt::format("'{}' is missing", c));
    ++at_;
  }

  /// #1 = WORD(...); or #1 = (WORD(...) WORD(...));
  void instance() {
    reference();
    expect('=');
    space();
    if (peek() == '(') {
      ++at_;
      for (space(); peek() != ')'; space()) record();
      ++at_;
    } else {
      record();
    }
    expect(';');
  }

  void reference() {
    if (peek() != '#') refuse("an instance (#1 = ...) is expected");
    ++at_;
    if (!is_digit(peek())) refuse("a number is missing after #");
    while (is_digit(peek())) ++at_;
  }

  void record() {
    if (!is_letter(peek())) refuse("the name of an entity is expected");
    while (is_word(peek())) ++at_;
    space();
    if (peek() != '(') refuse("a name without its parameters stands where a value is expected");
    list();
  }

  /// From its opening to its closing parenthesis, with the lists in it.
  void list() {
    int depth = 0;
    bool value_next = true;
    do {
      space();
      const char c = peek();
      if (c == ',') {
        if (value_next) refuse("a parameter is empty");
        value_next = true;
        ++at_;
      } else if (c == ')') {
        // "()" is an empty list, "(1,)" lacks a parameter.
        if (value_next && !just_opened_) refuse("a parameter is empty");
        value_next = false;
        --depth;
        ++at_;
      } else {
        if (!value_next) refuse("a comma is missing");
        value_next = opens();
        depth += value_next ? 1 : 0;
        just_opened_ = value_next;
        continue;
      }
      just_opened_ = false;
    } while (depth > 0);
  }

  /// Over a value; true if it is the beginning of a list, of which only that was passed.
  bool opens() {
    const char c = peek();
    // A typed parameter, LENGTH_MEASURE(1.5): a name and a list.
    if (is_letter(c)) {
      while (is_word(peek())) ++at_;
      space();
      if (peek() != '(') refuse("a name without its parameters stands where a value is expected");
    }
    if (peek() == '(') {
      ++at_;
      return true;
    }
    if (c == '#')
      reference();
    else if (c == '$' || c == '*')
      ++at_;
    else if (c == '\'' || c == '"')
      quoted(c);
    else if (c == '.' && !is_digit(next()))
      enumeration();
    else
      number();
    return false;
  }
  [[nodiscard]] char next() const { return at_ + 1 < text_.size() ? text_[at_ + 1] : '\0'; }

  /// An apostrophe in a string is two of them, which read as two strings here: no difference.
  void quoted(char mark) {
    do {
      const std::size_t end = text_.find(mark, at_ + 1);
      if (end == std::string_view::npos) refuse("a text is not closed");
      at_ = end + 1;
    } while (peek() == mark);
  }

  void enumeration() {
    ++at_;
    while (is_word(peek())) ++at_;
    if (peek() != '.') refuse("a word between dots is not closed");
    ++at_;
  }

  void number() {
    const std::size_t begin = at_;
    // Up to what may follow a value; what lies in between is the number or no number.
    while (at_ < text_.size() && text_.find_first_of(",() \t\r\n;/", at_) != at_) ++at_;
    const std::size_t end = at_;
    std::string word(text_.substr(begin, end - begin));
    const std::string shown = word.substr(0, 40);
    // Some writers put D where Fortran does. from_chars takes neither that nor a plus.
    std::replace(word.begin(), word.end(), 'D', 'e');
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.erase(0, 1);
    double value = 0.0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    // A digit within the first three characters rules out "inf" and "nan", which from_chars would take.
    const bool whole = stop == word.data() + word.size() && word.find_first_of("0123456789") <= 2;
    // A number too small for a double is nothing.
    const bool too_small = error == std::errc::result_out_of_range &&
                           (word.find("e-") != std::string::npos || word.find("E-") != std::string::npos);
    if (whole && (too_small || (error == std::errc() && std::isfinite(value)))) return;
    at_ = begin;
    refuse(fmt::format("\"{}\" is not a finite number", shown));
  }

  const std::string& file_;
  std::string_view text_;
  std::size_t at_;
  bool just_opened_ = false;
};

}  // namespace

void check_step_syntax(const std::string& file, std::string_view content) {
  constexpr std::string_view kBegin = "DATA;";
  for (std::size_t at = content.find(kBegin); at != std::string_view::npos; at = content.find(kBegin, at)) {
    // The word may stand in a text of the header, too.
    const std::size_t next = content.find_first_not_of(" \t\r\n", at + kBegin.size());
    const bool begins_line = at == 0 || content[at - 1] == '\n' || content[at - 1] == '\r' || content[at - 1] == ';';
    const bool section = next == std::string_view::npos || content[next] == '#' || content[next] == '/' ||
                         content.substr(next, 6) == "ENDSEC";
    at += kBegin.size();
    if (begins_line || section) at = Section(file, content, at).walk();
  }
}

}  // namespace flank::internal
