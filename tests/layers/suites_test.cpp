// Test suites: all files of a folder are one program, in which a suite has one fixture.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <string>

#include "layers/source_tree.h"

namespace flank::layers {
namespace {

TEST(Suites, HaveOneFixtureAndTestsOfDifferentNames) {
  static const std::regex kTest(R"((TEST|TEST_F|TEST_P)\((\w+),\s*(\w+)\).*)");
  std::map<std::string, std::set<std::string>> macros;  // of "folder Suite"
  std::map<std::string, std::string> names;             // file of "folder Suite.Name"
  for (const fs::path& file : sources_below(fs::path(FLANK_SOURCE_DIR) / "tests")) {
    const std::string folder = fs::relative(file, fs::path(FLANK_SOURCE_DIR) / "tests").begin()->string();
    for (const std::string& line : read_lines(file)) {
      std::smatch match;
      if (!std::regex_match(line, match, kTest)) continue;
      const std::string suite = folder + " " + match[2].str();
      macros[suite].insert(match[1]);
      const auto [other, fresh] = names.emplace(suite + "." + match[3].str(), file.string());
      EXPECT_TRUE(fresh) << other->first << " stands in " << other->second << " and in " << file;
    }
  }
  EXPECT_GT(macros.size(), 100u);
  for (const auto& [suite, used] : macros) EXPECT_EQ(used.size(), 1u) << suite << " is used with and without a fixture";
}

}  // namespace
}  // namespace flank::layers
