// Every tool of share/catalogue reads, is legitimate, and has its source told.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "flank/io/tool_json.h"

namespace flank {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(FLANK_SOURCE_DIR) / "share" / "catalogue";

std::vector<fs::path> catalogue_files() {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(kFolder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string readme() {
  std::ostringstream text;
  text << std::ifstream(kFolder / "README.md").rdbuf();
  return text.str();
}

TEST(Catalogue, EveryToolReadsAndIsLegitimate) {
  const std::vector<fs::path> files = catalogue_files();
  ASSERT_FALSE(files.empty());
  for (const fs::path& file : files) {
    const Tool tool = read_tool(file.string());
    const Legitimacy verdict = check_legitimacy(tool.radial);
    EXPECT_TRUE(verdict.legitimate) << file << ": " << verdict.reason;
    EXPECT_FALSE(tool.name.empty()) << file;
    EXPECT_FALSE(tool.shank.empty()) << file;
  }
}

TEST(Catalogue, EveryToolHasARowWithItsSource) {
  const std::string text = readme();
  for (const fs::path& file : catalogue_files()) {
    const std::size_t row = text.find("| `" + file.filename().string() + "` |");
    ASSERT_NE(row, std::string::npos) << file;
    EXPECT_NE(text.substr(row, text.find('\n', row) - row).find("https://"), std::string::npos) << file;
  }
}

/// The published figures come back from the file: tip to top of the cutting length, diameter, overall length.
TEST(Catalogue, ABallNosedMillHasItsPublishedFigures) {
  const Tool tool = read_tool((kFolder / "dormer-s239-ball-4.json").string());
  const double radius = tool.radial.at(0.0).r;
  EXPECT_EQ(2.0 * radius, 4.0);
  EXPECT_EQ(radius + tool.radial.axis_length(), 14.0);
  EXPECT_EQ(radius + tool.shank.back().x(), 50.0);
}

}  // namespace
}  // namespace flank
