/// Group codes and values of a DXF text, read in the plainest way.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace flank::internal::testing_io {

struct DxfGroup {
  int code = 0;
  std::string value;
};

inline std::vector<DxfGroup> dxf_groups(const std::string& text) {
  std::vector<DxfGroup> groups;
  std::istringstream lines(text);
  for (std::string code, value; std::getline(lines, code) && std::getline(lines, value);)
    groups.push_back({std::stoi(code), value});
  return groups;
}

/// What follows a 0 up to the next one; of several values of a code the last counts.
struct DxfEntity {
  std::string name;
  std::map<int, std::string> values;

  [[nodiscard]] double number(int code) const { return std::stod(values.at(code)); }
};

inline std::vector<DxfEntity> dxf_entities(const std::string& text) {
  std::vector<DxfEntity> entities;
  for (const DxfGroup& group : dxf_groups(text)) {
    if (group.code == 0)
      entities.push_back({group.value, {}});
    else if (!entities.empty())
      entities.back().values[group.code] = group.value;
  }
  return entities;
}

inline std::vector<DxfEntity> named(const std::vector<DxfEntity>& all, const std::string& name) {
  std::vector<DxfEntity> found;
  for (const DxfEntity& e : all)
    if (e.name == name) found.push_back(e);
  return found;
}

}  // namespace flank::internal::testing_io
