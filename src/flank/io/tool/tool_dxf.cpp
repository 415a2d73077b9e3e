#include "flank/io/tool/tool_dxf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flank/error.h"
#include "flank/io/text/dxf_dimension.h"
#include "flank/io/tool/profile_arcs.h"
#include "flank/tool/meridian.h"

namespace flank::internal {

namespace {

constexpr double kDegrees = 57.29577951308232;
/// AutoCAD's colour numbers.
constexpr int kRed = 1, kGreen = 3, kCyan = 4, kWhite = 7, kGrey = 8;

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

/// A dash pattern: lengths in drawing units, negative for gaps.
void line_type(DxfText& out, std::string_view name, std::string_view look, const std::vector<double>& dashes) {
  double length = 0.0;
  for (const double d : dashes) length += std::abs(d);
  out.add(0, "LTYPE").add(2, name).add(70, 64).add(3, look).add(72, 65);
  out.add(73, static_cast<int>(dashes.size())).add(40, length);
  for (const double d : dashes) out.add(49, d);
}

/// Line types and layers; readers refuse entities on a layer that is not declared.
void tables(DxfText& out, double height) {
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
  const std::vector<Layer> layers = {
      {"0", kWhite, "CONTINUOUS"},    {"FLANK", kWhite, "CONTINUOUS"}, {"TIP", kGreen, "CONTINUOUS"},
      {"SHANK", kCyan, "CONTINUOUS"}, {"HOLDER", kGrey, "CONTINUOUS"}, {"CENTRELINE", kRed, "CENTER"},
      {"TEXT", kGrey, "CONTINUOUS"},  {"TITLE", kGrey, "CONTINUOUS"},  {kDxfDimensionLayer, kGreen, "CONTINUOUS"}};
  out.add(0, "TABLE").add(2, "LAYER").add(70, static_cast<int>(layers.size()));
  for (const Layer& l : layers) out.add(0, "LAYER").add(2, l.name).add(70, 0).add(62, l.colour).add(6, l.type);
  out.add(0, "ENDTAB");
  dxf_dimension_style(out, height);
  out.add(0, "ENDSEC");
}

/// The old POLYLINE with vertices: R12 has no other.
void polyline(DxfText& out, std::string_view layer, const std::vector<Vec2>& points) {
  if (points.empty()) return;
  out.add(0, "POLYLINE").add(8, layer).add(66, 1).point(10, 0.0, 0.0).add(70, 0);
  for (const Vec2& p : points) out.add(0, "VERTEX").add(8, layer).point(10, p.x(), p.y());
  out.add(0, "SEQEND").add(8, layer);
}

/// The same of arcs: the bulge of a vertex is that of what begins there.
void polyline(DxfText& out, std::string_view layer, const std::vector<ProfileArc>& arcs) {
  out.add(0, "POLYLINE").add(8, layer).add(66, 1).point(10, 0.0, 0.0).add(70, 0);
  for (const ProfileArc& arc : arcs)
    out.add(0, "VERTEX").add(8, layer).point(10, arc.from.x(), arc.from.y()).add(42, arc.bulge);
  out.add(0, "VERTEX").add(8, layer).point(10, arcs.back().to.x(), arcs.back().to.y());
  out.add(0, "SEQEND").add(8, layer);
}

void text_line(DxfText& out, double x, double y, double height, const std::string& text,
               std::string_view layer = "TEXT") {
  out.add(0, "TEXT").add(8, layer).point(10, x, y).add(40, height).add(1, text);
}

/// From the tool's lowest point on the axis to where the flank begins.
void tip_arc(DxfText& out, const RadialFunction& radial) {
  const Vec2 p = meridian_point(radial, 0.0);
  out.add(0, "ARC").add(8, "TIP").point(10, 0.0, 0.0).add(40, radial.at(0.0).r);
  out.add(50, std::atan2(p.y(), p.x()) * kDegrees).add(51, 180.0);
}

/// mm: readable beside the profile on one sheet.
double text_height(const Tool& tool) { return std::max(0.5, tool.radial.axis_length() / 40.0); }

/// Where the drawing ends: along the axis, and the largest radius of flank, shank and holder.
struct Extent {
  double low = 0.0, high = 0.0, widest = 0.0;
  double body = 0.0;  ///< the largest radius without the holder
};

Extent extent_of(const Tool& tool, const std::vector<Vec2>& flank) {
  Extent e{-tool.radial.at(0.0).r, flank.back().x(), 0.0, 0.0};
  // The holder is drawn, but is no part of the tool's own length.
  for (const auto* profile : std::initializer_list<const std::vector<Vec2>*>{&flank, &tool.shank})
    for (const Vec2& p : *profile) e.high = std::max(e.high, p.x()), e.widest = std::max(e.widest, p.y());
  e.body = e.widest;
  for (const Vec2& p : tool.holder) e.widest = std::max(e.widest, p.y());
  return e;
}

Vec2 widest_point(const std::vector<Vec2>& profile) {
  return *std::max_element(profile.begin(), profile.end(), [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); });
}

/// Lengths above the profile, diameters across the axis, where the lower half would be.
std::vector<DxfDimension> dimensions_of(const Tool& tool, const std::vector<Vec2>& flank, double height) {
  const Extent e = extent_of(tool, flank);
  const auto level = [&](int k) { return e.widest + (2.0 + 3.0 * k) * height; };
  std::vector<DxfDimension> all;
  // At one radius: some readers measure from point to point, not along the axis.
  const auto length = [&](const Vec2& a, const Vec2& b, int k) {
    const double rho = std::max(a.y(), b.y());
    all.push_back({{a.x(), rho}, {b.x(), rho}, false, level(k), ""});
  };
  const auto diameter = [&](const Vec2& p) { all.push_back({{p.x(), -p.y()}, p, true, p.x(), "%%c"}); };
  length(flank.front(), flank.back(), 0);
  length({0.0, 0.0}, {tool.radial.axis_length(), 0.0}, 1);
  length({e.low, 0.0}, {e.high, 0.0}, 2);
  diameter(flank.front());
  diameter(flank.back());
  const Vec2 most = widest_point(flank);
  // Beside the diameter where the largest radius is that of an end.
  const double beside = most.x() < flank.front().x() + 2.0 * height  ? flank.front().x() + 3.0 * height
                        : most.x() > flank.back().x() - 2.0 * height ? flank.back().x() - 3.0 * height
                                                                     : most.x();
  all.push_back({{most.x(), 0.0}, most, true, beside, "R"});
  int k = 0;
  for (const auto* profile : {&tool.shank, &tool.holder}) {
    if (profile->size() < 2) continue;
    length(profile->front(), profile->back(), k++);
    diameter(widest_point(*profile));
  }
  return all;
}

/// "CONCAVE R 60.0000 MM FROM X 4 TO 20": the hollow arcs of the flank, the sharpest first named; none: that there is none.
std::string concave_words(const std::vector<ProfileArc>& arcs) {
  double least = INFINITY, low = INFINITY, high = -INFINITY;
  for (const ProfileArc& arc : arcs) {
    if (!(arc.bulge > 0.0)) continue;
    const double b = arc.bulge;
    least = std::min(least, (arc.to - arc.from).norm() * (1.0 + b * b) / (4.0 * b));
    low = std::min(low, arc.from.x());
    high = std::max(high, arc.to.x());
  }
  if (!std::isfinite(least)) return "NO CONCAVE ARC: ANY GRINDING WHEEL";
  return fmt::format("CONCAVE FROM X {:.4f} TO X {:.4f}, LEAST R {:.4f} MM", low, high, least);
}

std::string shank_words(const std::vector<Vec2>& shank) {
  if (shank.size() < 2) return "SHANK: NONE DRAWN";
  return fmt::format("SHANK %%c{:.4f} LENGTH {:.4f} MM", 2.0 * widest_point(shank).y(),
                     shank.back().x() - shank.front().x());
}

void notes(DxfText& out, const Tool& tool, const std::vector<Vec2>& flank, double height) {
  const RadialFunction& radial = tool.radial;
  double least = flank.front().y(), most = least;
  for (const Vec2& p : flank) least = std::min(least, p.y()), most = std::max(most, p.y());
  const std::vector<std::string> lines = {
      fmt::format("AXIS LENGTH {:.4f} MM (CENTRES OF INSCRIBED SPHERES)", radial.axis_length()),
      fmt::format("FLANK FROM X {:.4f} R {:.4f} TO X {:.4f} R {:.4f}", flank.front().x(), flank.front().y(),
                  flank.back().x(), flank.back().y()),
      fmt::format("RADIUS LEAST {:.4f} LARGEST {:.4f}", least, most),
      fmt::format("TIP BALL R {:.4f}, CUTTING", radial.at(0.0).r),
      concave_words(profile_arcs(radial, kDxfArcsMm)),
      shank_words(tool.shank)};
  for (std::size_t i = 0; i < lines.size(); ++i)
    text_line(out, 0.0, -extent_of(tool, flank).widest - height * (3.0 + 2.0 * static_cast<double>(i)), height,
              lines[i]);
}

/// DXF text is a line, and old readers take ASCII only.
std::string one_line(const std::string& text) {
  std::string out;
  for (const char c : text) out += c >= ' ' && c <= '~' ? c : '?';
  return out;
}

/// A frame with what a drawing office needs, below the notes.
void title_block(DxfText& out, const Tool& tool, const Extent& e, double height) {
  const double top = -e.widest - 17.0 * height, row = 2.0 * height, width = 40.0 * height, key = 12.0 * height;
  const std::vector<std::pair<std::string, std::string>> rows = {
      {"TOOL", one_line(tool.name.empty() ? std::string(family_name(tool.radial.family())) : tool.name)},
      {"OVERALL LENGTH", fmt::format("{:.4f}", e.high - e.low)},
      {"BLANK", fmt::format("%%c{:.4f} OR MORE", 2.0 * e.body)},
      {"UNITS, SCALE", "MM, 1:1"},
      {"PROFILE WITHIN", fmt::format("{:g} MM OF NOMINAL", kDxfArcsMm)}};
  const auto line = [&](double x0, double y0, double x1, double y1) {
    out.add(0, "LINE").add(8, "TITLE").point(10, e.low + x0, top + y0).point(11, e.low + x1, top + y1);
  };
  const double bottom = -row * static_cast<double>(rows.size());
  for (std::size_t k = 0; k <= rows.size(); ++k)
    line(0.0, -row * static_cast<double>(k), width, -row * static_cast<double>(k));
  for (const double x : {0.0, key, width}) line(x, 0.0, x, bottom);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double y = top - row * static_cast<double>(k) - 0.75 * row;
    text_line(out, e.low + 0.5 * height, y, 0.8 * height, rows[k].first, "TITLE");
    text_line(out, e.low + key + 0.5 * height, y, 0.8 * height, rows[k].second, "TITLE");
  }
}

}  // namespace

std::string tool_to_dxf(const Tool& tool, bool arcs) {
  const std::vector<Vec2> flank = flank_points(tool.radial);
  const Extent e = extent_of(tool, flank);
  const double overhang = 0.05 * (e.high - e.low), height = text_height(tool);
  const std::vector<DxfDimension> dimensions = dimensions_of(tool, flank, height);
  DxfText out;
  out.add(999, "half profile of a milling tool, millimetres");
  out.add(0, "SECTION").add(2, "HEADER").add(9, "$ACADVER").add(1, "AC1009");
  out.add(9, "$EXTMIN").point(10, e.low - overhang, -e.widest - 28.0 * height);
  out.add(9, "$EXTMAX").point(10, e.high + overhang, e.widest + 10.0 * height);
  out.add(9, "$LTSCALE").add(40, 1.0).add(0, "ENDSEC");
  tables(out, height);
  dxf_dimension_blocks(out, dimensions, height);
  out.add(0, "SECTION").add(2, "ENTITIES");
  tip_arc(out, tool.radial);
  if (arcs)
    polyline(out, "FLANK", profile_arcs(tool.radial, kDxfArcsMm));
  else
    polyline(out, "FLANK", flank);
  polyline(out, "SHANK", tool.shank);
  polyline(out, "HOLDER", tool.holder);
  out.add(0, "LINE").add(8, "CENTRELINE").add(6, "CENTER");
  const double end = tool.holder.empty() ? e.high : std::max(e.high, tool.holder.back().x());
  out.point(10, e.low - overhang, 0.0).point(11, end + overhang, 0.0);
  dxf_dimensions(out, dimensions, height);
  notes(out, tool, flank, height);
  title_block(out, tool, e, height);
  out.add(0, "ENDSEC").add(0, "EOF");
  return out.take();
}

}  // namespace flank::internal
