#include "flank/io/tool/tool_svg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

namespace flank::internal {
namespace {

Tool barrel() {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kBarrel, 30.0, Eigen::Vector3d(85.0, 5.0, 12.0));
  tool.name = "B<5> & \"Co\"";
  return tool;
}

/// What stands between `before` and `after`, from the `n`-th `before` on.
std::string between(const std::string& text, const std::string& before, const std::string& after, int n = 0) {
  std::size_t at = text.find(before);
  for (; n > 0 && at != std::string::npos; --n) at = text.find(before, at + 1);
  if (at == std::string::npos) return "";
  at += before.size();
  return text.substr(at, text.find(after, at) - at);
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

/// Points of the M and L commands of a path.
std::vector<Vec2> corners(const std::string& d) {
  std::vector<Vec2> points;
  for (std::size_t at = d.find_first_of("ML"); at != std::string::npos; at = d.find_first_of("ML", at + 1)) {
    std::istringstream numbers(d.substr(at + 1));
    Vec2 p;
    numbers >> p.x() >> p.y();
    points.push_back(p);
  }
  return points;
}

TEST(ToolSvg, OutlineIsTheMeridianAndItsMirrorImage) {
  const Tool tool = barrel();
  const std::string svg = tool_to_svg(tool);
  const std::vector<Vec2> points = corners(between(svg, "<path d=\"", "\""));
  const std::vector<Vec2> exact = meridian(tool.radial, 401);
  ASSERT_EQ(points.size(), 1 + 2 * exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    ASSERT_LT((points[1 + i] - Vec2(exact[i].x(), -exact[i].y())).norm(), 1e-4) << "y points down";
    ASSERT_LT((points[1 + 2 * exact.size() - 1 - i] - exact[i]).norm(), 1e-4);
  }
}

TEST(ToolSvg, TheTipIsAnArcOfTheTipsSphere) {
  // The flank of a cone that opens starts below the sphere's centre, one that closes above it: the long way round.
  for (const double angle : {0.2, -0.05}) {
    Tool tool;
    tool.radial = RadialFunction(ToolFamily::kCone, 20.0, Eigen::Vector2d(3.0, angle));
    const std::string arc = between(between(tool_to_svg(tool), "<path d=\"", "\""), "A", "Z");
    std::istringstream numbers(arc);
    double rx, ry, turn, large, sweep;
    Vec2 end;
    numbers >> rx >> ry >> turn >> large >> sweep >> end.x() >> end.y();
    EXPECT_NEAR(rx, 3.0, 1e-4);
    EXPECT_EQ(rx, ry);
    EXPECT_EQ(large, angle < 0.0 ? 1.0 : 0.0);
    EXPECT_EQ(sweep, 1.0);
    EXPECT_LT((end - Vec2(-3.0 * std::sin(angle), -3.0 * std::cos(angle))).norm(), 1e-4);
  }
}

TEST(ToolSvg, EverythingLiesWithinTheViewToScale) {
  Tool tool = barrel();
  tool.shank = {{30.0, 4.0}, {70.0, 4.0}};
  tool.holder = {{70.0, 12.0}, {95.0, 17.5}};
  const std::string svg = tool_to_svg(tool);
  std::istringstream box(between(svg, "viewBox=\"", "\""));
  double x, y, width, height;
  box >> x >> y >> width >> height;
  EXPECT_EQ(std::stod(between(svg, "width=\"", "mm\"")), width) << "a millimetre is a millimetre";
  EXPECT_EQ(std::stod(between(svg, "height=\"", "mm\"")), height);
  EXPECT_LT(x, -tool.radial.at(0.0).r) << "the round tip";
  EXPECT_GT(x + width, 95.0);
  EXPECT_LT(y, -17.5);
  EXPECT_GT(y + height, 17.5);
  EXPECT_EQ(count(svg, "<path "), 4u) << "holder, shank, flank, centreline";
  tool.shank.clear();
  tool.holder.clear();
  EXPECT_EQ(count(tool_to_svg(tool), "<path "), 2u);
}

TEST(ToolSvg, NamesAreTextAndNotMarkup) {
  const std::string svg = tool_to_svg(barrel());
  EXPECT_EQ(between(svg, "<title>", "</title>"), "B&lt;5&gt; &amp; \"Co\", barrel, axis length 30 mm");
  EXPECT_NE(svg.find(", radius "), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.rfind("</svg>\n"), svg.size() - 7);
  EXPECT_EQ(count(svg, "<svg "), 1u);
  EXPECT_TRUE(svg == tool_to_svg(barrel()));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(ToolAscii, HasTheRowsAndColumnsAskedFor) {
  for (const auto& [columns, rows] : {std::pair(78, 16), std::pair(120, 30), std::pair(40, 6), std::pair(1, 1)}) {
    const std::vector<std::string> lines = lines_of(tool_to_ascii(barrel(), columns, rows));
    const int wide = std::max(columns, 40), high = std::max(rows, 6);
    ASSERT_EQ(lines.size(), static_cast<std::size_t>(1 + high + 3 + 1 + 5)) << "title, rows, axis, ruler, scale, table";
    for (int i = 1; i <= high + 2; ++i)
      EXPECT_LE(lines[static_cast<std::size_t>(i)].size(), static_cast<std::size_t>(wide));
    EXPECT_EQ(lines[0], "B<5> & \"Co\", barrel, axis length 30 mm");
  }
}

TEST(ToolAscii, EachColumnIsFilledUpToItsRadius) {
  const Tool tool = barrel();
  const std::vector<std::string> lines = lines_of(tool_to_ascii(tool, 78, 16));
  // Radii of the rows grow upwards by equal steps; the topmost mark of a column is its radius, up to a row.
  const double top = std::stod(lines[1]), step = top - std::stod(lines[2]);
  const Vec2 first = meridian_point(tool.radial, 0.0), last = meridian_point(tool.radial, 30.0);
  for (std::size_t column = 0; column < 67; ++column) {
    const double z = first.x() + (static_cast<double>(column) + 0.5) / 67.0 * (last.x() - first.x());
    double radius = 0.0;
    for (int i = 0; i <= 2000; ++i)
      if (const Vec2 p = meridian_point(tool.radial, 30.0 * i / 2000); std::abs(p.x() - z) < 0.1)
        radius = std::max(radius, p.y());
    for (std::size_t row = 1; row <= 16; ++row) {
      const std::string& line = lines[row];
      const char mark = line.size() > 10 + column ? line[10 + column] : ' ';
      const double at = top - step * static_cast<double>(row - 1);
      if (at < radius - 1.5 * step) {
        ASSERT_EQ(mark, '.') << row << ' ' << column;
      } else if (at > radius + 1.5 * step) {
        ASSERT_EQ(mark, ' ') << row << ' ' << column;
      }
    }
  }
}

TEST(ToolAscii, TheTableIsTheRadialFunctionAtFivePlaces) {
  const Tool tool = barrel();
  const std::vector<std::string> lines = lines_of(tool_to_ascii(tool));
  for (int i = 0; i < 5; ++i) {
    std::istringstream row(lines[lines.size() - 5 + static_cast<std::size_t>(i)]);
    double s, r, slope, degrees, z, rho;
    row >> s >> r >> slope >> degrees >> z >> rho;
    const RadialJet j = tool.radial.at(7.5 * i);
    EXPECT_NEAR(s, 7.5 * i, 1e-4);
    EXPECT_NEAR(r, j.r, 1e-6);
    EXPECT_NEAR(slope, j.d1, 1e-6);
    EXPECT_NEAR(degrees, std::asin(j.d1) * 57.29577951308232, 1e-4);
    EXPECT_NEAR(z, meridian_point(tool.radial, s).x(), 1e-4);
    EXPECT_NEAR(rho, meridian_point(tool.radial, s).y(), 1e-6);
  }
}

TEST(ToolAscii, AStraightCylinderHasAScaleToo) {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 4.0));
  const std::vector<std::string> lines = lines_of(tool_to_ascii(tool));
  EXPECT_EQ(lines[0], "cylinder, axis length 20 mm") << "no name, no comma";
  double below = 0.0, above = 0.0;
  for (std::size_t row = 1; row <= 16; ++row) (lines[row].find('#') != std::string::npos ? below : above) += 1.0;
  EXPECT_EQ(below, 1.0) << "its radius is one row";
  EXPECT_NEAR(0.5 * (std::stod(lines[1]) + std::stod(lines[16])), 4.0, 0.05);
}

}  // namespace
}  // namespace flank::internal
