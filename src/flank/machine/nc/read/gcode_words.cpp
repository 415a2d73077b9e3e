#include "flank/machine/nc/read/gcode_words.h"

#include <algorithm>
#include <cmath>

#include "flank/machine/nc/nc_number.h"
#include "flank/machine/nc/without_effect.h"

namespace flank::internal {

namespace {

/// Blanks between words; "\r" too, because only the last one of a line is taken off with it.
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Letters that a block states once.
void refuse_twice(const GBlock& block, const GWord& word, const NcPlace& place) {
  if (word.letter != 'G' && word.letter != 'M' && block.find(word.letter) != nullptr)
    place.refuse(std::string("the block states ") + word.letter + " twice");
}

/// Whether nothing but a number stands before this place of the block.
bool begins(const GBlock& block) {
  return !block.skipped && (block.words.empty() || (block.words.size() == 1 && block.words[0].letter == 'N'));
}

}  // namespace

// A tenth is the smallest step of such words (G43.4, G54.1). The slack is for decimals that binary numbers do not
// hold.
int GWord::code() const {
  const double tenths = value * 10.0;
  const double rounded = std::round(tenths);
  return value >= 0.0 && value < 1000.0 && std::abs(tenths - rounded) < 1e-6 ? static_cast<int>(rounded) : -1;
}

int GWord::whole() const {
  return value >= 0.0 && value <= 99999999.0 && value == std::floor(value) ? static_cast<int>(value) : -1;
}

const GWord* GBlock::find(char letter) const {
  for (const GWord& word : words)
    if (word.letter == letter) return &word;
  return nullptr;
}

bool GBlock::has_code(char letter, int code) const {
  for (const GWord& word : words)
    if (word.letter == letter && word.code() == code) return true;
  return false;
}

void split_gcode(std::string_view line, std::string_view upper, const NcPlace& place, GBlock& block) {
  block.words.clear();
  block.comments.clear();
  block.skipped = false;
  // Only where it is alone: a tape's beginning and end, which LinuxCNC takes for the end of the program.
  block.percent = trimmed(line) == "%";
  if (block.percent) return;
  for (std::size_t i = 0; i < upper.size();) {
    const char c = upper[i];
    if (is_space(c)) {
      ++i;
    } else if (c == '/' && begins(block)) {
      block.skipped = true;
      ++i;
    } else if (c == '(') {
      // Comments do not nest on these controls: the first ")" ends it.
      const std::size_t end = upper.find(')', i);
      if (end == std::string_view::npos) place.refuse("a comment is not closed");
      // From the line as it stands: names of parts and faces keep their small letters.
      block.comments.push_back(line.substr(i + 1, end - i - 1));
      i = end + 1;
    } else if (c == ';') {
      block.comments.push_back(line.substr(i + 1));
      return;
    } else {
      std::size_t at = i + 1;
      // "X 12.5" and "G 1" are one word to these controls.
      while (at < upper.size() && is_space(upper[at])) ++at;
      const auto number = c >= 'A' && c <= 'Z' ? leading_number(upper.substr(at)) : std::nullopt;
      if (!number) place.refuse(quoted(line.substr(i)) + " does not begin with a letter and a number");
      const GWord word{c, number->value, number->point, line.substr(i, at + number->length - i)};
      refuse_twice(block, word, place);
      if (block.words.size() == kMostNcWords) place.refuse("a block of more than 100 words");
      block.words.push_back(word);
      i = at + number->length;
    }
  }
}

void require_same_if_skipped(const GBlock& block, const NcDialect& dialect, const NcPlace& place) {
  if (!block.skipped) return;
  for (const GWord& word : block.words) {
    const int m = word.letter == 'M' ? word.whole() : -1;
    const bool same = word.letter == 'N' || m == 0 || m == 1 || (m >= 7 && m <= 9) ||
                      is_without_effect(dialect, word.letter, word.value);
    if (!same)
      place.refuse(quoted(word.text) +
                   " stands in a block that may be skipped (/); only words without effect on the motion "
                   "may stand there");
  }
}

bool has_words(const GBlock& block, const std::vector<GWord>& words) {
  return !words.empty() && std::all_of(words.begin(), words.end(), [&](const GWord& wanted) {
    // By value, so that "M0428" and "M428.0" are the same word.
    return std::any_of(block.words.begin(), block.words.end(),
                       [&](const GWord& w) { return w.letter == wanted.letter && w.value == wanted.value; });
  });
}

}  // namespace flank::internal
