#include "flank/io/tool/tool_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace flank::internal {

namespace {

constexpr int kPoints = 401;
constexpr double kDegrees = 57.29577951308232;

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

/// Outline through the upper points, then back along their mirror images. SVG's y points down.
std::string outline(const std::vector<Vec2>& upper, bool round_tip, double tip_radius) {
  std::string d = fmt::format("M{:.4f} {:.4f}", upper.front().x(), -upper.front().y());
  for (const Vec2& p : upper) d += fmt::format("L{:.4f} {:.4f}", p.x(), -p.y());
  for (std::size_t k = upper.size(); k-- > 0;) d += fmt::format("L{:.4f} {:.4f}", upper[k].x(), upper[k].y());
  // The round tip runs from the lower to the upper side around the axis, the long way if the flank starts above the
  // sphere's centre.
  if (round_tip)
    d += fmt::format("A{0:.4f} {0:.4f} 0 {1} 1 {2:.4f} {3:.4f}", tip_radius, upper.front().x() > 0.0 ? 1 : 0,
                     upper.front().x(), -upper.front().y());
  return d + "Z";
}

/// Least and largest of the radii of the meridian, and where the drawing begins and ends along the axis.
struct Extent {
  double least = 0.0, most = 0.0, low = 0.0, high = 0.0;
};

Extent extent(const Tool& tool, const std::vector<Vec2>& flank, bool whole) {
  Extent e{flank.front().y(), flank.front().y(), flank.front().x(), flank.back().x()};
  for (const Vec2& p : flank) e.least = std::min(e.least, p.y()), e.most = std::max(e.most, p.y());
  if (!whole) return e;
  e.low = -tool.radial.at(0.0).r;
  for (const auto* profile : {&tool.shank, &tool.holder})
    for (const Vec2& p : *profile) e.high = std::max(e.high, p.x()), e.most = std::max(e.most, p.y());
  return e;
}

/// "name, family, axis length".
std::string title(const Tool& tool) {
  const std::string name = tool.name.empty() ? "" : tool.name + ", ";
  return fmt::format("{}{}, axis length {:.6g} mm", name, family_name(tool.radial.family()), tool.radial.axis_length());
}

/// The ends of the axis below the drawing of characters, at its left and right margin.
std::string ruler(double low, double high, int columns, int margin) {
  const std::string left = fmt::format("{:.4g}", low), right = fmt::format("{:.4g} mm", high);
  const int gap = std::max(1, columns - static_cast<int>(left.size() + right.size()));
  return std::string(static_cast<std::size_t>(margin), ' ') + left + std::string(static_cast<std::size_t>(gap), ' ') +
         right + "\n";
}

/// Radius, slope and meridian at five equal steps of s.
std::string table(const RadialFunction& radial) {
  std::string text = "      s mm         r mm   r'        slope deg   meridian z, radius mm\n";
  constexpr int kRows = 5;
  for (int i = 0; i < kRows; ++i) {
    const double s = radial.axis_length() * i / (kRows - 1);
    const RadialJet f = radial.at(s);
    const Vec2 p = meridian_point(radial, s);
    text += fmt::format("{:10.4f} {:12.6f} {:9.6f} {:10.4f}  {:11.4f} {:11.6f}\n", s, f.r, f.d1,
                        std::asin(std::clamp(f.d1, -1.0, 1.0)) * kDegrees, p.x(), p.y());
  }
  return text;
}

}  // namespace

std::string tool_to_svg(const Tool& tool) {
  const std::vector<Vec2> flank = meridian(tool.radial, kPoints);
  const Extent e = extent(tool, flank, true);
  const double margin = 0.08 * (e.high - e.low), font = 0.028 * (e.high - e.low), line = 0.003 * (e.high - e.low);
  const double width = e.high - e.low + 2.0 * margin, height = 2.0 * e.most + 3.0 * margin;
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.4f}mm\" height=\"{1:.4f}mm\" "
      "viewBox=\"{2:.4f} {3:.4f} {0:.4f} {1:.4f}\">\n<title>{4}</title>\n",
      width, height, e.low - margin, -e.most - margin, escaped(title(tool)));
  const auto shape = [&](const std::string& d, std::string_view fill) {
    text += fmt::format("<path d=\"{}\" fill=\"{}\" stroke=\"#222\" stroke-width=\"{:.4f}\"/>\n", d, fill, line);
  };
  if (tool.holder.size() > 1) shape(outline(tool.holder, false, 0.0), "#bbb");
  if (tool.shank.size() > 1) shape(outline(tool.shank, false, 0.0), "#dde");
  shape(outline(flank, true, tool.radial.at(0.0).r), "#cfe3f5");
  text += fmt::format(
      "<path d=\"M{:.4f} 0H{:.4f}\" stroke=\"#c00\" stroke-width=\"{:.4f}\" "
      "stroke-dasharray=\"{:.4f} {:.4f} {:.4f} {:.4f}\"/>\n",
      e.low - 0.5 * margin, e.high + 0.5 * margin, 0.6 * line, 3.0 * font, 0.6 * font, 0.6 * font, 0.6 * font);
  const Extent radii = extent(tool, flank, false);
  text += fmt::format("<text x=\"{:.4f}\" y=\"{:.4f}\" font-family=\"sans-serif\" font-size=\"{:.4f}\">{}</text>\n",
                      e.low, e.most + 1.2 * margin, font,
                      escaped(fmt::format("{}, radius {:.4f} to {:.4f} mm", title(tool), radii.least, radii.most)));
  return text + "</svg>\n";
}

std::string tool_to_ascii(const Tool& tool, int columns, int rows) {
  const int margin = 10, width = std::max(columns, 40) - margin - 1, height = std::max(rows, 6);
  const std::vector<Vec2> flank = meridian(tool.radial, 40 * width);
  const Extent e = extent(tool, flank, false);
  // A straight cylinder still needs a scale: its radius lies in the middle of a tenth of it.
  const double span = std::max(e.most - e.least, 0.1 * e.most), bottom = 0.5 * (e.least + e.most) - 0.55 * span;
  const double row_mm = 1.1 * span / height, column_mm = (e.high - e.low) / width;
  std::vector<double> top(static_cast<std::size_t>(width), 0.0);
  for (const Vec2& p : flank) {
    const int c = std::clamp(static_cast<int>((p.x() - e.low) / column_mm), 0, width - 1);
    top[static_cast<std::size_t>(c)] = std::max(top[static_cast<std::size_t>(c)], p.y());
  }
  std::string text = title(tool) + "\n";
  for (int i = height - 1; i >= 0; --i) {
    const double low = bottom + i * row_mm;
    std::string row = fmt::format("{:>8.4f} |", low + 0.5 * row_mm);
    for (const double r : top) row += r >= low + row_mm ? '.' : r >= low ? '#' : ' ';
    text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
  }
  text += std::string(margin - 1, ' ') + "+" + std::string(static_cast<std::size_t>(width), '-') + "\n";
  text += ruler(e.low, e.high, width, margin);
  // A character is about twice as high as wide.
  text += fmt::format("tip at the left; radius drawn {:.3g} times larger than length\n", 2.0 * column_mm / row_mm);
  return text + table(tool.radial);
}

}  // namespace flank::internal
