#include "flank/io/text/step_syntax.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <unordered_set>

#include "flank/error.h"
#include "flank/io/text/read_bytes.h"

namespace flank::internal {
namespace {

constexpr long kLargestStepId = 100'000'000'000'000'000;  ///< longer numbers of a damaged file all count as this one

/// ASCII classes of the exchange format (ISO 10303-21); "!" begins the names of user-defined entities.
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '!'; }
bool is_word(char c) { return is_letter(c) || is_digit(c) || c == '-'; }

std::string in_capitals(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return capitals;
}

/// "1e5", "1.5d5" as "1.E5", "1.5E5". Readers of the kernel's kind begin another word at any other letter, and at an E that
/// follows a single digit.
std::string in_plain_digits(std::string_view number) {
  std::string plain = in_capitals(number);
  std::replace(plain.begin(), plain.end(), 'D', 'E');
  const std::size_t exponent = plain.find('E');
  if (exponent != std::string::npos && plain.find('.') == std::string::npos) plain.insert(exponent, 1, '.');
  return plain;
}

/// Walks over one data section and writes it in its plain form.
class Section {
 public:
  /// `out` has all of the text before `at`, or what stands for it.
  Section(const std::string& file, std::string_view text, std::size_t at, std::string& out)
      : file_(file), text_(text), at_(at), out_(out), written_(at) {}

  /// To the end of the section; returns where that is.
  std::size_t walk() {
    for (space(); in_capitals(text_.substr(at_, 6)) != "ENDSEC"; space()) instance();
    keep();
    return at_;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    // Counted only when there is something to complain about.
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    throw InputError(fmt::format("{}, line {}: {}; export the STEP file again", file_, line, why));
  }
  /// All up to here, as it is.
  void keep() {
    out_.append(text_, written_, at_ - written_);
    written_ = at_;
  }
  /// What stands from `begin` up to here, by other words where they differ.
  void put(std::size_t begin, const std::string& words) {
    if (text_.substr(begin, at_ - begin) == words) return;
    out_.append(text_, written_, begin - written_);
    out_ += words;
    written_ = at_;
  }
  [[nodiscard]] bool starts_with(std::string_view word) const { return text_.substr(at_, word.size()) == word; }
  /// The next byte, 0 at the end.
  [[nodiscard]] char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  /// Over blanks and comments.
  void space() {
    while (true) {
      const std::size_t begin = at_;
      if (starts_with("/*")) {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string_view::npos) refuse("a comment is not closed");
        at_ = end + 2;
        put(begin, " ");
        continue;
      }
      if (at_ >= text_.size()) refuse("the section is not closed by ENDSEC");
      const char c = text_[at_];
      if (std::isspace(static_cast<unsigned char>(c)) == 0) return;
      ++at_;
      // A tab after a quotation mark keeps readers from seeing the end of the text.
      if (c != '\n' && c != '\r') put(begin, " ");
    }
  }

  void expect(char c) {
    space();
    if (peek() != c) refuse(fmt::format("'{}' is missing", c));
    ++at_;
  }

  /// #1 = WORD(...); or #1 = (WORD(...) WORD(...));
  void instance() {
    define();
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

  /// "#1 =", as "#1=".
  void define() {
    const std::size_t begin = at_;
    reference();
    const std::string_view name = text_.substr(begin, at_ - begin);
    if (!defined_.insert(name).second) {
      at_ = begin;
      refuse(fmt::format("{} is defined a second time", name));
    }
    keep();
    const std::size_t size = out_.size();
    expect('=');
    keep();
    out_.resize(size);
    out_ += '=';
  }

  void reference() {
    if (peek() != '#') refuse("an instance (#1 = ...) is expected");
    ++at_;
    if (!is_digit(peek())) refuse("a number is missing after #");
    while (is_digit(peek())) ++at_;
  }

  void record() {
    if (!is_letter(peek())) refuse("the name of an entity is expected");
    const std::size_t begin = at_;
    word();
    const std::string name = in_capitals(text_.substr(begin, at_ - begin));
    most_values_ = name == "CARTESIAN_POINT" || name == "DIRECTION" ? 3 : 0;
    space();
    if (peek() != '(') refuse("a name without its parameters stands where a value is expected");
    list();
  }

  void word() {
    const std::size_t begin = at_;
    while (is_word(peek())) ++at_;
    put(begin, in_capitals(text_.substr(begin, at_ - begin)));
  }

  /// From its opening to its closing parenthesis, with the lists in it.
  void list() {
    int depth = 0, values = 0;
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
        if (depth > 1 && ++values > most_values_ && most_values_ > 0)
          refuse(fmt::format("a point or a direction has more than {} coordinates", most_values_));
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
      word();
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

  /// An apostrophe in a text is two of them. Before a comma or parenthesis readers take them for the end of the text, so
  /// there it is written by its number.
  void quoted(char mark) {
    const std::size_t begin = at_++;
    while (true) {
      const std::size_t end = text_.find(mark, at_);
      if (end == std::string_view::npos) {
        at_ = begin;
        refuse("a text is not closed");
      }
      at_ = end + 1;
      if (peek() != mark) return;
      ++at_;
      const std::size_t next = text_.find_first_not_of(" \n\r", at_);
      const bool like_the_end = next != std::string_view::npos && (text_[next] == ',' || text_[next] == ')');
      if (mark == '\'' && like_the_end) put(end, "\\X\\27");
    }
  }

  void enumeration() {
    ++at_;
    word();
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
    for (char& c : word) c = c == 'D' || c == 'd' ? 'e' : c;
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.erase(0, 1);
    double value = 0.0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    // A digit within the first three characters rules out "inf" and "nan", which from_chars would take.
    const bool whole = stop == word.data() + word.size() && word.find_first_of("0123456789") <= 2;
    // A number too small for a double is nothing.
    const bool too_small = error == std::errc::result_out_of_range &&
                           (word.find("e-") != std::string::npos || word.find("E-") != std::string::npos);
    if (whole && (too_small || (error == std::errc() && std::isfinite(value))))
      return put(begin, in_plain_digits(text_.substr(begin, end - begin)));
    at_ = begin;
    refuse(fmt::format("\"{}\" is not a finite number", shown));
  }

  const std::string& file_;
  std::string_view text_;
  std::size_t at_;
  std::string& out_;
  std::size_t written_;  ///< so much of the text is in `out_`, or what stands for it
  std::unordered_set<std::string_view> defined_;
  bool just_opened_ = false;
  int most_values_ = 0;  ///< in a list of this record; 0: any number
};

/// Where the word begins at or after `at`, in either case of letters.
std::size_t find_word(std::string_view text, std::string_view word, std::size_t at) {
  const auto begin = text.begin() + static_cast<std::ptrdiff_t>(std::min(at, text.size()));
  const auto found = std::search(begin, text.end(), word.begin(), word.end(),
                                 [](unsigned char a, unsigned char b) { return std::toupper(a) == std::toupper(b); });
  return found == text.end() ? std::string_view::npos : static_cast<std::size_t>(found - text.begin());
}

}  // namespace

std::string plain_step(const std::string& file, std::string_view content) {
  constexpr std::string_view kBegin = "DATA;";
  std::string out;
  out.reserve(content.size());
  std::size_t copied = content.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  for (std::size_t at = find_word(content, kBegin, 0); at != std::string_view::npos;
       at = find_word(content, kBegin, at)) {
    // The word may stand in a text of the header, too.
    const std::size_t next = content.find_first_not_of(" \t\r\n", at + kBegin.size());
    const bool begins_line = at == 0 || content[at - 1] == '\n' || content[at - 1] == '\r' || content[at - 1] == ';';
    const bool section = next == std::string_view::npos || content[next] == '#' || content[next] == '/' ||
                         in_capitals(content.substr(next, 6)) == "ENDSEC";
    at += kBegin.size();
    if (!begins_line && !section) continue;
    out.append(content, copied, at - kBegin.size() - copied);
    out += kBegin;
    copied = at = Section(file, content, at, out).walk();
  }
  out.append(content, copied);
  return out;
}

std::vector<long> undefined_step_references(const std::string& content) {
  std::unordered_set<long> defined, used;
  bool in_string = false;
  for (std::size_t i = content.find("DATA;"); i < content.size(); ++i) {
    const char c = content[i];
    if (!in_string && content.compare(i, 2, "/*") == 0) {
      // A comment may hold an apostrophe, or a # that refers to nothing.
      i = std::min(content.find("*/", i + 2), content.size() - 2) + 1;
      continue;
    }
    if (c == '\'') in_string = !in_string;
    if (in_string || c != '#') continue;
    long id = 0;
    std::size_t k = i + 1;
    for (; k < content.size() && std::isdigit(static_cast<unsigned char>(content[k])); ++k)
      id = std::min(10 * id + (content[k] - '0'), kLargestStepId);
    while (k < content.size() && std::isspace(static_cast<unsigned char>(content[k]))) ++k;
    (k < content.size() && content[k] == '=' ? defined : used).insert(id);
  }
  std::vector<long> lost;
  for (const long id : used)
    if (!defined.contains(id)) lost.push_back(id);
  std::sort(lost.begin(), lost.end());
  return lost;
}

}  // namespace flank::internal
