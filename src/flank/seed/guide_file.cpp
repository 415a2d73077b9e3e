#include "flank/seed/guide_file.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "flank/error.h"

namespace flank::internal {

std::vector<AxisLine> parse_guide(const std::string& file, std::string_view text) {
  std::vector<AxisLine> lines;
  std::size_t number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view row = text.substr(at, end - at);
    at = end + 1;
    ++number;
    row = row.substr(0, row.find('#'));
    if (row.find_first_not_of(" \t\r,;") == std::string_view::npos) continue;
    AxisLine line;
    std::string why;
    if (!parse_axis_line(row, line, why)) throw InputError(file + ", line " + std::to_string(number) + ": " + why);
    lines.push_back(line);
  }
  if (lines.size() >= 2) return lines;
  throw InputError(file +
                   ": a guide needs at least two lines of six numbers (tip and holder end of an axis, mm), found " +
                   std::to_string(lines.size()));
}

std::vector<AxisLine> read_guide(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  if (stream) content << stream.rdbuf();
  if (!stream || (content.str().empty() && stream.peek() != std::ifstream::traits_type::eof()))
    throw InputError(file + ": cannot be read; a text file of lines with six numbers is expected");
  return parse_guide(file, content.str());
}

}  // namespace flank::internal
