/// The file layers.txt: which room of the house may include which, where the headers of the front door belong, and what
/// breaks the rules for the time being.
#pragma once

#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

#include "layers/source_tree.h"

namespace flank::layers {

struct LayerTable {
  std::map<std::string, std::set<std::string>> written;  ///< room -> what stands in its line
  std::map<std::string, std::set<std::string>> rooms;    ///< room -> the rooms that it may include, besides itself
  std::map<std::string, std::string> front_door;         ///< stem of a header of include/flank -> its layer

  /// Whether the room may see the front-door headers of a layer: its own, and those of layers that it may look into.
  [[nodiscard]] bool sees(const std::string& room, const std::string& layer) const;
};

/// "io" of "io/cad".
inline std::string layer_of(const std::string& room) { return room.substr(0, room.find('/')); }

inline bool LayerTable::sees(const std::string& room, const std::string& layer) const {
  if (layer_of(room) == layer) return true;
  for (const std::string& other : rooms.at(room))
    if (layer_of(other) == layer) return true;
  return false;
}

inline std::set<std::string> split_words(const std::string& text) {
  std::istringstream in(text);
  std::set<std::string> words;
  for (std::string word; in >> word;) words.insert(word);
  return words;
}

/// Adds the line "room: rooms"; "io/*" is every room of io. Names only rooms of earlier lines, so there is no circle.
inline void add_room(LayerTable& table, const std::string& room, const std::set<std::string>& words) {
  std::set<std::string> allowed;
  for (const std::string& word : words) {
    const std::size_t before = allowed.size();
    if (word.ends_with("/*")) {
      for (const auto& [other, unused] : table.rooms)
        if (layer_of(other) == layer_of(word)) allowed.insert(other);
    } else if (table.rooms.contains(word)) {
      allowed.insert(word);
    }
    if (allowed.size() == before)
      throw std::runtime_error("'" + room + "' names " + word + ", which no earlier line defines");
  }
  if (table.rooms.contains(room)) throw std::runtime_error("two lines are about " + room);
  table.written[room] = words;
  table.rooms[room] = allowed;
}

inline void add_header(LayerTable& table, const std::string& header, const std::set<std::string>& words) {
  if (words.size() != 1) throw std::runtime_error("'" + header + "' belongs to one layer");
  for (const auto& [room, unused] : table.rooms) {
    if (layer_of(room) == *words.begin()) table.front_door[header] = *words.begin();
  }
  if (!table.front_door.contains(header))
    throw std::runtime_error("'" + header + "' names " + *words.begin() + ", which is no layer");
}

/// Sections [rooms] ("room: rooms") and [front door] ("header: layer"); # starts a comment.
inline LayerTable read_layer_table(const fs::path& file) {
  LayerTable table;
  std::string section;
  for (const std::string& line : read_lines(file)) {
    if (line.empty() || line.front() == '#') continue;
    if (line.front() == '[') {
      section = line;
      continue;
    }
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) throw std::runtime_error("no colon in '" + line + "'");
    const std::string name = line.substr(0, colon);
    const std::set<std::string> words = split_words(line.substr(colon + 1));
    if (section == "[rooms]") {
      add_room(table, name, words);
    } else if (section == "[front door]") {
      add_header(table, name, words);
    } else {
      throw std::runtime_error("'" + line + "' stands in no section that is known");
    }
  }
  return table;
}

/// The table of ARCHITECTURE.md: rows "| `room` | what it is | rooms |" (- for none).
inline std::map<std::string, std::set<std::string>> read_documented_table(const fs::path& file) {
  static const std::regex kRow(R"(\| `([\w/]+)` \|.*\| ([a-z_/* -]+) \|)");
  std::map<std::string, std::set<std::string>> table;
  for (const std::string& line : read_lines(file)) {
    std::smatch row;
    if (!std::regex_match(line, row, kRow)) continue;
    std::set<std::string> allowed = split_words(row[2]);
    allowed.erase("-");
    table[row[1]] = allowed;
  }
  return table;
}

}  // namespace flank::layers
