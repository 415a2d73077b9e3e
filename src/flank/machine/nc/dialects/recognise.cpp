#include "flank/machine/nc/read/recognise.h"

#include <array>

#include "flank/machine/nc/read/nc_lines.h"

namespace flank::internal {

namespace {

struct Word {
  std::string_view text;
  NcLanguage language;
};

/// Words that decide, in the order in which they are tried: no other language has them where they are looked for.
/// Comments are taken off before, since a part's name may hold anything.
/// At the beginning of a line, behind its number.
constexpr std::array<Word, 8> kFirst = {{{"BEGIN PGM", NcLanguage::kHeidenhain},
                                         {"PARTNO", NcLanguage::kApt},
                                         {"UNITS/", NcLanguage::kApt},
                                         {"MULTAX", NcLanguage::kApt},
                                         {"GOTO/", NcLanguage::kApt},
                                         {"FEDRAT/", NcLanguage::kApt},
                                         {"LOADTL/", NcLanguage::kApt},
                                         {"%_N_", NcLanguage::kSiemens}}};
/// Anywhere in a line.
constexpr std::array<Word, 16> kAnywhere = {{{"TRAORI", NcLanguage::kSiemens},
                                             {"TRAFOOF", NcLanguage::kSiemens},
                                             {"ORIWKS", NcLanguage::kSiemens},
                                             {"A3=", NcLanguage::kSiemens},
                                             {"T=\"", NcLanguage::kSiemens},
                                             {"CYCLE832", NcLanguage::kSiemens},
                                             {"FGROUP", NcLanguage::kSiemens},
                                             {"G710", NcLanguage::kSiemens},
                                             {"SUPA", NcLanguage::kSiemens},
                                             {"G43.4", NcLanguage::kFanuc},
                                             {"G43.5", NcLanguage::kFanuc},
                                             {"G5.1", NcLanguage::kFanuc},
                                             {"TOOL CALL", NcLanguage::kHeidenhain},
                                             {"FUNCTION TCPM", NcLanguage::kHeidenhain},
                                             {"FMAX", NcLanguage::kHeidenhain},
                                             {"M128", NcLanguage::kHeidenhain}}};
/// Of G-code in general, but not of Siemens, where nothing better is found.
constexpr std::array<std::string_view, 3> kPlain = {"G21", "G20", "G43"};

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

/// "O0001" and ":0001", which begin a program of Fanuc; "O100 SUB" is LinuxCNC's.
bool is_program_number(std::string_view code) {
  if (code.size() < 2 || (code[0] != 'O' && code[0] != ':')) return false;
  for (const char c : code.substr(1))
    if (!is_digit(c)) return false;
  return true;
}

/// The first word in this line of code that only one language has.
std::optional<Word> mark_in(std::string_view code) {
  const std::string_view words = behind_number(code);
  if (is_program_number(words)) return Word{words, NcLanguage::kFanuc};
  for (const Word& w : kFirst)
    if (words.starts_with(w.text)) return w;
  for (const Word& w : kAnywhere)
    if (words.find(w.text) != std::string_view::npos) return w;
  return std::nullopt;
}

}  // namespace

std::optional<NcMark> recognised_language(std::string_view text) {
  NcLines lines(text);
  std::optional<NcMark> plain;
  while (lines.next() && lines.number() <= kRecognisedLines) {
    const std::string code = code_of(lines.upper());
    if (const auto found = mark_in(code)) return NcMark{found->language, lines.number(), std::string(found->text)};
    // Kept as a second choice: the words of plain G-code occur on Fanuc as well, whose own ones may stand farther
    // down.
    if (plain) continue;
    for (const std::string_view word : kPlain)
      if (code.find(word) != std::string::npos)
        plain = NcMark{NcLanguage::kLinuxCnc, lines.number(), std::string(word)};
  }
  return plain;
}

}  // namespace flank::internal
