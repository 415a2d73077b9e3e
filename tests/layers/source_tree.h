/// The source tree as the rules see it: files, their includes, the namespaces that they open.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace flank::layers {

namespace fs = std::filesystem;

inline std::vector<std::string> read_lines(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// One #include line. Lines are counted from 1.
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
    if (line.find('#') == std::string::npos || !std::regex_match(line, match, kInclude)) continue;
    includes.push_back({number, match[2], match[1] == "\""});
  }
  return includes;
}

/// A namespace that a file opens, by the name that stands there; empty: one without a name.
struct OpenedNamespace {
  int line = 0;
  std::string name;
};

inline std::vector<OpenedNamespace> namespaces_of(const fs::path& file) {
  static const std::regex kOpened(R"((?:.*\W)?namespace\s*([\w:]*)\s*\{.*)");
  std::vector<OpenedNamespace> opened;
  int number = 0;
  for (const std::string& line : read_lines(file)) {
    ++number;
    std::smatch match;
    const std::string code = line.substr(0, line.find("//"));
    if (code.find("namespace") == std::string::npos || !std::regex_match(code, match, kOpened)) continue;
    opened.push_back({number, match[1]});
  }
  return opened;
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

/// Sources of a folder, those of its subfolders not among them.
inline std::vector<fs::path> sources_in(const fs::path& folder) {
  std::vector<fs::path> files = sources_below(folder);
  std::erase_if(files, [&](const fs::path& file) { return file.parent_path() != folder; });
  return files;
}

/// Who includes whom, by name.
using Graph = std::map<std::string, std::set<std::string>>;

/// The shortest circle through each name from which one leads back to it; the name stands at both ends. A name that is
/// in a circle already begins no other.
inline std::vector<std::vector<std::string>> circles_of(const Graph& graph) {
  std::set<std::string> done;
  std::vector<std::vector<std::string>> circles;
  for (const auto& [start, unused] : graph) {
    if (done.contains(start)) continue;
    std::map<std::string, std::string> came_from;
    std::vector<std::string> queue{start};
    for (std::size_t k = 0; k < queue.size() && !came_from.contains(start); ++k) {
      const auto here = graph.find(queue[k]);
      if (here == graph.end()) continue;
      for (const std::string& next : here->second) {
        if (came_from.try_emplace(next, queue[k]).second) queue.push_back(next);
      }
    }
    if (!came_from.contains(start)) continue;
    std::vector<std::string> circle{start};
    for (std::string at = came_from[start]; at != start; at = came_from[at]) circle.push_back(at);
    circle.push_back(start);
    std::reverse(circle.begin(), circle.end());
    done.insert(circle.begin(), circle.end());
    circles.push_back(std::move(circle));
  }
  return circles;
}

}  // namespace flank::layers
