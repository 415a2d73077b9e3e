#include "flank/io/tool/tool_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>

#include "flank/error.h"
#include "flank/io/tool/mill_outline.h"

namespace flank::internal {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

std::string plain(std::string text) {
  std::string out;
  for (const char c : text) {
    if (c == ' ' || c == '-' || c == '_') continue;
    out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return out;
}

/// "5.0000 mm", "0.25 in", "45 deg": mm, or radians.
double quantity(const JsonInput& value) {
  constexpr std::array<std::pair<std::string_view, double>, 10> kUnits = {{{"", 1.0},
                                                                           {"mm", 1.0},
                                                                           {"cm", 10.0},
                                                                           {"m", 1000.0},
                                                                           {"in", 25.4},
                                                                           {"\"", 25.4},
                                                                           {"\u00b0", kRadians},
                                                                           {"deg", kRadians},
                                                                           {"rad", 1.0},
                                                                           {"\u00b5m", 1e-3}}};
  const std::string text = value.text();
  double number = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  std::string unit(error == std::errc() ? stop : end, end);
  unit.erase(0, std::min(unit.find_first_not_of(' '), unit.size()));
  for (const auto& [name, size] : kUnits)
    if (error == std::errc() && unit == name && std::isfinite(number)) return number * size;
  value.refuse(fmt::format("\"{}\" is not a length or angle; expected a number with mm, cm, in, deg or rad", text));
}

double size_of(const JsonInput& parameters, const char* name) {
  const double value = quantity(parameters.member(name));
  if (!(value > 0.0)) parameters.member(name).refuse("must be > 0");
  return value;
}

/// A cone from a flat tip to its largest diameter, or to where its edges end.
Mill cone_of(double tip_diameter, double angle, double height) {
  Mill mill;
  mill.tip_radius = 0.5 * tip_diameter;
  mill.angle = angle;
  mill.height = height;
  return mill;
}

/// The shapes of FreeCAD that cut with their flank.
Mill freecad_mill(const std::string& shape, const JsonInput& bit) {
  const JsonInput p = bit.member("parameter");
  Mill mill;
  if (shape == "endmill" || shape == "ballend" || shape == "bullnose" || shape == "torus") {
    mill.tip_radius = 0.5 * size_of(p, "Diameter");
    mill.height = size_of(p, "CuttingEdgeHeight");
    if (shape == "ballend") mill.ball = mill.tip_radius;
    // Before 1.1 the flat part was stated, and not what is left of it.
    if (shape == "bullnose" || shape == "torus")
      mill.corner = p.has("CornerRadius") ? quantity(p.member("CornerRadius"))
                                          : mill.tip_radius - quantity(p.member("FlatRadius"));
    if (!(mill.corner >= 0.0 && mill.corner <= mill.tip_radius))
      p.refuse("the corner radius is beyond the tool's radius");
    return mill;
  }
  if (shape == "taperedballnose" || shape == "taperballnose" || shape == "conicalballnose") {
    mill.ball = 0.5 * size_of(p, "Diameter");
    mill.angle = 0.5 * size_of(p, "TaperAngle");
    mill.height = size_of(p, "CuttingEdgeHeight");
    return mill;
  }
  if (shape == "chamfer")
    return cone_of(size_of(p, "TipDiameter"), 0.5 * size_of(p, "CuttingEdgeAngle"), size_of(p, "CuttingEdgeHeight"));
  if (shape == "vbit") {
    const double tip = size_of(p, "TipDiameter"), angle = 0.5 * size_of(p, "CuttingEdgeAngle");
    return cone_of(tip, angle, 0.5 * (size_of(p, "Diameter") - tip) / std::tan(angle));
  }
  bit.refuse(
      fmt::format("shape \"{}\" does not cut with its flank; accepted: endmill, ballend, bullnose, chamfer, v-bit, "
                  "taperedballnose",
                  shape));
}

/// "bullnose" of "Tools/Shape/bullnose.fcstd", or of the type that newer files state.
std::string shape_of(const JsonInput& bit) {
  const std::string type = bit.has("shape-type") ? bit.member("shape-type").text() : "";
  if (!type.empty() && plain(type) != "custom") return plain(type);
  return plain(std::filesystem::path(bit.member("shape").text()).stem().string());
}

/// A cylinder between two heights; none if the lower is the higher.
void add_cylinder(std::vector<Vec2>& profile, double low, double high, double radius) {
  if (!(high > low) || !(radius > 0.0)) return;
  profile.emplace_back(low, radius);
  profile.emplace_back(high, radius);
}

/// A member that may be missing or no number, mm by `unit`.
double length_or(const JsonInput& object, const char* name, double unit, double missing) {
  return object.has(name) ? unit * object.member(name).number() : missing;
}

double unit_of_library(const JsonInput& tool) {
  const std::string unit = tool.has("unit") ? tool.member("unit").text() : "millimeters";
  if (unit == "inches" || unit == "inch") return 25.4;
  if (unit == "millimeters" || unit == "millimeter" || unit == "mm") return 1.0;
  tool.member("unit").refuse("\"" + unit + "\": must be inches or millimeters");
}

/// Truncated cones on top of one another from height `at`, mm.
double add_segments(const JsonInput& body, double unit, double at, std::vector<Vec2>& profile) {
  if (!body.has("segments")) return at;
  const JsonInput segments = body.member("segments");
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const JsonInput one = segments.element(k);
    const double height = unit * one.member("height").number();
    if (!(height >= 0.0)) one.refuse("a height must be >= 0");
    profile.emplace_back(at, 0.5 * unit * one.member("lower-diameter").number());
    profile.emplace_back(at += height, 0.5 * unit * one.member("upper-diameter").number());
  }
  return at;
}

Mill fusion_mill(const JsonInput& tool, double unit) {
  const std::string type = plain(tool.member("type").text());
  const JsonInput g = tool.member("geometry");
  const double radius = 0.5 * unit * g.member("DC").positive(), corner = length_or(g, "RE", unit, 0.0);
  const double angle = length_or(g, "TA", kRadians, 0.0);
  Mill mill;
  mill.height = unit * g.member("LCF").positive();
  mill.tip_radius = radius;
  if (type == "flatendmill") return mill;
  if (type == "ballendmill") {
    mill.ball = radius;
    return mill;
  }
  if (type == "bullnoseendmill") {
    mill.corner = corner;
    if (!(corner >= 0.0 && corner <= radius)) g.member("RE").refuse("is beyond the tool's radius");
    return mill;
  }
  if (type == "taperedmill") {
    mill.angle = angle;
    // A ball where the corner radius leaves no flat.
    if (corner > 0.95 * radius) mill.ball = corner;
    return mill;
  }
  if (type == "chamfermill") {
    const double tip = 0.5 * unit * g.member("tip-diameter").positive();
    if (!(angle > 0.0)) g.member("TA").refuse("must be > 0");
    return cone_of(2.0 * tip, angle, std::min(mill.height, (radius - tip) / std::tan(angle)));
  }
  tool.member("type").refuse(
      "\"" + tool.member("type").text() +
      "\" does not cut with its flank; accepted: flat, ball and bull nose end mill, tapered mill, "
      "chamfer mill");
}

/// Every entry of a library; a document that is one tool is its only entry.
std::vector<JsonInput> entries_of(const JsonInput& document, bool holders) {
  std::vector<JsonInput> found;
  const auto add = [&](const JsonInput& entry) {
    const bool holder = entry.has("type") && entry.member("type").text() == "holder";
    if (holder == holders) found.push_back(entry);
  };
  if (!document.has("data")) {
    add(document);
    return found;
  }
  const JsonInput data = document.member("data");
  for (std::size_t k = 0; k < data.size(); ++k) add(data.element(k));
  return found;
}

std::string text_or(const JsonInput& entry, const char* name) {
  return entry.has(name) ? entry.member(name).text() : std::string();
}

bool goes_by(const JsonInput& entry, const std::string& name) {
  if (text_or(entry, "description") == name || text_or(entry, "product-id") == name) return true;
  if (!entry.has("post-process") || !entry.member("post-process").has("number")) return false;
  return fmt::format("{}", entry.member("post-process").member("number").number()) == name;
}

JsonInput chosen(const JsonInput& document, bool holders, const std::string& which, const std::string& file) {
  std::vector<JsonInput> entries = entries_of(document, holders);
  if (!which.empty()) std::erase_if(entries, [&](const JsonInput& entry) { return !goes_by(entry, which); });
  if (entries.size() == 1) return entries.front();
  std::string names;
  constexpr std::size_t kMostNames = 12;
  const std::vector<JsonInput> all = entries_of(document, holders);
  for (std::size_t k = 0; k < std::min(all.size(), kMostNames); ++k)
    names += (k == 0 ? "\"" : ", \"") + text_or(all[k], "description") + "\"";
  const char* what = holders ? "holder" : "tool";
  throw InputError(
      fmt::format("{}: {} {}s{}; name one: {}#NAME with the name, product number or tool number of one of {}{}", file,
                  entries.size(), what, which.empty() ? "" : " named \"" + which + "\"", file, names,
                  all.size() > kMostNames ? ", ..." : ""));
}

}  // namespace

ToolReading tool_from_fctb(std::string_view text, const std::string& file) {
  const JsonInput bit(file, text);
  const Mill mill = freecad_mill(shape_of(bit), bit);
  const JsonInput p = bit.member("parameter");
  ToolOutline outline = mill_outline(mill, file);
  outline.name = text_or(bit, "name");
  double low = mill.height;
  // Above its cone a V-bit is a cylinder as long as its edges are said to be.
  if (shape_of(bit) == "vbit" && p.has("CuttingEdgeHeight")) {
    low += quantity(p.member("CuttingEdgeHeight"));
    add_cylinder(outline.shank, mill.height, low, 0.5 * size_of(p, "Diameter"));
  }
  if (p.has("Length") && p.has("ShankDiameter"))
    add_cylinder(outline.shank, low, size_of(p, "Length"), 0.5 * size_of(p, "ShankDiameter"));
  return tool_from_outline(outline, file);
}

bool is_fusion(const JsonInput& document) {
  return document.has("data") || document.has("geometry") || document.has("segments");
}

ToolReading tool_from_fusion(const JsonInput& document, const std::string& which, const std::string& file) {
  const JsonInput tool = chosen(document, false, which, file);
  const double unit = unit_of_library(tool);
  const Mill mill = fusion_mill(tool, unit);
  ToolOutline outline = mill_outline(mill, file);
  outline.name = text_or(tool, "description");
  const JsonInput g = tool.member("geometry");
  // Shoulder, shaft and what of the shank is below the holder.
  const double shoulder = std::max(mill.height, length_or(g, "shoulder-length", unit, mill.height));
  const double widest = outline.flank.back().to.y();
  add_cylinder(outline.shank, mill.height, shoulder, 0.5 * length_or(g, "shoulder-diameter", unit, 2.0 * widest));
  double top = shoulder;
  if (tool.has("shaft")) top = add_segments(tool.member("shaft"), unit, top, outline.shank);
  const double body = length_or(g, "LB", unit, length_or(g, "OAL", unit, 0.0));
  add_cylinder(outline.shank, top, body, 0.5 * length_or(g, "SFDM", unit, 0.0));
  if (tool.has("holder") && body > 0.0)
    add_segments(tool.member("holder"),
                 unit_of_library(tool.member("holder").has("unit") ? tool.member("holder") : tool), body,
                 outline.holder);
  return tool_from_outline(outline, file);
}

std::vector<Vec2> holder_from_fcholder(std::string_view text, const std::string& file) {
  const JsonInput holder(file, text);
  if (holder.has("units") && holder.member("units").text() != "mm") holder.member("units").refuse("must be \"mm\"");
  std::vector<Vec2> profile;
  for (const Vec2& p : holder.member("profile").pairs()) profile.emplace_back(p.y(), p.x());
  // The outline begins and ends on the axis: its face and its upper end are flat.
  while (profile.size() > 1 && profile.front().y() == 0.0 && profile[1].x() == profile.front().x())
    profile.erase(profile.begin());
  while (profile.size() > 1 && profile.back().y() == 0.0 && profile[profile.size() - 2].x() == profile.back().x())
    profile.pop_back();
  return profile;
}

std::vector<Vec2> holder_from_fusion(const JsonInput& document, const std::string& which, const std::string& file) {
  const JsonInput holder = chosen(document, true, which, file);
  std::vector<Vec2> profile;
  add_segments(holder, unit_of_library(holder), 0.0, profile);
  if (profile.empty()) holder.refuse("\"segments\" is missing");
  return profile;
}

}  // namespace flank::internal
