#include "flank/seed/axis_line.h"

#include <charconv>
#include <cmath>
#include <vector>

#include "flank/error.h"

namespace flank::internal {
namespace {

constexpr std::string_view kSeparators = ", \t\r\n;";

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t at = text.find_first_not_of(kSeparators); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kSeparators, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(kSeparators, end);
  }
  return words;
}

bool parse_number(std::string_view word, double& value) {
  // from_chars knows no plus sign and, good for us, no locale.
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && std::isfinite(value);
}

}  // namespace

bool parse_axis_line(std::string_view text, AxisLine& line, std::string& why) {
  const std::vector<std::string_view> words = split(text);
  if (words.size() != 6) {
    why =
        "found " + std::to_string(words.size()) + " numbers instead of six (x y z of the tip, x y z of the holder end)";
    return false;
  }
  for (int k = 0; k < 6; ++k) {
    double& value = k < 3 ? line.tip[k] : line.holder[k - 3];
    if (parse_number(words[static_cast<std::size_t>(k)], value)) continue;
    why = "'" + std::string(words[static_cast<std::size_t>(k)]) + "' is not a finite number";
    return false;
  }
  // Relative, so that a line of a micrometre near the origin is as good as one of a metre far from it.
  constexpr double kSamePlace = 1e-9;
  const double scale = std::max(line.tip.norm(), line.holder.norm());
  if (line.length() > kSamePlace * scale) return true;
  why = "the two ends of the line are the same point";
  return false;
}

AxisLine parse_start_line(std::string_view text) {
  AxisLine line;
  std::string why;
  if (!parse_axis_line(text, line, why))
    throw UsageError("start", std::string(text),
                     why + "; give the two ends of an axis in mm, for example 0,0,5,0,0,45");
  return line;
}

}  // namespace flank::internal
