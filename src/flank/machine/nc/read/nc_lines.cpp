#include "flank/machine/nc/read/nc_lines.h"

#include <algorithm>

#include "flank/error.h"
#include "flank/printable.h"

namespace flank::internal {

namespace {

constexpr std::string_view kSpace = " \t\r\v\f";  // what editors and transfers leave at the ends of lines
constexpr std::size_t kLongestShown = 40;         // of a word in a message: a damaged file may be one line of megabytes

/// ASCII only, and not by the locale: the same file is read the same everywhere.
char to_upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

}  // namespace

void NcPlace::refuse(const std::string& why) const {
  throw InputError(line > 0 ? file + ", line " + std::to_string(line) + ": " + why : file + ": " + why);
}

void NcPlace::refuse_word(std::string_view word, std::string_view language) const {
  refuse(quoted(word) + " is not supported in " + std::string(language) + " programs");
}

bool NcLines::next() {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  line_ = rest_.substr(0, end);
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  // Into the same string, whose memory stays: programs have a million lines.
  upper_.assign(line_);
  for (char& c : upper_) c = to_upper(c);
  ++number_;
  return true;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::string upper_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = to_upper(c);
  return out;
}

std::string quoted(std::string_view word) {
  std::string text = printable(word.substr(0, kLongestShown));
  if (word.size() > kLongestShown) text += "...";
  return '"' + text + '"';
}

}  // namespace flank::internal
