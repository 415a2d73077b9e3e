#include "flank/machine/nc/without_effect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "flank/machine/nc/nc_number.h"

namespace flank::internal {

namespace {

constexpr std::size_t kLongestWord = 40;

/// Moves, planes, shifts and turns of the frame, scales, compensations, cycles, calls, kinematics and modes of feed, in tenths. They
/// change what the coordinates of a program mean: no machine runs them without effect.
constexpr std::array<int, 66> kWithEffect = {
    0,   10,  20,  30,  32,  33,  52,  53,  62,  70,  71,  72,  100, 110, 121, 131, 160, 180, 190, 200, 210, 280,
    300, 310, 330, 380, 410, 412, 420, 430, 431, 434, 435, 490, 500, 510, 520, 530, 531, 540, 541, 650, 660, 670,
    680, 682, 700, 710, 730, 740, 760, 810, 820, 830, 840, 850, 900, 910, 930, 940, 920, 921, 922, 923, 960, 970};
/// Of M: ends, stops of the spindle, tool changes, subprograms, and tool-centre control of a control that has it there.
constexpr std::array<int, 15> kMWithEffect = {2, 3, 4, 5, 6, 13, 14, 17, 30, 91, 92, 98, 99, 128, 140};
/// Names, or their beginnings, that move, turn or shift.
constexpr std::array<std::string_view, 22> kNames = {
    "TRAORI", "TRAFOOF", "TRACYL", "TRANSMIT", "ORI",  "SUPA", "TRANS", "ATRANS", "ROT",      "AROT",  "SCALE",
    "ASCALE", "MIRROR",  "CALL",   "LBL",      "TOOL", "CYCL", "L",     "LN",     "FUNCTION", "TOROT", "GOTO"};

/// The number of a word of a letter and nothing else.
std::optional<double> number_of(std::string_view word) {
  const auto number = leading_number(word.substr(1));
  return number && number->length + 1 == word.size() ? std::optional(number->value) : std::nullopt;
}

bool is_word_character(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ' ' || c == '.' || c == '_' || c == '(' || c == ')';
}

/// "CYCLE800" swivels, and so does "PLANE SPATIAL"; "CYCLE800()" and "PLANE RESET STAY" only end it.
bool name_has_effect(std::string_view word) {
  if (word.starts_with("PLANE")) return word != "PLANE RESET STAY";
  if (word.starts_with("CYCLE")) return !word.ends_with("()") && word != "CYCLE832";
  const std::string_view first = word.substr(0, word.find_first_of(" ("));
  return std::find(kNames.begin(), kNames.end(), first) != kNames.end() || first.starts_with("ORI");
}

}  // namespace

std::string why_not_without_effect(std::string_view word) {
  constexpr const char* kAccepted = "expected M and G words as \"M10\", and names as \"CYCLE800()\"";
  if (word.empty() || word.size() > kLongestWord || !std::all_of(word.begin(), word.end(), is_word_character) ||
      word.front() < 'A')
    return std::string("is not a word of a program; ") + kAccepted;
  const std::optional<double> number = number_of(word);
  if (!number) return name_has_effect(word) ? "affects the motion, so it cannot be listed as without effect" : "";
  const int tenths = static_cast<int>(std::lround(std::min(*number, 1e6) * 10.0));
  const bool g = word.front() == 'G' && std::find(kWithEffect.begin(), kWithEffect.end(), tenths) != kWithEffect.end();
  const bool m =
      word.front() == 'M' && std::find(kMWithEffect.begin(), kMWithEffect.end(), tenths / 10) != kMWithEffect.end();
  if (g || m) return "affects the motion, so it cannot be listed as without effect";
  return word.front() == 'G' || word.front() == 'M' ? "" : std::string("states a value; ") + kAccepted;
}

bool is_without_effect(const NcDialect& dialect, char letter, double value) {
  return std::any_of(dialect.without_effect.begin(), dialect.without_effect.end(), [&](const std::string& word) {
    // By value, so that "M010" and "M10" are the same word.
    return word.front() == letter && number_of(word) == value;
  });
}

bool is_without_effect(const NcDialect& dialect, std::string_view text) {
  return std::find(dialect.without_effect.begin(), dialect.without_effect.end(), text) != dialect.without_effect.end();
}

bool is_parameter_letter(char letter) {
  return letter == 'P' || letter == 'Q' || letter == 'R' || letter == 'L' || letter == 'E' || letter == 'D';
}

}  // namespace flank::internal
