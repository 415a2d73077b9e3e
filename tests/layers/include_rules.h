/// The rules of the house that a compiler does not check: which room may include which, what the front door shows, where
/// third parties may show, how files, folders and namespaces are named, and how many there may be.
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "layers/layer_table.h"
#include "layers/source_tree.h"

namespace flank::layers {

/// Of a room below src: more than anybody reads in an afternoon, and more than one concept.
inline constexpr int kMostLinesInARoom = 3600;
/// What a user reads through, and what our own command needs beside: printable, machine, inspect, example, tool_command,
/// cad_process, sweep, wheel_request.
inline constexpr int kMostFrontDoorHeaders = 39;
/// Of all of apps: the command is on its way out of the house. No more than there are may come back; examples have none.
inline constexpr int kMostInternalIncludesOfApps = 22;

/// Checks the tree below `root` against a table. Every violation is one sentence "file:line: what".
class TreeCheck {
 public:
  TreeCheck(fs::path root, LayerTable table) : root_(std::move(root)), table_(std::move(table)) {}

  [[nodiscard]] std::vector<std::string> violations() {
    found_.clear();
    modules_.clear();
    used_.clear();
    front_used_.clear();
    for (const fs::path& file : sources_below(root_ / "include/flank")) check_front_door_file(file);
    for (const fs::path& file : sources_below(root_ / "src/flank")) check_room_file(file);
    internal_of_apps_ = 0;
    for (const fs::path& file : sources_below(root_ / "apps")) check_app_file(file);
    if (internal_of_apps_ > kMostInternalIncludesOfApps)
      report(std::string("apps"), 1,
             std::to_string(internal_of_apps_) + " includes of internal headers; there are " +
                 std::to_string(kMostInternalIncludesOfApps));
    for (const fs::path& file : sources_below(root_ / "examples"))
      for (const Include& include : includes_of(file))
        if (include.path.starts_with("flank/") && !is_front_door(include.path))
          report(file, include.line, include.path + " is not of the front door");
    for (const char* folder : {"tests", "bench"})
      for (const fs::path& file : sources_below(root_ / folder)) add_to_modules(file, includes_of(file));
    check_circles();
    check_counts();
    check_unused();
    check_front_door_list();
    return found_;
  }

 private:
  [[nodiscard]] std::string name_of(const fs::path& file) const { return fs::relative(file, root_).generic_string(); }

  void report(const std::string& file, int line, const std::string& what) {
    found_.push_back(file + ":" + std::to_string(line) + ": " + what);
  }
  void report(const fs::path& file, int line, const std::string& what) { report(name_of(file), line, what); }

  void check_room_file(const fs::path& file) {
    const std::string room = fs::relative(file.parent_path(), root_ / "src/flank").generic_string();
    if (!table_.rooms.contains(room)) return report(file, 1, "the folder " + room + " is not in layers.txt");
    const std::vector<Include> includes = includes_of(file);
    add_to_modules(file, includes);
    for (const Include& include : includes) {
      check_own(file, room, include);
      check_third_party(file, layer_of(room), include);
    }
    if (is_header(file)) {
      check_pragma_once(file);
      check_namespaces(file, "flank::internal", true);
    } else {
      check_own_header(file, room, includes);
    }
  }

  /// The front door shows nothing but itself, the standard library and Eigen.
  void check_front_door_file(const fs::path& file) {
    const std::vector<Include> includes = includes_of(file);
    const std::string name = file.stem().string();
    add_to_modules(file, includes);
    if (!is_header(file)) return report(file, 1, "the front door has headers only");
    if (name == "flank") return check_umbrella(file, includes);
    if (!table_.front_door.contains(name)) return report(file, 1, "the header " + name + " is not in layers.txt");
    check_pragma_once(file);
    check_namespaces(file, "flank", false);
    for (const Include& include : includes) {
      const bool standard = !include.quoted && include.path.find_first_of("./") == std::string::npos;
      if (standard || include.path.starts_with("Eigen/")) continue;
      if (!is_front_door(include.path)) {
        report(file, include.line,
               include.path + " is neither of the front door nor of the standard library nor of Eigen");
      } else {
        check_front_door_order(file, table_.front_door.at(name), include);
      }
    }
  }

  /// flank.h belongs to no layer: it includes every other header of the front door and nothing else.
  void check_umbrella(const fs::path& file, const std::vector<Include>& includes) {
    std::set<std::string> missing;
    for (const auto& [header, unused] : table_.front_door) missing.insert("flank/" + header + ".h");
    for (const Include& include : includes)
      if (missing.erase(include.path) == 0) report(file, include.line, include.path + " is not of the front door");
    for (const std::string& header : missing) report(file, 1, "all of the front door is in it, but for " + header);
  }

  /// A header of one layer includes headers of another only if a room of the one may look into the other.
  void check_front_door_order(const fs::path& file, const std::string& layer, const Include& include) {
    check_exists(file, include);
    const auto other = table_.front_door.find(fs::path(include.path).stem().string());
    if (other == table_.front_door.end()) return;  // reported at the header itself
    front_used_[layer].insert(other->second);
    for (const auto& [room, unused] : table_.rooms)
      if (layer_of(room) == layer && table_.sees(room, other->second)) return;
    report(file, include.line, layer + " may not include " + include.path + " of " + other->second);
  }

  void check_app_file(const fs::path& file) {
    const std::vector<Include> includes = includes_of(file);
    add_to_modules(file, includes);
    for (const Include& include : includes) {
      if (include.path.starts_with("flank/")) check_exists(file, include);
      if (include.path.starts_with("flank/") && !is_front_door(include.path)) ++internal_of_apps_;
      if (is_cad_kernel(include.path)) report(file, include.line, "the CAD kernel's " + include.path + " outside io");
    }
    if (is_header(file)) check_namespaces(file, "flank::cli", false);
  }

  void check_exists(const fs::path& file, const Include& include) {
    // version.h is made from version.h.in.
    for (const char* place : {"src/", "include/"})
      for (const char* ending : {"", ".in"})
        if (fs::exists(root_ / (place + include.path + ending))) return;
    report(file, include.line, "there is no " + include.path);
  }

  /// "flank/vec.h", but not "flank/geom/bvh.h".
  static bool is_front_door(const std::string& path) {
    return path.starts_with("flank/") && path.find('/', 6) == std::string::npos;
  }

  /// Our own headers: by their full path, from this room, from one that the table allows, or from the front door of a
  /// layer that the room may look into.
  void check_own(const fs::path& file, const std::string& room, const Include& include) {
    if (!include.path.starts_with("flank/")) {
      if (include.quoted) report(file, include.line, "\"" + include.path + "\" is not a path below src (flank/...)");
      return;
    }
    check_exists(file, include);
    if (is_front_door(include.path)) {
      const auto layer = table_.front_door.find(fs::path(include.path).stem().string());
      if (layer == table_.front_door.end()) return;
      used_[room].insert(layer->second);
      if (table_.sees(room, layer->second)) return;
      return report(file, include.line, room + " may not include " + include.path + " of " + layer->second);
    }
    const std::string other = fs::path(include.path.substr(6)).parent_path().generic_string();
    used_[room].insert(other);
    if (other == room || table_.rooms.at(room).contains(other)) return;
    report(file, include.line,
           room + " may not include " + other + (table_.rooms.contains(other) ? "" : ", an unknown folder"));
  }

  /// Open CASCADE stays in io; headers show the standard library and Eigen, except internal ones that say so in their
  /// name.
  void check_third_party(const fs::path& file, const std::string& layer, const Include& include) {
    const std::string name = file.stem().string();
    if (is_cad_kernel(include.path)) {
      if (layer != "io") report(file, include.line, "the CAD kernel's " + include.path + " outside io");
      if (is_header(file) && name.find("occt") == std::string::npos) {
        report(file, include.line, include.path + " in a header that is not named for it (..occt..)");
      }
    }
    if (include.path.starts_with("tbb/") || include.path.starts_with("oneapi/")) {
      if (layer != "base") report(file, include.line, include.path + " outside base: use base/parallel.h");
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

  /// Every namespace that a header opens is written in full: `wanted`, or, where that is allowed, one inside it.
  void check_namespaces(const fs::path& file, const std::string& wanted, bool or_inside) {
    for (const OpenedNamespace& opened : namespaces_of(file)) {
      if (opened.name == wanted || (or_inside && opened.name.starts_with(wanted + "::"))) continue;
      report(file, opened.line,
             "opens namespace " + (opened.name.empty() ? "without a name" : opened.name) + "; here it is " + wanted +
                 (or_inside ? " or one inside it" : ""));
    }
  }

  /// A source has a header of its own name, beside it or in the front door of its layer, so that what is declared there is
  /// found. It includes that header first, which proves that the header needs nothing before it.
  void check_own_header(const fs::path& file, const std::string& room, const std::vector<Include>& includes) {
    const std::string stem = file.stem().string();
    const auto front = table_.front_door.find(stem);
    std::string wanted;
    if (fs::exists(fs::path(file).replace_extension(".h"))) {
      wanted = "flank/" + room + "/" + stem + ".h";
    } else if (front != table_.front_door.end() && front->second == layer_of(room)) {
      wanted = "flank/" + stem + ".h";
    } else {
      return report(file, 1, "there is no header " + stem + ".h for it");
    }
    if (includes.empty() || includes.front().path != wanted) {
      report(file, includes.empty() ? 1 : includes.front().line, "the first include is not " + wanted);
    }
  }

  /// A module is a header and the source of its name beside it: "src/flank/geom/bvh".
  void add_to_modules(const fs::path& file, const std::vector<Include>& includes) {
    const std::string module = name_of(fs::path(file).replace_extension());
    std::set<std::string>& others = modules_[module];
    for (const Include& include : includes) {
      for (const fs::path& start :
           {root_ / "include", root_ / "src", root_ / "tests", root_ / "bench", file.parent_path()}) {
        if (!include.path.ends_with(".h") || !fs::exists(start / include.path)) continue;
        const std::string other = name_of((start / include.path).lexically_normal().replace_extension());
        if (other != module) others.insert(other);
        break;
      }
    }
  }

  void check_circles() {
    for (const std::vector<std::string>& circle : circles_of(modules_)) {
      std::string names;
      for (const std::string& name : circle) names += (names.empty() ? "" : " -> ") + name;
      report(circle.front() + ".h", 1, "a circle of files: " + names);
    }
  }

  /// The front door has a number of its own: all of it is one concept, and a user should be able to read it through.
  void check_counts() {
    const fs::path front_door = root_ / "include/flank";
    std::map<fs::path, int> lines;
    for (const fs::path& file : sources_below(root_ / "src"))
      lines[file.parent_path()] += static_cast<int>(read_lines(file).size());
    for (const auto& [room, count] : lines)
      if (count > kMostLinesInARoom)
        report(room, 1, std::to_string(count) + " lines; a room holds " + std::to_string(kMostLinesInARoom));
    int headers = 0;
    for (const fs::path& file : sources_below(front_door)) headers += is_header(file) ? 1 : 0;
    if (headers > kMostFrontDoorHeaders)
      report(front_door, 1,
             std::to_string(headers) + " headers; the front door holds " + std::to_string(kMostFrontDoorHeaders));
  }

  /// A line of layers.txt names what somebody in the room includes, and nothing more: a room by its name or by a header of the front
  /// door of its layer, all rooms of a layer where two of them are included.
  void check_unused() {
    for (const auto& [name, words] : table_.written) {
      const std::string& room = name;  // a lambda holds no part of a pair that was taken apart, says Clang
      if (sources_in(root_ / "src/flank" / room).empty()) continue;  // still to come
      std::set<std::string> used = used_[room];
      used.merge(std::set(front_used_[room]));  // the front door of a layer goes by the room of its name
      for (const std::string& word : words) {
        const std::string layer = layer_of(word);
        const bool all = word.ends_with("/*");
        const auto met = std::count_if(used.begin(), used.end(), [&](const std::string& other) {
          return all ? layer_of(other) == layer && other != room
                     : other == word || (other == layer && layer != layer_of(room));
        });
        if (met < (all ? 2 : 1))
          report(std::string("src/flank/layers.txt"), 1,
                 room + " may include " + word + ", and " + (all && met == 1 ? "includes one of them" : "does not"));
      }
    }
  }

  /// What layers.txt names must be there.
  void check_front_door_list() {
    const std::string table = "src/flank/layers.txt";
    for (const auto& [header, unused] : table_.front_door) {
      if (!fs::exists(root_ / "include/flank" / (header + ".h")) &&
          !fs::exists(root_ / "include/flank" / (header + ".h.in")))
        report(table, 1, "there is no include/flank/" + header + ".h");
    }
  }

  static bool is_cad_kernel(const std::string& path) { return path.ends_with(".hxx"); }

  fs::path root_;
  LayerTable table_;
  std::vector<std::string> found_;
  Graph modules_;
  int internal_of_apps_ = 0;
  std::map<std::string, std::set<std::string>>
      front_used_;  ///< by layer: those that its headers of the front door include
  std::map<std::string, std::set<std::string>>
      used_;  ///< by room: the rooms, and the layers of the front door, that it includes
};

}  // namespace flank::layers
