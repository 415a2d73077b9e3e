#include "flank/correct/measure/read_points.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "flank/error.h"
#include "flank/io/part_format.h"
#include "flank/io/text/json_input.h"
#include "flank/io/text/read_text.h"
#include "flank/io/tool/tool_dxf_read.h"
#include "flank/part.h"

namespace flank::internal {
namespace {

std::string ending(const std::string& file) {
  std::string end = std::filesystem::path(file).extension().string();
  for (char& c : end) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return end;
}

bool has_letters(std::string_view word) {
  // An exponent alone makes no word.
  return std::any_of(word.begin(), word.end(), [](unsigned char c) { return std::isalpha(c) && c != 'e' && c != 'E'; });
}

}  // namespace

std::vector<std::vector<double>> read_number_lines(const std::string& file, std::size_t least) {
  std::string text = read_file(file);
  bool comment = false;
  for (char& c : text) {
    comment = c != '\n' && (comment || c == '#');
    if (comment || c == ',' || c == ';' || c == '\t') c = ' ';
  }
  std::vector<std::vector<double>> lines;
  TextLines reader(file, text);
  while (reader.next()) {
    if (lines.empty() && has_letters(reader.word(0))) continue;
    if (reader.words().size() < least) reader.refuse("at least " + std::to_string(least) + " numbers are required");
    std::vector<double>& line = lines.emplace_back();
    for (std::size_t k = 0; k < least; ++k) line.push_back(reader.number(k));
  }
  if (lines.empty()) throw InputError(file + ": holds no numbers");
  return lines;
}

std::vector<Vec2> read_profile_points(const std::string& file) {
  if (ending(file) == ".dxf") return profile_from_dxf(read_file(file), file);
  std::vector<Vec2> points;
  for (const std::vector<double>& line : read_number_lines(file, 2)) points.emplace_back(line[0], line[1]);
  return points;
}

std::vector<Vec3> read_measured_points(const std::string& file) {
  if (is_mesh_file(file)) return read_part(file, "mm").mesh.vertices;
  std::vector<Vec3> points;
  for (const std::vector<double>& line : read_number_lines(file, 3)) points.emplace_back(line[0], line[1], line[2]);
  return points;
}

}  // namespace flank::internal
