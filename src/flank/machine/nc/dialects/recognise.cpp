#include "flank/machine/nc/dialects/recognise.h"

#include "flank/machine/nc/dialects/languages.h"
#include "flank/machine/nc/read/nc_lines.h"

namespace flank::internal {

namespace {

struct Word {
  std::string_view text;
  NcLanguage language;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The line without comments: those in parentheses and what follows a semicolon.
/// Parentheses are comments in G-code and arguments in Siemens programs; what is looked for stands outside of both.
std::string code_of(const std::string& line) {
  std::string code;
  bool comment = false;
  for (const char c : line) {
    if (c == ';' && !comment) break;
    if (c == '(') comment = true;
    if (!comment) code += c;
    if (c == ')') comment = false;
  }
  return std::string(trimmed(code));
}

/// Behind a block number: "12 L X+1" and "N12 G1 X1".
std::string_view behind_number(std::string_view code) {
  std::size_t i = code.starts_with('N') ? 1 : 0;
  const std::size_t first = i;
  while (i < code.size() && is_digit(code[i])) ++i;
  return i == first ? code : trimmed(code.substr(i));
}

/// The first word of those that `words` names of every language which is in this code, as `found` says.
template <class Found>
std::optional<Word> word_in(NcMarkWords NcLanguageRow::*words, const Found& found) {
  for (const NcLanguageRow* row : nc_languages())
    for (const std::string_view word : row->*words)
      if (!word.empty() && found(word)) return Word{word, row->language};
  return std::nullopt;
}

/// The first word in this line of code that only one language has.
std::optional<Word> mark_in(std::string_view code) {
  const std::string_view words = behind_number(code);
  for (const NcLanguageRow* row : nc_languages())
    if (row->is_first != nullptr && row->is_first(words)) return Word{words, row->language};
  if (const auto first = word_in(&NcLanguageRow::first, [&](std::string_view w) { return words.starts_with(w); }))
    return first;
  return word_in(&NcLanguageRow::anywhere, [&](std::string_view w) { return words.find(w) != words.npos; });
}

}  // namespace

std::optional<NcMark> recognised_language(std::string_view text) {
  NcLines lines(text);
  std::optional<NcMark> plain;
  while (lines.next() && lines.number() <= kRecognisedLines) {
    const std::string code = code_of(lines.upper());
    if (const auto mark = mark_in(code)) return NcMark{mark->language, lines.number(), std::string(mark->text)};
    // Kept as a second choice: the words of plain G-code occur on Fanuc as well, whose own ones may stand farther
    // down.
    if (plain) continue;
    const auto found = word_in(&NcLanguageRow::plain, [&](std::string_view w) { return code.find(w) != code.npos; });
    if (found) plain = NcMark{found->language, lines.number(), std::string(found->text)};
  }
  return plain;
}

}  // namespace flank::internal
