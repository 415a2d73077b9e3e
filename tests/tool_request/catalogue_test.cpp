// Where the catalogue is, and what is refused.
#include "flank/tool_request/catalogue.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include "flank/error.h"
#include "flank/tool_file.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

class Catalogue : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) / ("flank_catalogue_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    ::unsetenv("FLANK_CATALOGUE");
  }
  void TearDown() override {
    ::unsetenv("FLANK_CATALOGUE");
    fs::remove_all(folder_);
  }
  void put(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  static std::string cylinder(double radius) {
    Tool tool;
    tool.radial = RadialFunction(ToolFamily::kCylinder, 10.0, Eigen::VectorXd::Constant(1, radius));
    return tool_to_json(tool);
  }
  static std::string refusal(const std::function<void()>& work) {
    try {
      work();
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  fs::path folder_;
};

TEST_F(Catalogue, ToolsComeByTheNamesOfTheirFiles) {
  put("b-4.json", cylinder(2.0));
  put("a-6.json", cylinder(3.0));
  put("README.md", "not a tool");
  const std::vector<CatalogueTool> tools = read_catalogue(folder_.string());
  ASSERT_EQ(tools.size(), 2u);
  EXPECT_EQ(tools[0].name, "a-6");
  EXPECT_EQ(tools[1].tool.radial.at(0.0).r, 2.0);
}

TEST_F(Catalogue, AFileThatIsNoToolIsNamed) {
  put("good.json", cylinder(2.0));
  put("broken.json", "{\"schema\": \"openflank/tool/1\", \"axis_length\": -3}");
  const std::string why = refusal([&] { (void)read_catalogue(folder_.string()); });
  EXPECT_NE(why.find("broken.json"), std::string::npos) << why;
  EXPECT_NE(why.find("axis_length"), std::string::npos) << why;
}

TEST_F(Catalogue, AFolderWithoutToolsIsNamed) {
  const std::string why = refusal([&] { (void)read_catalogue(folder_.string()); });
  EXPECT_NE(why.find(folder_.string() + ": no tool file"), std::string::npos) << why;
}

TEST_F(Catalogue, WhatIsAskedForComesFirst) {
  EXPECT_EQ(catalogue_folder(folder_.string()), folder_.string());
  ::setenv("FLANK_CATALOGUE", folder_.c_str(), 1);
  EXPECT_EQ(catalogue_folder({}), folder_.string());
  EXPECT_EQ(catalogue_folder("."), ".");
  ::setenv("FLANK_CATALOGUE", "/nowhere/at/all", 1);
  const std::string why = refusal([&] { (void)catalogue_folder({}); });
  EXPECT_NE(why.find("FLANK_CATALOGUE=/nowhere/at/all"), std::string::npos) << why;
  EXPECT_NE(refusal([&] { (void)catalogue_folder("/nowhere"); }).find("catalogue /nowhere"), std::string::npos);
}

TEST_F(Catalogue, TheOneThatComesWithTheProgramIsFound) {
  const std::vector<CatalogueTool> tools = read_catalogue(catalogue_folder({}));
  EXPECT_FALSE(tools.empty());
}

}  // namespace
}  // namespace flank::internal
