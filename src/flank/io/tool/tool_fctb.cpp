#include "flank/io/tool/tool_fctb.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "flank/error.h"
#include "flank/io/text/json_input.h"

namespace flank::internal {
namespace {

constexpr int kFlankPoints = 2001, kTipPoints = 400, kSlopes = 400;
constexpr double kSteepest = 3.0;  ///< of an enclosing cone: radius over height
constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Height above the lowest point, and radius.
using Outline = std::vector<Vec2>;

Outline outline_of(const RadialFunction& radial) {
  const double radius = radial.at(0.0).r;
  const Vec2 begin = meridian_point(radial, 0.0);
  const double open = std::atan2(begin.y(), -begin.x());  // from the lowest point to where the flank begins
  Outline points;
  for (int i = 0; i < kTipPoints; ++i) {
    const double a = open * i / kTipPoints;
    points.emplace_back(radius * (1.0 - std::cos(a)), radius * std::sin(a));
  }
  for (const Vec2& p : meridian(radial, kFlankPoints)) points.emplace_back(p.x() + radius, p.y());
  return points;
}

/// A shape of FreeCAD's with what it needs to be drawn. Diameters and lengths in mm, angle in degrees.
struct Shape {
  std::string file, words;
  double volume = 0.0;  ///< of the cutting part, mm3
  double diameter = 0.0;
  double tip_diameter = 0.0, angle = 0.0;  ///< of a cone; 0: none
  bool exact = false;
};

Shape end_mill(double height, double widest) {
  return {"endmill.fcstd", "end mill", std::numbers::pi * widest * widest * height, 2.0 * widest, 0.0, 0.0, false};
}

/// A hemisphere below a cylinder; one that leaves part of the tool outside has an infinite volume.
Shape ball_end(const Outline& tool, double height, double widest) {
  Shape shape{"ballend.fcstd", "ball end", 0.0, 2.0 * widest, 0.0, 0.0, true};
  shape.volume = std::numbers::pi * widest * widest * (height - widest / 3.0);
  for (const Vec2& p : tool) {
    const double up = std::min(p.x(), widest), room = std::sqrt(up * (2.0 * widest - up)) - p.y();
    if (room < -kFctbExactMm || height < widest) shape.volume = INFINITY;
    if (room > kFctbExactMm) shape.exact = false;
  }
  return shape;
}

/// The truncated cone of least volume, by trying slopes; infinite where only a cylinder encloses.
Shape cone(const Outline& tool, double height) {
  Shape best{"chamfer.fcstd", "truncated cone", INFINITY, 0.0, 0.0, 0.0, false};
  const Vec2 chord = tool.back() - tool[kTipPoints];
  std::vector<double> slopes{chord.y() / chord.x()};
  for (int i = 1; i <= kSlopes; ++i) slopes.push_back(kSteepest * i / kSlopes);
  for (const double slope : slopes) {
    if (!(slope > 1e-6)) continue;
    double low = 0.0;
    for (const Vec2& p : tool) low = std::max(low, p.y() - slope * p.x());
    const double high = low + slope * height;
    const double volume = std::numbers::pi / 3.0 * height * (low * low + low * high + high * high);
    if (volume >= best.volume) continue;
    best.volume = volume;
    best.diameter = 2.0 * high;
    best.tip_diameter = 2.0 * low;
    best.angle = 2.0 * std::atan(slope) * kDegrees;
  }
  return best;
}

std::string note_of(const Shape& shape, const Tool& tool) {
  std::string note = shape.exact ? "The cutting part is this shape exactly"
                                 : fmt::format(
                                       "FreeCAD has no shape for this tool ({}): this {} encloses it; the true one "
                                       "is in tool.step",
                                       family_name(tool.radial.family()), shape.words);
  if (tool.shank.empty()) note += "; the tool has no shank of its own, one as long as the cutting part is drawn";
  return note + ".";
}

}  // namespace

std::string tool_to_fctb(const Tool& tool) {
  if (const Legitimacy verdict = check_legitimacy(tool.radial); !verdict.legitimate)
    throw InputError("tool.fctb: not a tool, " + verdict.reason);
  const Outline outline = outline_of(tool.radial);
  const double height = outline.back().x();
  double widest = 0.0, shank = 0.0, length = 2.0 * height;
  for (const Vec2& p : outline) widest = std::max(widest, p.y());
  for (const Vec2& p : tool.shank) shank = std::max(shank, p.y());
  if (!tool.shank.empty()) length = std::max(1.01 * height, tool.shank.back().x() + tool.radial.at(0.0).r);
  const std::vector<Shape> shapes{ball_end(outline, height, widest), cone(outline, height), end_mill(height, widest)};
  const Shape& shape = *std::min_element(shapes.begin(), shapes.end(),
                                         [](const Shape& a, const Shape& b) { return a.volume < b.volume; });
  std::vector<std::pair<std::string, std::string>> parameters;
  const auto add = [&](const char* name, double value, const char* unit) {
    parameters.emplace_back(name, fmt::format("{:.6f} {}", value, unit));
  };
  if (shape.angle > 0.0) add("CuttingEdgeAngle", shape.angle, "\u00b0");
  add("CuttingEdgeHeight", height, "mm");
  add("Diameter", shape.diameter, "mm");
  add("Length", length, "mm");
  add("ShankDiameter", shank > 0.0 ? 2.0 * shank : 2.0 * outline.back().y(), "mm");
  if (shape.angle > 0.0) add("TipDiameter", shape.tip_diameter, "mm");
  std::string text;
  for (const auto& [name, value] : parameters)
    text += fmt::format("{}\n    {}: {}", text.empty() ? "" : ",", json_string(name), json_string(value));
  return fmt::format(
      "{{\n  \"version\": 2,\n  \"name\": {},\n  \"shape\": {},\n  \"parameter\": {{{}\n  }},\n  \"attribute\": {{}},\n"
      "  \"note\": {}\n}}\n",
      json_string(tool.name.empty() ? "OpenFlank tool" : tool.name), json_string(shape.file), text,
      json_string(note_of(shape, tool)));
}

}  // namespace flank::internal
