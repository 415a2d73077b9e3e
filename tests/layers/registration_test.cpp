/// What is registered by a row is named in few files: a second list of them would have to be found by whoever adds one.
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "layers/source_tree.h"

namespace flank::layers {
namespace {

/// Files below the root's code that are called by the name or hold it outside of comments; tests and documents do not count.
std::vector<std::string> files_that_name(const std::string& name) {
  const fs::path root = FLANK_SOURCE_DIR;
  const std::regex word("(^|[^A-Za-z])" + name + "($|[^a-z])", std::regex::icase);
  std::vector<std::string> files;
  for (const char* folder : {"src", "include", "python/binding", "web/src", "apps"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const fs::path& file = entry.path();
      if (!entry.is_regular_file() || (!is_source(file) && file.extension() != ".js")) continue;
      bool named = std::regex_search(file.stem().string(), word);
      for (const std::string& line : read_lines(file))
        named = named || std::regex_search(line.substr(0, line.find("//")), word);
      if (named) files.push_back(fs::relative(file, root).generic_string());
    }
  return files;
}

void expect_few(const std::string& name) {
  const std::vector<std::string> files = files_that_name(name);
  std::string text;
  for (const std::string& file : files) text += "  " + file + "\n";
  EXPECT_FALSE(files.empty()) << name;
  EXPECT_LE(files.size(), 4u) << name << " stands in\n" << text;
}

TEST(Registration, AMeshFormatIsNamedInFourFiles) {
  expect_few("ply");
  expect_few("obj");
}

TEST(Registration, ADialectIsNamedInFourFiles) { expect_few("k?fanuc(row)?"); }

TEST(Registration, AToolFamilyIsNamedInFourFiles) {
  expect_few("(k?tapered-?barrel)");
  expect_few("k?hyperbolic");
}

}  // namespace
}  // namespace flank::layers
