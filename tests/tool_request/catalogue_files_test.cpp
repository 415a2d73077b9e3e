// Every tool of share/catalogue reads, is legitimate, and has its source told.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "flank/tool_file.h"

namespace flank::internal {
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

TEST(CatalogueFiles, EveryToolReadsAndIsLegitimate) {
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

TEST(CatalogueFiles, EveryToolHasARowWithItsSource) {
  const std::string text = readme();
  for (const fs::path& file : catalogue_files()) {
    const std::size_t row = text.find("| `" + file.filename().string() + "` |");
    ASSERT_NE(row, std::string::npos) << file;
    EXPECT_NE(text.substr(row, text.find('\n', row) - row).find("https://"), std::string::npos) << file;
  }
}

/// The published figures come back from the file: tip to top of the cutting length, diameter, overall length.
TEST(CatalogueFiles, ABallNosedMillHasItsPublishedFigures) {
  const Tool tool = read_tool((kFolder / "dormer-s239-ball-4.json").string());
  const double radius = tool.radial.at(0.0).r;
  EXPECT_EQ(2.0 * radius, 4.0);
  EXPECT_EQ(radius + tool.radial.axis_length(), 14.0);
  EXPECT_EQ(radius + tool.shank.back().x(), 50.0);
}

/// Height above the tip and radius of the flank's profile at its upper end, and the overall length.
struct Figures {
  double cutting_length, top_radius, overall;
};

Figures figures_of(const char* file) {
  const Tool tool = read_tool((kFolder / file).string());
  const double tip = tool.radial.at(0.0).r, length = tool.radial.axis_length();
  const RadialJet top = tool.radial.at(length);
  return {tip + length - top.r * top.d1, top.r * std::sqrt(1.0 - top.d1 * top.d1), tip + tool.shank.back().x()};
}

/// APMX 2 inch, OAL 4 inch; R 1/8 inch and 3 degrees a side.
TEST(CatalogueFiles, ATaperedBallNosedMillHasItsPublishedFigures) {
  const Figures found = figures_of("amana-46283-cone.json");
  EXPECT_NEAR(found.cutting_length, 50.8, 1e-6);
  EXPECT_NEAR(found.overall, 101.6, 1e-6);
  const double angle = 3.0 * std::numbers::pi / 180.0;
  const double rise = (50.8 - 3.175 * (1.0 - std::sin(angle))) * std::tan(angle);
  EXPECT_NEAR(found.top_radius, 3.175 * std::cos(angle) + rise, 1e-5);
}

/// DC 16, APMX 12.5, OAL 90 mm; arc 1000 mm, 27 degrees in the middle.
TEST(CatalogueFiles, ATaperedBarrelHasItsPublishedFigures) {
  const Figures found = figures_of("garant-207534-tapered-barrel-16-1000.json");
  EXPECT_NEAR(found.cutting_length, 12.5, 1e-5);
  EXPECT_NEAR(found.top_radius, 8.0, 1e-5);
  EXPECT_NEAR(found.overall, 90.0, 1e-5);
  const Tool tool = read_tool((kFolder / "garant-207534-tapered-barrel-16-1000.json").string());
  EXPECT_NEAR(tool.radial.at(0.5 * tool.radial.axis_length()).d1, std::sin(27.0 * std::numbers::pi / 180.0), 1e-8);
}

}  // namespace
}  // namespace flank::internal
