#include "flank/tool_command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "flank/error.h"
#include "flank/tool_file.h"
#include "flank/tool_request/tool_spec.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

std::string refusal(const std::string& spec) {
  try {
    (void)parse_tool_spec(spec);
  } catch (const UsageError& e) {
    return e.what();
  }
  return "accepted";
}

class ToolCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              (std::string("flank_tool_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() +
               std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

TEST(ToolSpec, ParsesTheDocumentedForms) {
  EXPECT_TRUE(parse_tool_spec("free").free);
  EXPECT_TRUE(parse_tool_spec("spline").free);
  const ToolSpec cone = parse_tool_spec("cone");
  ASSERT_TRUE(cone.family);
  EXPECT_EQ(*cone.family, ToolFamily::kCone);
  EXPECT_TRUE(cone.given.empty());
  EXPECT_FALSE(cone.complete());
  EXPECT_FALSE(cone.free);
  EXPECT_EQ(parse_tool_spec("cylinder:diameter=8").given.at("radius"), 4.0);
  EXPECT_TRUE(parse_tool_spec("cylinder:diameter=8").complete());
  const ToolSpec full = parse_tool_spec("cone:radius=2,angle=3");
  EXPECT_EQ(full.given.at("radius"), 2.0);
  EXPECT_NEAR(full.given.at("angle"), 3.0 * std::acos(-1.0) / 180.0, 1e-16);
  EXPECT_TRUE(full.complete());
  const ToolSpec barrel = parse_tool_spec("barrel:arc=85,radius=5");
  EXPECT_EQ(barrel.given.size(), 2u);
  EXPECT_FALSE(barrel.complete());
  EXPECT_EQ(*parse_tool_spec("Tapered_Barrel:arc=250").family, ToolFamily::kTaperedBarrel);
  EXPECT_EQ(parse_tool_spec("lens:end-diameter=8").given.at("end_radius"), 4.0);
}

TEST(ToolSpec, RefusesWithTheAcceptedNames) {
  for (const auto& [spec, expected] : std::vector<std::pair<std::string, std::string>>{
           {"", "accepted: free, cylinder, cone"},
           {"spoon", "tool spoon: neither a family nor a tool file; accepted: free, cylinder, cone, barrel"},
           {"cone:edge=3", "unknown parameter; a cone accepts radius, diameter, angle (degrees)"},
           {"cone:radius", "must be NAME=VALUE"},
           {"cone:", "must be NAME=VALUE"},
           {"cone:radius=2,", "must be NAME=VALUE"},
           {"cone:radius=two", "\"two\" is not a number"},
           {"cone:radius=nan", "not a number"},
           {"cone:radius=-2", "must be > 0"},
           {"cone:angle=90", "between -90 and 90"},
           {"cylinder:diameter=8,radius=4", "radius is given twice"},
           {"free:radius=3", "has no parameters"}}) {
    EXPECT_NE(refusal(spec).find(expected), std::string::npos) << refusal(spec) << "\n for " << spec;
    EXPECT_EQ(refusal(spec).rfind("tool ", 0), 0u) << refusal(spec);
  }
  EXPECT_THROW((void)parse_tool_spec("no/such.json"), InputError);
  EXPECT_THROW((void)parse_tool_spec("missing.json"), InputError);
}

TEST(MakeTool, NeedsEveryParameterButTheBarrelsMiddle) {
  const Tool barrel = make_tool(ToolFamily::kBarrel, {{"arc", 85.0}, {"radius", 5.0}}, 30.0);
  EXPECT_EQ(barrel.radial.parameters()[2], 15.0);
  EXPECT_EQ(barrel.radial.axis_length(), 30.0);
  const auto message = [](ToolFamily family, const std::map<std::string, double>& given, double length) -> std::string {
    try {
      (void)make_tool(family, given, length);
    } catch (const UsageError& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_NE(message(ToolFamily::kCone, {{"radius", 2.0}}, 30.0).find("angle not given"), std::string::npos);
  EXPECT_NE(message(ToolFamily::kCylinder, {{"radius", 2.0}, {"arc", 3.0}}, 30.0).find("unknown parameter arc"),
            std::string::npos);
  EXPECT_NE(message(ToolFamily::kCylinder, {{"radius", 2.0}}, -1.0).find("axis_length_mm"), std::string::npos);
  EXPECT_NE(message(ToolFamily::kCone, {{"radius", 1.0}, {"angle", -0.1}}, 30.0).find("not a tool, r = "),
            std::string::npos);
  EXPECT_NE(message(ToolFamily::kSpline, {}, 30.0).find("tool.json"), std::string::npos);
}

TEST_F(ToolCommand, WritesEveryFormatAndReadsItsOwn) {
  ToolCommandOptions options;
  options.source = "barrel";
  options.parameters = {"arc=85", "radius=5"};
  options.axis_length_mm = 30.0;
  options.shank_diameter_mm = 8.0;
  options.outputs = {file("a.json"), file("a.dxf"), file("a.svg"), file("a.csv")};
  const Tool made = run_tool_command(options);
  EXPECT_EQ(made.radial.axis_length(), 30.0);
  for (const std::string& name : options.outputs) EXPECT_GT(fs::file_size(name), 1000u) << name;
  ToolCommandOptions convert;
  convert.source = file("a.json");
  convert.outputs = {file("b.json"), file("b.dxf")};
  run_tool_command(convert);
  for (const char* ending : {".json", ".dxf"}) {
    std::ifstream a(file(std::string("a") + ending)), b(file(std::string("b") + ending));
    std::stringstream first, second;
    first << a.rdbuf();
    second << b.rdbuf();
    EXPECT_EQ(first.str(), second.str()) << ending;
  }
  convert.source = file("a.dxf");
  convert.axis_length_mm = 30.0;
  convert.outputs = {file("c.json")};
  run_tool_command(convert);
  const Tool truth = read_tool(file("a.json")), read = read_tool(file("c.json"));
  for (double s = 0.0; s <= 30.0; s += 0.5) EXPECT_NEAR(read.radial.at(s).r, truth.radial.at(s).r, 1e-8);
}

TEST_F(ToolCommand, ToldInJson) {
  ToolCommandOptions options;
  options.source = "cone:radius=2,angle=3";
  const auto json = nlohmann::json::parse(tool_summary_json(run_tool_command(options), {"a \"quoted\" name.json"}));
  EXPECT_EQ(json.at("family"), "cone");
  EXPECT_EQ(json.at("axis_length_mm"), kDefaultToolLengthMm);
  EXPECT_EQ(json.at("radius_min_mm"), 2.0);
  EXPECT_NEAR(json.at("radius_max_mm").get<double>(), 2.0 + 30.0 * std::sin(3.0 * std::acos(-1.0) / 180.0), 0.01);
  EXPECT_EQ(json.at("files").at(0), "a \"quoted\" name.json");
}

TEST_F(ToolCommand, RefusesBeforeItWrites) {
  ToolCommandOptions options;
  options.source = "cylinder:radius=4";
  options.outputs = {file("a.json"), file("a.exe")};
  EXPECT_THROW(run_tool_command(options), UsageError);
  EXPECT_FALSE(fs::exists(file("a.json")));
  options.outputs = {file("no/such/folder/a.json")};
  EXPECT_THROW(run_tool_command(options), InputError);
  options.outputs.clear();
  options.axis_length_mm = NAN;
  EXPECT_THROW(run_tool_command(options), UsageError);
  options.axis_length_mm.reset();
  options.source = "free";
  EXPECT_THROW(run_tool_command(options), UsageError);
  options.source = "nothing.json";
  EXPECT_THROW(run_tool_command(options), InputError);
  options.parameters = {"radius=3"};
  EXPECT_THROW(run_tool_command(options), UsageError);
}

}  // namespace
}  // namespace flank::internal
