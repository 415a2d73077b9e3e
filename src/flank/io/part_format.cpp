#include "flank/io/part_format.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "flank/error.h"
#include "flank/io/mesh/read_obj.h"
#include "flank/io/mesh/read_ply.h"
#include "flank/io/mesh/read_stl.h"
#include "flank/io/text/read_bytes.h"
#include "flank/part.h"

namespace flank::internal {
namespace {

/// With its dot.
std::string lower_extension(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

bool looks_step(std::string_view content) { return without_blanks_in_front(content).starts_with("ISO-10303-21"); }

bool looks_brep(std::string_view content) {
  const std::string_view text = without_blanks_in_front(content);
  return text.starts_with("DBRep_DrawableShape") || text.starts_with("CASCADE Topology");
}

/// An IGES file is made of 80-column lines with a section letter in column 73; the first one is S (start), or B or C
/// (binary, compressed).
bool looks_iges(std::string_view content) {
  const std::string_view line = content.substr(0, content.find_first_of("\r\n"));
  if (line.size() < 73 || line.size() > 80 || line[72] != 'S') return false;
  return std::all_of(line.begin() + 73, line.end(), [](unsigned char c) { return std::isdigit(c) || c == ' '; });
}

std::string_view tail_of(std::string_view content) {
  return content.substr(content.size() - std::min<std::size_t>(content.size(), 2000));
}

// STEP and IGES end with a mark; the kernel reads a file without it and leaves out what is missing.
std::string_view lost_end_of_step(std::string_view content) {
  return tail_of(content).find("END-ISO-10303-21") == std::string_view::npos ? "the closing line END-ISO-10303-21" : "";
}

std::string_view lost_end_of_iges(std::string_view content) {
  const std::string_view tail = tail_of(content);
  const std::size_t last = tail.find_last_not_of(" \r\n\t\0");
  const std::size_t begin = last == std::string_view::npos ? last : tail.find_last_of("\r\n", last);
  const std::string_view line = begin == std::string_view::npos ? tail : tail.substr(begin + 1, last - begin);
  return line.size() < 73 || line[72] != 'T' ? "the terminate line, T in column 73," : "";
}

const PartFormat* format_of_ending(const std::string& file) {
  const std::string ending = lower_extension(file);
  for (const PartFormat& row : part_format_rows())
    if (std::find(row.endings.begin(), row.endings.end(), ending) != row.endings.end()) return &row;
  return nullptr;
}

/// "A, B or C" of what `words` says of every row.
template <class Words>
std::string listed(const Words& words) {
  std::string text;
  const std::span<const PartFormat> rows = part_format_rows();
  for (std::size_t k = 0; k < rows.size(); ++k)
    text += (k == 0 ? "" : k + 1 == rows.size() ? " or " : ", ") + words(rows[k]);
  return text;
}

}  // namespace

std::span<const PartFormat> part_format_rows() {
  static const std::vector<PartFormat> kRows{
      {.name = "STEP", .endings = {".step", ".stp", ".p21"}, .looks = looks_step, .lost_end = lost_end_of_step},
      {.name = "IGES", .endings = {".iges", ".igs"}, .looks = looks_iges, .lost_end = lost_end_of_iges},
      {.name = "BREP", .endings = {".brep", ".brp"}, .looks = looks_brep},
      {.name = "STL", .endings = {".stl"}, .looks = looks_stl, .read = read_stl, .loose = true, .markless = true},
      {.name = "OBJ", .endings = {".obj"}, .looks = looks_obj, .read = read_obj},
      {.name = "PLY", .endings = {".ply"}, .looks = looks_ply, .read = read_ply},
  };
  return kRows;
}

bool is_mesh_file(const std::string& file) {
  const PartFormat* format = format_of_ending(file);
  return format != nullptr && format->read != nullptr;
}

std::string accepted_part_files() {
  return listed([](const PartFormat& row) {
    std::string endings;
    for (const std::string_view ending : row.endings) endings += (endings.empty() ? "" : " ") + std::string(ending);
    return std::string(row.name) + " (" + endings + ")";
  });
}

const PartFormat& sniff_format(const std::string& file, std::string_view content) {
  const PartFormat* claimed = format_of_ending(file);
  if (claimed == nullptr)
    throw InputError(file + ": the extension \"" + lower_extension(file) +
                     "\" is not supported; accepted: " + accepted_part_files());
  // What takes the place of large files in some repositories.
  if (content.starts_with("version https://git-lfs.github.com/spec/"))
    throw InputError(file + ": is a Git LFS pointer, not the file; `git lfs pull` fetches the file");
  const std::string name(claimed->name);
  const std::span<const PartFormat> rows = part_format_rows();
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const PartFormat& row) { return row.looks(content); });
  if (found == rows.end() && claimed->markless) return *claimed;
  if (found == rows.end())
    throw InputError(file + ": the content is not " + name + " as the name says; accepted: " + accepted_part_files());
  if (&*found != claimed)
    throw InputError(file + ": the name says " + name + " but the content is " + std::string(found->name) +
                     "; rename it to match");
  const std::string lost(claimed->lost_end != nullptr ? claimed->lost_end(content) : "");
  if (!lost.empty())
    throw InputError(file + ": is truncated (" + lost + " is missing); export or copy the " + name + " file again");
  return *claimed;
}

}  // namespace flank::internal

namespace flank {

std::string part_formats() {
  return internal::listed([](const internal::PartFormat& row) { return std::string(row.name); });
}

}  // namespace flank
