#include "flank/io/tool_dxf.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "flank/base/error.h"
#include "flank/io/json_input.h"
#include "flank/tool/meridian.h"

namespace flank {

namespace {

constexpr double kDegrees = 57.29577951308232;
constexpr int kRed = 1, kGreen = 3, kCyan = 4, kWhite = 7, kGrey = 8;

/// Group codes and values, one a line.
class DxfText {
 public:
  DxfText& add(int code, std::string_view value) {
    text_ += fmt::format("{:>3}\n{}\n", code, value);
    return *this;
  }
  DxfText& add(int code, double value) { return add(code, exact_decimal(value)); }
  DxfText& add(int code, int value) { return add(code, fmt::format("{}", value)); }
  DxfText& point(int first_code, double x, double y) {
    return add(first_code, x).add(first_code + 10, y).add(first_code + 20, 0.0);
  }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

/// Equal steps in s, fine enough that no chord is farther than kDxfChordMm from the meridian (measured at the steps'
/// middles, with a margin).
std::vector<Vec2> flank_points(const RadialFunction& radial) {
  for (int count = 201;; count = 2 * count - 1) {
    std::vector<Vec2> points = meridian(radial, count);
    double largest = 0.0;
    for (int i = 0; i + 1 < count; ++i) {
      const Vec2 a = points[static_cast<std::size_t>(i)], b = points[static_cast<std::size_t>(i + 1)];
      const Vec2 m = meridian_point(radial, radial.axis_length() * (i + 0.5) / (count - 1));
      const Vec2 chord = (b - a).normalized();
      largest = std::max(largest, std::abs(chord.x() * (m - a).y() - chord.y() * (m - a).x()));
    }
    if (largest <= 0.8 * kDxfChordMm || count > 20000) return points;
  }
}

void line_type(DxfText& out, std::string_view name, std::string_view look, const std::vector<double>& dashes) {
  double length = 0.0;
  for (const double d : dashes) length += std::abs(d);
  out.add(0, "LTYPE").add(2, name).add(70, 64).add(3, look).add(72, 65);
  out.add(73, static_cast<int>(dashes.size())).add(40, length);
  for (const double d : dashes) out.add(49, d);
}

void tables(DxfText& out) {
  out.add(0, "SECTION").add(2, "TABLES");
  out.add(0, "TABLE").add(2, "LTYPE").add(70, 2);
  line_type(out, "CONTINUOUS", "Solid line", {});
  line_type(out, "CENTER", "____ _ ____ _ ____", {6.0, -1.5, 1.5, -1.5});
  out.add(0, "ENDTAB");
  struct Layer {
    std::string_view name;
    int colour;
    std::string_view type;
  };
  const std::vector<Layer> layers = {{"0", kWhite, "CONTINUOUS"},     {"FLANK", kWhite, "CONTINUOUS"},
                                     {"TIP", kGreen, "CONTINUOUS"},   {"SHANK", kCyan, "CONTINUOUS"},
                                     {"HOLDER", kGrey, "CONTINUOUS"}, {"CENTRELINE", kRed, "CENTER"},
                                     {"TEXT", kGrey, "CONTINUOUS"}};
  out.add(0, "TABLE").add(2, "LAYER").add(70, static_cast<int>(layers.size()));
  for (const Layer& l : layers) out.add(0, "LAYER").add(2, l.name).add(70, 0).add(62, l.colour).add(6, l.type);
  out.add(0, "ENDTAB").add(0, "ENDSEC");
}

void polyline(DxfText& out, std::string_view layer, const std::vector<Vec2>& points) {
  if (points.empty()) return;
  out.add(0, "POLYLINE").add(8, layer).add(66, 1).point(10, 0.0, 0.0).add(70, 0);
  for (const Vec2& p : points) out.add(0, "VERTEX").add(8, layer).point(10, p.x(), p.y());
  out.add(0, "SEQEND").add(8, layer);
}

void text_line(DxfText& out, double x, double y, double height, const std::string& text) {
  out.add(0, "TEXT").add(8, "TEXT").point(10, x, y).add(40, height).add(1, text);
}

/// From the tool's lowest point on the axis to where the flank begins.
void tip_arc(DxfText& out, const RadialFunction& radial) {
  const Vec2 p = meridian_point(radial, 0.0);
  out.add(0, "ARC").add(8, "TIP").point(10, 0.0, 0.0).add(40, radial.at(0.0).r);
  out.add(50, std::atan2(p.y(), p.x()) * kDegrees).add(51, 180.0);
}

void dimensions(DxfText& out, const Tool& tool, const std::vector<Vec2>& flank) {
  const RadialFunction& radial = tool.radial;
  const double height = std::max(0.5, radial.axis_length() / 40.0);
  double least = flank.front().y(), most = least;
  for (const Vec2& p : flank) least = std::min(least, p.y()), most = std::max(most, p.y());
  const std::vector<std::string> lines = {
      fmt::format("AXIS LENGTH {:.4f} MM (CENTRES OF INSCRIBED SPHERES)", radial.axis_length()),
      fmt::format("FLANK FROM X {:.4f} R {:.4f} TO X {:.4f} R {:.4f}", flank.front().x(), flank.front().y(),
                  flank.back().x(), flank.back().y()),
      fmt::format("RADIUS LEAST {:.4f} LARGEST {:.4f}  TIP SPHERE R {:.4f}", least, most, radial.at(0.0).r)};
  for (std::size_t i = 0; i < lines.size(); ++i)
    text_line(out, 0.0, -height * (3.0 + 2.0 * static_cast<double>(i)), height, lines[i]);
}

}  // namespace

std::string tool_to_dxf(const Tool& tool) {
  const std::vector<Vec2> flank = flank_points(tool.radial);
  double low = -tool.radial.at(0.0).r, high = flank.back().x();
  for (const auto* profile : {&tool.shank, &tool.holder})
    for (const Vec2& p : *profile) high = std::max(high, p.x());
  const double overhang = 0.05 * (high - low);
  DxfText out;
  out.add(999, "half profile of a milling tool, millimetres");
  out.add(0, "SECTION").add(2, "HEADER").add(9, "$ACADVER").add(1, "AC1009");
  out.add(9, "$EXTMIN").point(10, low, 0.0).add(9, "$EXTMAX").point(10, high, high - low);
  out.add(9, "$LTSCALE").add(40, 1.0).add(0, "ENDSEC");
  tables(out);
  out.add(0, "SECTION").add(2, "ENTITIES");
  tip_arc(out, tool.radial);
  polyline(out, "FLANK", flank);
  polyline(out, "SHANK", tool.shank);
  polyline(out, "HOLDER", tool.holder);
  out.add(0, "LINE").add(8, "CENTRELINE").add(6, "CENTER");
  out.point(10, low - overhang, 0.0).point(11, high + overhang, 0.0);
  dimensions(out, tool, flank);
  out.add(0, "ENDSEC").add(0, "EOF");
  return out.take();
}

}  // namespace flank
