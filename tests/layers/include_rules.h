/// The rules of the source tree that a compiler does not check: which folder may include which, and where third parties
/// may show.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace flank::layers {

namespace fs = std::filesystem;

/// Folder of src/flank -> the folders that it may include, besides itself.
using LayerTable = std::map<std::string, std::set<std::string>>;

inline std::vector<std::string> read_lines(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

inline std::set<std::string> split_words(const std::string& text) {
  std::istringstream in(text);
  std::set<std::string> words;
  for (std::string word; in >> word;) words.insert(word);
  return words;
}

/// Lines "folder: folder folder"; # starts a comment. A folder may name only folders of earlier lines, so the table has
/// no cycle.
inline LayerTable read_layer_table(const fs::path& file) {
  LayerTable table;
  for (const std::string& line : read_lines(file)) {
    if (line.empty() || line.front() == '#') continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) throw std::runtime_error("no colon in '" + line + "'");
    const std::set<std::string> allowed = split_words(line.substr(colon + 1));
    for (const std::string& name : allowed) {
      if (!table.contains(name))
        throw std::runtime_error("'" + line + "' names " + name + ", which no earlier line defines");
    }
    table[line.substr(0, colon)] = allowed;
  }
  return table;
}

/// The table of ARCHITECTURE.md: rows "| `folder` | what it is | folders |" (- for none).
inline LayerTable read_documented_table(const fs::path& file) {
  static const std::regex kRow(R"(\| `(\w+)` \|.*\| ([a-z -]+) \|)");
  LayerTable table;
  for (const std::string& line : read_lines(file)) {
    std::smatch row;
    if (!std::regex_match(line, row, kRow)) continue;
    std::set<std::string> allowed = split_words(row[2]);
    allowed.erase("-");
    table[row[1]] = allowed;
  }
  return table;
}

struct Include {
  int line = 0;
  std::string path;
  bool quoted = false;
};

inline std::vector<Include> includes_of(const fs::path& file) {
  static const std::regex kInclude(R"re(\s*#\s*include\s*([<"])([^>"]+)[>"].*)re");
  std::vector<Include> includes;
  int number = 0;
  for (const std::string& line : read_lines(file)) {
    ++number;
    std::smatch match;
    if (std::regex_match(line, match, kInclude)) includes.push_back({number, match[2], match[1] == "\""});
  }
  return includes;
}

inline bool is_header(const fs::path& file) { return file.extension() == ".h"; }
inline bool is_source(const fs::path& file) { return is_header(file) || file.extension() == ".cpp"; }

/// Sources below a folder, sorted; none if there is no such folder.
inline std::vector<fs::path> sources_below(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && is_source(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Checks a tree `root`/src/flank and `root`/apps against a table. Every violation is one sentence "file:line: what".
class TreeCheck {
 public:
  TreeCheck(fs::path root, LayerTable table) : root_(std::move(root)), table_(std::move(table)) {}

  [[nodiscard]] std::vector<std::string> violations() {
    found_.clear();
    for (const fs::path& file : sources_below(root_ / "src/flank")) check_layer_file(file);
    for (const fs::path& file : sources_below(root_ / "apps")) check_app_file(file);
    return found_;
  }

 private:
  void report(const fs::path& file, int line, const std::string& what) {
    found_.push_back(fs::relative(file, root_).string() + ":" + std::to_string(line) + ": " + what);
  }

  void check_layer_file(const fs::path& file) {
    const std::string folder = fs::relative(file, root_ / "src/flank").begin()->string();
    if (!table_.contains(folder)) return report(file, 1, "the folder " + folder + " is not in layers.txt");
    const std::vector<Include> includes = includes_of(file);
    for (const Include& include : includes) {
      check_own(file, folder, include);
      check_third_party(file, folder, include);
    }
    if (is_header(file)) {
      check_pragma_once(file);
    } else {
      check_own_header_first(file, includes);
    }
  }

  void check_app_file(const fs::path& file) {
    for (const Include& include : includes_of(file)) {
      if (include.path.starts_with("flank/")) check_exists(file, include);
      if (is_cad_kernel(include.path)) report(file, include.line, "the CAD kernel's " + include.path + " outside io");
    }
  }

  void check_exists(const fs::path& file, const Include& include) {
    if (!fs::exists(root_ / "src" / include.path)) report(file, include.line, "there is no " + include.path);
  }

  /// Our own headers: by their full path, from this folder or one that the table allows.
  void check_own(const fs::path& file, const std::string& folder, const Include& include) {
    if (!include.path.starts_with("flank/")) {
      if (include.quoted) report(file, include.line, "\"" + include.path + "\" is not a path below src (flank/...)");
      return;
    }
    check_exists(file, include);
    const std::string other = std::next(fs::path(include.path).begin())->string();
    if (other == folder || table_.at(folder).contains(other)) return;
    report(file, include.line,
           folder + " may not include " + other + (table_.contains(other) ? "" : ", an unknown folder"));
  }

  /// Open CASCADE stays in io; headers show the standard library and Eigen, except internal ones that say so in their
  /// name.
  void check_third_party(const fs::path& file, const std::string& folder, const Include& include) {
    const std::string name = file.stem().string();
    if (is_cad_kernel(include.path)) {
      if (folder != "io") report(file, include.line, "the CAD kernel's " + include.path + " outside io");
      if (is_header(file) && name.find("occt") == std::string::npos) {
        report(file, include.line, include.path + " in a header that is not named for it (..occt..)");
      }
    }
    if (include.path.starts_with("tbb/") || include.path.starts_with("oneapi/")) {
      if (folder != "base") report(file, include.line, include.path + " outside base: use base/parallel.h");
    }
    if (!is_header(file)) return;
    if (include.path.starts_with("nlohmann/") && name.find("json") == std::string::npos) {
      report(file, include.line, include.path + " in a header that is not named for it (..json..)");
    }
    for (const char* library : {"tbb/", "oneapi/", "fmt/", "CLI/", "spdlog/", "embree3/", "benchmark/", "gtest/"}) {
      if (include.path.starts_with(library)) report(file, include.line, include.path + " in a header");
    }
  }

  void check_pragma_once(const fs::path& file) {
    const std::vector<std::string> lines = read_lines(file);
    if (std::find(lines.begin(), lines.end(), "#pragma once") == lines.end()) report(file, 1, "no #pragma once");
  }

  /// A source that includes its own header first proves that the header needs nothing before it.
  void check_own_header_first(const fs::path& file, const std::vector<Include>& includes) {
    fs::path header = file;
    header.replace_extension(".h");
    if (!fs::exists(header)) return;
    const std::string wanted = fs::relative(header, root_ / "src").string();
    if (includes.empty() || includes.front().path != wanted) {
      report(file, includes.empty() ? 1 : includes.front().line, "the first include is not " + wanted);
    }
  }

  static bool is_cad_kernel(const std::string& path) { return path.ends_with(".hxx"); }

  fs::path root_;
  LayerTable table_;
  std::vector<std::string> found_;
};

}  // namespace flank::layers
