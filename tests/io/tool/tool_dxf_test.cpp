#include "flank/io/tool/tool_dxf.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "flank/base/random.h"
#include "flank/error.h"
#include "flank/io/tool/tool_dxf_read.h"
#include "flank/io/tool/tool_svg.h"

namespace flank::internal {
namespace {

Tool barrel() {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kBarrel, 24.0, Eigen::Vector3d(85, 5, 10));
  tool.name = "a < b & c";
  tool.shank = {{24.0, 4.0}, {50.0, 4.0}};
  tool.holder = {{50.0, 10.0}, {60.0, 12.0}};
  return tool;
}

std::vector<std::pair<int, std::string>> pairs_of(const std::string& text) {
  std::vector<std::pair<int, std::string>> pairs;
  std::istringstream in(text);
  for (std::string code, value; std::getline(in, code) && std::getline(in, value);)
    pairs.emplace_back(std::stoi(code), value);
  return pairs;
}

std::string refusal(const std::string& text) {
  try {
    (void)tool_from_dxf(text, "t.dxf");
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

/// A DXF with one polyline through the points, as another program would write it.
std::string light_polyline(const std::vector<Vec2>& points, const std::string& extra = "") {
  std::string text = "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\nProfile\n";
  for (const Vec2& p : points) text += "10\n" + std::to_string(p.x()) + "\n20\n" + std::to_string(p.y()) + "\n";
  return text + extra + "0\nENDSEC\n0\nEOF\n";
}

TEST(ToolDxf, HasTheStructureOfR12) {
  const auto pairs = pairs_of(tool_to_dxf(barrel()));
  std::map<std::string, int> entities;
  int depth = 0;
  bool version = false;
  bool blocks = false;
  for (const auto& [code, value] : pairs) {
    if (code == 1 && value == "AC1009") version = true;
    if (code == 2 && (value == "BLOCKS" || value == "ENTITIES")) blocks = value == "BLOCKS";
    if (code != 0 || (blocks && value != "ENDSEC" && value != "SECTION")) continue;
    ++entities[value];
    depth += value == "SECTION" ? 1 : value == "ENDSEC" ? -1 : 0;
    EXPECT_TRUE(depth == 0 || depth == 1);
  }
  EXPECT_TRUE(version);
  EXPECT_EQ(entities["SECTION"], 4);
  EXPECT_EQ(entities["ENDSEC"], 4);
  EXPECT_EQ(entities["DIMENSION"], 10);
  EXPECT_EQ(entities["POLYLINE"], 3);
  EXPECT_EQ(entities["SEQEND"], 3);
  EXPECT_EQ(entities["ARC"], 1);
  EXPECT_EQ(entities["LINE"], 10);  // the axis, and the frame of the title block
  EXPECT_EQ(pairs.back(), std::make_pair(0, std::string("EOF")));
}

/// The dimensions as (measured, text), the measured ones from their points alone.
std::vector<std::pair<double, std::string>> dimensions_of(const std::string& text) {
  std::vector<std::pair<double, std::string>> found;
  std::map<int, std::string> d;
  bool inside = false;
  const auto at = [&](int code) { return std::stod(d.at(code)); };
  for (const auto& [code, value] : pairs_of(text)) {
    if (code == 0 && inside) found.emplace_back(std::hypot(at(14) - at(13), at(24) - at(23)), d.at(1));
    if (code == 0) {
      inside = value == "DIMENSION";
      d.clear();
    }
    d[code] = value;
  }
  return found;
}

TEST(ToolDxf, HasTheDimensionsOfTheTool) {
  const Tool tool = barrel();
  const std::string text = tool_to_dxf(tool);
  const Vec2 begin = meridian_point(tool.radial, 0.0), end = meridian_point(tool.radial, 24.0);
  const std::vector<std::pair<double, std::string>> wanted{{end.x() - begin.x(), ""},
                                                           {24.0, ""},
                                                           {50.0 + tool.radial.at(0.0).r, ""},
                                                           {2.0 * begin.y(), "%%c"},
                                                           {2.0 * end.y(), "%%c"},
                                                           {5.0, "R"},
                                                           {26.0, ""},
                                                           {8.0, "%%c"},
                                                           {10.0, ""},
                                                           {24.0, "%%c"}};
  const auto found = dimensions_of(text);
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    EXPECT_NEAR(found[k].first, wanted[k].first, 1e-3) << k;
    EXPECT_EQ(found[k].second, wanted[k].second + fmt::format("{:.4f}", found[k].first)) << k;
    EXPECT_NE(text.find("\n*D" + std::to_string(k + 1) + "\n"), std::string::npos) << k;
  }
}

TEST(ToolDxf, CentrelineLiesOnTheAxisWithItsLineType) {
  const auto pairs = pairs_of(tool_to_dxf(barrel()));
  std::map<int, std::string> line;
  bool inside = false;
  for (const auto& [code, value] : pairs) {
    if (code == 0) inside = value == "LINE" && line[8] != "CENTRELINE";
    if (inside) line[code] = value;
  }
  EXPECT_EQ(line[8], "CENTRELINE");
  EXPECT_EQ(line[6], "CENTER");
  EXPECT_EQ(std::stod(line[20]), 0.0);
  EXPECT_EQ(std::stod(line[21]), 0.0);
  EXPECT_LT(std::stod(line[10]), -barrel().radial.at(0.0).r);
  EXPECT_GT(std::stod(line[11]), 60.0);
}

TEST(ToolDxf, FlankFollowsTheMeridianWithinItsChord) {
  for (const double arc : {85.0, 16.0}) {
    Tool tool;
    tool.radial = RadialFunction(ToolFamily::kBarrel, 24.0, Eigen::Vector3d(arc, 12, 10));
    const std::vector<Vec2> points = profile_from_dxf(tool_to_dxf(tool, false), "t.dxf");
    ASSERT_GE(points.size(), 201u);
    const Vec2 centre(10.0, 12.0 - arc);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR((points[i] - centre).norm(), arc, 1e-11);
      const Vec2 middle = 0.5 * (points[i] + points[i == 0 ? 0 : i - 1]);
      EXPECT_NEAR((middle - centre).norm(), arc, kDxfChordMm);
    }
  }
}

TEST(ToolDxf, ProfileReadsBackExactlyAndTheToolClosely) {
  const Tool tool = barrel();
  const std::vector<Vec2> points = profile_from_dxf(tool_to_dxf(tool), "t.dxf");
  EXPECT_EQ(points.front(), meridian_point(tool.radial, 0.0));
  EXPECT_EQ(points.back(), meridian_point(tool.radial, 24.0));
  const Tool read = tool_from_dxf(tool_to_dxf(tool, false), "t.dxf", 24.0);
  for (double s = 0.0; s <= 24.0; s += 0.1) EXPECT_NEAR(read.radial.at(s).r, tool.radial.at(s).r, 1e-8);
}

TEST(ToolDxf, ReadsALightPolylineOfAnotherProgram) {
  std::vector<Vec2> points;
  for (int i = 40; i >= 0; --i) points.emplace_back(7.0 + i, 3.0 + 0.05 * i);  // from the holder to the tip
  const Tool tool = tool_from_dxf(light_polyline(points), "t.dxf");
  const double slope = 0.05 / std::hypot(1.0, 0.05);
  for (double s = 0.0; s < tool.radial.axis_length(); s += 1.0) EXPECT_NEAR(tool.radial.at(s).d1, slope, 1e-7);
  EXPECT_NEAR(tool.radial.at(0.0).r, 3.0 * std::hypot(1.0, 0.05), 1e-7);
}

TEST(ToolDxf, BadFilesAreRefusedByName) {
  const std::vector<Vec2> line = {{0, 2}, {1, 2}, {2, 2}, {3, 2}, {4, 2}};
  const std::vector<std::pair<std::string, std::string>> corpus = {
      {"", "no lines, arcs"},
      {"AutoCAD Binary DXF\r\n", "not an ASCII DXF"},
      {"0\nSECTION\n2\nENTITIES\nx\ny\n", "line 5: \"x\" is not a group code"},
      {"0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n", "no lines, arcs"},
      {light_polyline(line, "0\nELLIPSE\n8\nother\n"), "ELLIPSE"},
      {light_polyline(line, "42\n1.5\n"), "more than a half circle"},
      {light_polyline(line, "10\nwide\n"), "\"wide\" is not a finite number"},
      {light_polyline({{0, 2}}), "no lines, arcs"},
      {light_polyline({{0, 2}, {3, 2}, {1, 4}, {5, 4}}), "undercut"},
      {light_polyline({{0, 2}, {0, 4}}), "one open outline"}};
  for (const auto& [text, expected] : corpus) {
    const std::string message = refusal(text);
    EXPECT_EQ(message.rfind("t.dxf: ", 0), 0u) << message;
    EXPECT_NE(message.find(expected), std::string::npos) << message << "\n for " << text;
  }
}

TEST(ToolDxf, DamagedFilesNeverCrash) {
  const std::string good = tool_to_dxf(barrel());
  Random random(5);
  for (int round = 0; round < 60; ++round) {
    std::string text = good;
    for (int k = 0; k < 3; ++k) text[random.next() % text.size()] = static_cast<char>(random.next() % 256);
    if (round % 3 == 0) text.resize(random.next() % text.size());
    (void)refusal(text);
  }
}

TEST(ToolSvg, DrawsEverythingToScale) {
  const std::string svg = tool_to_svg(barrel());
  EXPECT_EQ(svg.rfind("<svg ", 0), 0u);
  EXPECT_NE(svg.find("a &lt; b &amp; c"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  std::size_t paths = 0;
  for (std::size_t at = 0; (at = svg.find("<path", at)) != std::string::npos; ++at) ++paths;
  EXPECT_EQ(paths, 4u);  // holder, shank, flank, centreline
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(ToolAscii, FollowsTheProfileAndKeepsItsSize) {
  const std::string drawing = tool_to_ascii(barrel(), 78, 16);
  std::istringstream lines(drawing);
  std::vector<std::string> rows;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 78u) << line;
    if (line.find('|') != std::string::npos) rows.push_back(line);
  }
  ASSERT_EQ(rows.size(), 16u);
  // The largest radius, 5 mm at s = 10 of 24, stands alone in the top row; the far end is the lowest.
  const std::size_t first = rows[0].find('#'), last = rows[0].rfind('#');
  ASSERT_NE(first, std::string::npos);
  const double middle = 0.5 * static_cast<double>(first + last) - 10.0;
  EXPECT_NEAR(middle / 67.0, 10.0 / 24.0, 0.05);
  EXPECT_GT(rows[15].rfind('#'), 70u);
  EXPECT_NE(drawing.find("4.975004"), std::string::npos);
}

}  // namespace
}  // namespace flank::internal
