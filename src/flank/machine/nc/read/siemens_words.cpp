#include "flank/machine/nc/read/siemens_words.h"

#include <algorithm>

#include "flank/machine/nc/nc_number.h"

namespace flank::internal {

namespace {

/// The three classes of characters that words of this language are made of, in ASCII and upper case.
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool is_capital(char c) { return (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_figure(char c) { return c >= '0' && c <= '9'; }

/// Walks over one line.
class SiemensLine {
 public:
  SiemensLine(std::string_view line, std::string_view upper, const NcPlace& place)
      : line_(line), upper_(upper), place_(place) {}

  void split(SiemensBlock& block) {
    for (skip(); at_ < upper_.size(); skip()) {
      if (upper_[at_] == ';') {
        block.comment = line_.substr(at_ + 1);
        return;
      }
      if (upper_[at_] == '/' && !block.skipped && (block.words.empty() || block.words.back().name == "N")) {
        block.skipped = true;
        ++at_;
        continue;
      }
      if (block.words.size() == kMostNcWords) place_.refuse("a block of more than 100 words");
      block.words.push_back(word());
    }
  }

 private:
  void skip() {
    while (at_ < upper_.size() && is_blank(upper_[at_])) ++at_;
  }
  [[nodiscard]] char now() const { return at_ < upper_.size() ? upper_[at_] : '\0'; }

  /// A letter with a number is an address of one letter ("X12.5", "G1"); with "=" behind the digits they belong to its
  /// name ("A3="), and so they do to names of several letters ("CYCLE832").
  SiemensWord word() {
    const std::size_t begin = at_;
    while (is_capital(now())) ++at_;
    const std::size_t letters = at_ - begin;
    if (letters == 0) place_.refuse(quoted(line_.substr(begin)) + " does not begin with a word");
    SiemensWord word;
    while (is_figure(now())) ++at_;
    const std::size_t name_end = at_;
    skip();
    // The digits belong to the value: back to them, now that no "=" follows.
    if (letters == 1 && now() != '=') {
      at_ = begin + 1;
      skip();
      word.name = upper_.substr(begin, 1);
      word.value = number(begin);
    } else {
      word.name = upper_.substr(begin, name_end - begin);
      behind_name(word, name_end, begin);
    }
    word.text = line_.substr(begin, at_ - begin);
    return word;
  }

  /// What may stand behind a name: "=" with a number or a string, arguments in parentheses, or nothing of it.
  void behind_name(SiemensWord& word, std::size_t name_end, std::size_t begin) {
    if (now() == '=') {
      ++at_;
      skip();
      if (now() == '"')
        word.string = between('"');
      else
        word.value = number(begin);
    } else if (now() == '(') {
      word.arguments = between(')');
    } else {
      // The blanks that were skipped belong to no word: its text, for messages, ends with its name.
      at_ = name_end;
    }
  }

  double number(std::size_t begin) {
    const auto n = leading_number(upper_.substr(at_));
    if (!n) place_.refuse(quoted(line_.substr(begin)) + " does not begin with a word and a number");
    at_ += n->length;
    return n->value;
  }

  /// From behind the present character to the closing one; in the letters of the line, since it may be a tool's name.
  std::string_view between(char close) {
    const std::size_t from = at_ + 1;
    const std::size_t end = upper_.find(close, from);
    if (end == std::string_view::npos) place_.refuse(std::string("a ") + upper_[at_] + " is not closed");
    at_ = end + 1;
    return line_.substr(from, end - from);
  }

  std::string_view line_, upper_;
  const NcPlace& place_;
  std::size_t at_ = 0;
};

}  // namespace

void split_siemens(std::string_view line, std::string_view upper, const NcPlace& place, SiemensBlock& block) {
  block.words.clear();
  block.comment = {};
  block.skipped = false;
  SiemensLine(line, upper, place).split(block);
}

}  // namespace flank::internal
