#include "flank/io/text/read_sniff.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <unordered_set>

#include "flank/error.h"

namespace flank::internal {
namespace {

constexpr const char* kAccepted =
    "STEP (.step .stp), IGES (.iges .igs), BREP (.brep .brp), STL (.stl), OBJ (.obj) or PLY (.ply)";
constexpr long kLargestStepId = 100'000'000'000'000'000;  ///< longer numbers of a damaged file all count as this one

/// With its dot.
std::string lower_extension(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

/// Throws InputError for an extension that no reader has.
std::string format_of_extension(const std::string& file) {
  static const std::map<std::string, std::string> formats = {
      {".step", "STEP"}, {".stp", "STEP"}, {".p21", "STEP"}, {".iges", "IGES"}, {".igs", "IGES"},
      {".brep", "BREP"}, {".brp", "BREP"}, {".stl", "STL"},  {".obj", "OBJ"},   {".ply", "PLY"}};
  const auto found = formats.find(lower_extension(file));
  if (found == formats.end())
    throw InputError(file + ": the extension \"" + lower_extension(file) +
                     "\" is not supported; accepted: " + kAccepted);
  return found->second;
}

bool begins_with(std::string_view content, std::string_view word) { return content.substr(0, word.size()) == word; }

/// Without a byte order mark and blanks in front.
std::string_view skip_space(std::string_view content) {
  if (begins_with(content, kByteOrderMark)) content.remove_prefix(kByteOrderMark.size());
  while (!content.empty() && std::isspace(static_cast<unsigned char>(content.front()))) content.remove_prefix(1);
  return content;
}

/// An IGES file is made of 80-column lines with a section letter in column 73; the first one is S (start), or B or C
/// (binary, compressed).
bool looks_iges(std::string_view content) {
  const std::string_view line = content.substr(0, content.find_first_of("\r\n"));
  if (line.size() < 73 || line.size() > 80 || line[72] != 'S') return false;
  return std::all_of(line.begin() + 73, line.end(), [](unsigned char c) { return std::isdigit(c) || c == ' '; });
}

/// The word "solid" alone is not enough: binary STL files may begin with it, too.
bool looks_text_stl(std::string_view content) {
  const std::string_view text = skip_space(content);
  if (!begins_with(text, "solid")) return false;
  const std::string_view head = text.substr(0, 1000);
  return head.find("facet") != std::string_view::npos || head.find("endsolid") != std::string_view::npos;
}

/// An OBJ file has no magic number: among its first lines with content there is a vertex, and every keyword is one of
/// the format's.
bool looks_obj(std::string_view content) {
  static const std::array<std::string_view, 14> words = {"v",      "vt",     "vn", "vp", "f", "l",      "p",
                                                         "mtllib", "usemtl", "o",  "g",  "s", "cstype", "deg"};
  bool vertex = false;
  int lines = 0;
  while (!content.empty() && lines < 200 && !vertex) {
    const std::size_t end = content.find('\n');
    std::string_view line = content.substr(0, end);
    content = end == std::string_view::npos ? std::string_view{} : content.substr(end + 1);
    line = skip_space(line);
    if (line.empty() || line.front() == '#') continue;
    const std::string_view word = line.substr(0, line.find_first_of(" \t\r"));
    if (std::find(words.begin(), words.end(), word) == words.end()) return false;
    vertex = word == "v";
    ++lines;
  }
  return vertex;
}

/// Empty: none that is known. The order goes from marks that cannot be chance to those that can.
std::string format_of_content(std::string_view content) {
  const std::string_view text = skip_space(content);
  if (begins_with(text, "ISO-10303-21")) return "STEP";
  if (begins_with(text, "DBRep_DrawableShape") || begins_with(text, "CASCADE Topology")) return "BREP";
  if (begins_with(text, "ply\n") || begins_with(text, "ply\r")) return "PLY";
  if (is_binary_stl(content) || looks_text_stl(content)) return "STL";
  if (looks_iges(content)) return "IGES";
  if (looks_obj(content)) return "OBJ";
  return {};
}

/// STEP and IGES end with a mark; the kernel reads a file without it and leaves out what is missing.
void refuse_truncated(const std::string& file, const std::string& format, std::string_view content) {
  const std::string_view tail = content.substr(content.size() - std::min<std::size_t>(content.size(), 2000));
  if (format == "STEP" && tail.find("END-ISO-10303-21") == std::string_view::npos)
    throw InputError(
        file + ": is truncated (the closing line END-ISO-10303-21 is missing); export or copy the STEP file again");
  if (format != "IGES") return;
  const std::size_t last = tail.find_last_not_of(" \r\n\t\0");
  const std::size_t begin = last == std::string_view::npos ? last : tail.find_last_of("\r\n", last);
  const std::string_view line = begin == std::string_view::npos ? tail : tail.substr(begin + 1, last - begin);
  if (line.size() < 73 || line[72] != 'T')
    throw InputError(
        file + ": is truncated (the terminate line, T in column 73, is missing); export or copy the IGES file again");
}

}  // namespace

std::string read_bytes(const std::string& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw InputError(file + ": no such file; accepted: " + kAccepted);
  if (std::filesystem::is_directory(status)) throw InputError(file + ": is a folder; give a file: " + kAccepted);
  // A pipe would make us wait, a device may never end.
  if (!std::filesystem::is_regular_file(status))
    throw InputError(file + ": is a device or a pipe; give a file: " + kAccepted);
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file + ": cannot be opened; check its permissions");
  // At once: growing would hold a large file twice.
  std::string content(std::filesystem::file_size(file), '\0');
  in.read(content.data(), static_cast<std::streamsize>(content.size()));
  content.resize(static_cast<std::size_t>(in.gcount()));
  content.append(std::istreambuf_iterator<char>(in),
                 std::istreambuf_iterator<char>());  // files without a size have some
  if (in.bad()) throw InputError(file + ": cannot be read to its end");
  if (content.empty()) throw InputError(file + ": is empty; accepted: " + std::string(kAccepted));
  return content;
}

bool is_binary_stl(std::string_view content) {
  if (content.size() < 84) return false;
  std::uint32_t count = 0;
  std::memcpy(&count, content.data() + 80, sizeof count);
  // Header, count, and 50 bytes per facet: the size fits the count only in a binary STL.
  return content.size() == 84 + 50 * static_cast<std::size_t>(count);
}

std::string sniff_format(const std::string& file, std::string_view content) {
  const std::string claimed = format_of_extension(file);
  // What takes the place of large files in some repositories.
  if (begins_with(content, "version https://git-lfs.github.com/spec/"))
    throw InputError(file + ": is a Git LFS pointer, not the file; `git lfs pull` fetches the file");
  const std::string found = format_of_content(content);
  // A binary STL whose size is not what its count says has no other mark: believe the name, let the reader name the
  // sizes.
  if (found.empty() && claimed == "STL") return claimed;
  if (found.empty())
    throw InputError(file + ": the content is not " + claimed + " as the name says; accepted: " + kAccepted);
  if (found != claimed)
    throw InputError(file + ": the name says " + claimed + " but the content is " + found + "; rename it to match");
  refuse_truncated(file, found, content);
  return found;
}

std::vector<long> undefined_step_references(const std::string& content) {
  std::unordered_set<long> defined, used;
  bool in_string = false;
  for (std::size_t i = content.find("DATA;"); i < content.size(); ++i) {
    const char c = content[i];
    if (!in_string && content.compare(i, 2, "/*") == 0) {
      // A comment may hold an apostrophe, or a # that refers to nothing.
      i = std::min(content.find("*/", i + 2), content.size() - 2) + 1;
      continue;
    }
    if (c == '\'') in_string = !in_string;
    if (in_string || c != '#') continue;
    long id = 0;
    std::size_t k = i + 1;
    for (; k < content.size() && std::isdigit(static_cast<unsigned char>(content[k])); ++k)
      id = std::min(10 * id + (content[k] - '0'), kLargestStepId);
    while (k < content.size() && std::isspace(static_cast<unsigned char>(content[k]))) ++k;
    (k < content.size() && content[k] == '=' ? defined : used).insert(id);
  }
  std::vector<long> lost;
  for (const long id : used)
    if (!defined.contains(id)) lost.push_back(id);
  std::sort(lost.begin(), lost.end());
  return lost;
}

}  // namespace flank::internal
