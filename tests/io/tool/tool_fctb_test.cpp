// tool.fctb: the words that FreeCAD reads, and shapes that hold the tool.
#include "flank/io/tool/tool_fctb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "flank/error.h"

namespace flank::internal {
namespace {

using nlohmann::json;

Tool tool_of(ToolFamily family, double length, const std::vector<double>& parameters) {
  Tool tool;
  tool.radial = RadialFunction(
      family, length,
      Eigen::Map<const Eigen::VectorXd>(parameters.data(), static_cast<Eigen::Index>(parameters.size())));
  return tool;
}

double number(const json& bit, const char* name) { return std::stod(bit.at("parameter").at(name).get<std::string>()); }

/// Radius of the bit's cutting part at a height above its lowest point.
double radius_at(const json& bit, double height) {
  const double wide = 0.5 * number(bit, "Diameter");
  if (bit.at("shape") == "endmill.fcstd") return wide;
  if (bit.at("shape") == "ballend.fcstd")
    return height < wide ? std::sqrt(std::max(0.0, height * (2.0 * wide - height))) : wide;
  return 0.5 * number(bit, "TipDiameter") +
         height * std::tan(0.5 * number(bit, "CuttingEdgeAngle") * std::numbers::pi / 180.0);
}

/// How much room the bit leaves around the tool: least and largest.
std::pair<double, double> room(const json& bit, const Tool& tool) {
  double least = 1e300, most = -1e300;
  for (const Vec2& p : meridian(tool.radial, 500)) {
    const double gap = radius_at(bit, p.x() + tool.radial.at(0.0).r) - p.y();
    least = std::min(least, gap), most = std::max(most, gap);
  }
  return {least, most};
}

TEST(ToolFctb, ACylinderIsABallEnd) {
  Tool tool = tool_of(ToolFamily::kCylinder, 20.0, {4.0});
  tool.name = "a \"ball\"";
  tool.shank = {{20.0, 3.0}, {50.0, 3.0}};
  const json bit = json::parse(tool_to_fctb(tool));
  EXPECT_EQ(bit.at("version"), 2);
  EXPECT_EQ(bit.at("name"), tool.name);
  EXPECT_EQ(bit.at("shape"), "ballend.fcstd");
  EXPECT_TRUE(bit.at("attribute").is_object());
  EXPECT_EQ(bit.at("parameter"), (json{{"CuttingEdgeHeight", "24.000000 mm"},
                                       {"Diameter", "8.000000 mm"},
                                       {"Length", "54.000000 mm"},
                                       {"ShankDiameter", "6.000000 mm"}}));
  EXPECT_NE(bit.at("note").get<std::string>().find("exactly"), std::string::npos);
}

TEST(ToolFctb, AConeIsATruncatedCone) {
  const Tool tool = tool_of(ToolFamily::kCone, 30.0, {2.0, 0.15});
  const json bit = json::parse(tool_to_fctb(tool));
  EXPECT_EQ(bit.at("shape"), "chamfer.fcstd");
  EXPECT_NEAR(number(bit, "CuttingEdgeAngle"), 2.0 * 0.15 * 180.0 / std::numbers::pi, 1e-5);
  const auto [least, most] = room(bit, tool);
  EXPECT_NEAR(least, 0.0, 1e-5);
  EXPECT_NEAR(most, 0.0, 1e-5);
  EXPECT_NE(bit.at("note").get<std::string>().find("tool.step"), std::string::npos);
}

TEST(ToolFctb, EverythingElseIsEnclosed) {
  for (const Tool& tool :
       {tool_of(ToolFamily::kBarrel, 24.0, {85.0, 5.0, 10.0}), tool_of(ToolFamily::kBarrel, 24.0, {-60.0, 5.0, 10.0}),
        tool_of(ToolFamily::kCone, 10.0, {4.0, -0.2}), tool_of(ToolFamily::kHyperbolic, 25.0, {5.0, 0.1, 0.004})}) {
    const json bit = json::parse(tool_to_fctb(tool));
    const auto [least, most] = room(bit, tool);
    EXPECT_GE(least, -1e-5) << bit;
    EXPECT_LE(most, 2.5) << bit;
    EXPECT_NE(bit.at("note").get<std::string>().find("encloses"), std::string::npos) << bit;
    EXPECT_GT(number(bit, "Length"), number(bit, "CuttingEdgeHeight"));
  }
}

TEST(ToolFctb, RefusesWhatIsNoTool) {
  EXPECT_THROW((void)tool_to_fctb(tool_of(ToolFamily::kBarrel, 24.0, {3.0, 5.0, 10.0})), InputError);
}

}  // namespace
}  // namespace flank::internal
