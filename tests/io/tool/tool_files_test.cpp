// Tools and holders as people have them: drawings of every kind, FreeCAD's files, Fusion's libraries. Each against its closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "flank/error.h"
#include "flank/io/tool/dxf_curves.h"
#include "flank/io/tool/dxf_outline.h"
#include "flank/io/tool/tool_dxf.h"
#include "flank/io/tool/tool_dxf_read.h"
#include "flank/io/tool/tool_library.h"

namespace flank::internal {
namespace {

constexpr double kMicron = 1e-3, kDegree = std::numbers::pi / 180.0;

/// Radius at a height above the lowest point.
using Radius = std::function<double(double)>;

/// The drawn tool: a ball of 3 mm, a cone of 8 degrees up to height 20, a shank of radius 6.5 up to 45.
constexpr double kBall = 3.0, kAngle = 8.0 * kDegree, kTop = 20.0, kShank = 6.5, kEnd = 45.0;
double cone_radius(double h) {
  const double begin = kBall * (1.0 - std::sin(kAngle));
  return h < begin ? std::sqrt(h * (2.0 * kBall - h)) : kBall * std::cos(kAngle) + (h - begin) * std::tan(kAngle);
}

/// Half of it from the pole on, (z, rho).
std::vector<ProfileArc> half_tool() {
  const double begin = kBall * (1.0 - std::sin(kAngle)), turn = std::numbers::pi / 2.0 - kAngle;
  const Vec2 start(begin, cone_radius(begin)), top(kTop, cone_radius(kTop));
  return {{{0.0, 0.0}, start, -std::tan(0.25 * turn)},
          {start, top, 0.0},
          {top, {kTop, kShank}, 0.0},
          {{kTop, kShank}, {kEnd, kShank}, 0.0},
          {{kEnd, kShank}, {kEnd, 0.0}, 0.0}};
}

/// A map of the plane, and whether it mirrors.
struct Placing {
  std::function<Vec2(const Vec2&)> map = [](const Vec2& p) { return p; };
  bool mirrors = false;
};
std::vector<ProfileArc> placed(std::vector<ProfileArc> pieces, const Placing& where) {
  for (ProfileArc& p : pieces) p = {where.map(p.from), where.map(p.to), where.mirrors ? -p.bulge : p.bulge};
  return pieces;
}

std::string point(int code, const Vec2& p) {
  return fmt::format("{}\n{:.9f}\n{}\n{:.9f}\n", code, p.x(), code + 10, p.y());
}

std::string line(const Vec2& a, const Vec2& b, const std::string& extra = "8\n0\n") {
  return "0\nLINE\n" + extra + point(10, a) + point(11, b);
}

/// As other programs write an arc: centre, radius, angles counter-clockwise.
std::string arc(const ProfileArc& p) {
  const Vec2 chord = p.to - p.from;
  const double length = chord.norm(), b = p.bulge;
  const Vec2 left(-chord.y() / length, chord.x() / length);
  const Vec2 centre = 0.5 * (p.from + p.to) + length * (1.0 - b * b) / (4.0 * b) * left;
  const Vec2 first = (b > 0.0 ? p.from : p.to) - centre, last = (b > 0.0 ? p.to : p.from) - centre;
  return "0\nARC\n8\n0\n" + point(10, centre) +
         fmt::format("40\n{:.9f}\n50\n{:.9f}\n51\n{:.9f}\n", first.norm(), std::atan2(first.y(), first.x()) / kDegree,
                     std::atan2(last.y(), last.x()) / kDegree);
}

std::string lines_and_arcs(const std::vector<ProfileArc>& pieces) {
  std::string text;
  for (const ProfileArc& p : pieces) text += p.bulge == 0.0 ? line(p.from, p.to) : arc(p);
  return text;
}

std::string polyline(const std::vector<ProfileArc>& pieces, bool light, bool closed, const std::string& extra = "") {
  std::string text =
      fmt::format("0\n{}\n8\nTool\n70\n{}\n{}", light ? "LWPOLYLINE" : "POLYLINE", closed ? 1 : 0, extra);
  const auto corner = [&](const Vec2& p, double bulge) {
    text += (light ? "" : "0\nVERTEX\n8\nTool\n") + point(10, p) + fmt::format("42\n{:.12f}\n", bulge);
  };
  for (const ProfileArc& p : pieces) corner(p.from, p.bulge);
  corner(pieces.back().to, 0.0);
  return text + (light ? "" : "0\nSEQEND\n");
}

std::string drawing(const std::string& entities, int unit = 4) {
  return fmt::format(
      "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{}\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n", unit,
      entities);
}

/// At 20 heights of the flank, within a micrometre.
void expect_radius(const Tool& tool, double bottom_to_s0, double low, double high, const Radius& radius,
                   const std::string& what) {
  for (int k = 0; k < 20; ++k) {
    const double h = low + (high - low) * (k + 0.5) / 20.0;
    EXPECT_NEAR(radius_at_height(tool.radial, h - bottom_to_s0), radius(h), kMicron) << what << " at " << h;
  }
}

void expect_drawn(const std::string& text, const std::string& what) {
  SCOPED_TRACE(what);
  const ToolReading reading = read_tool_drawing(text, "t.dxf");
  EXPECT_TRUE(reading.notes.empty());
  EXPECT_NEAR(reading.tool.radial.at(0.0).r, kBall, kMicron);
  expect_radius(reading.tool, kBall, 3.0, kTop, cone_radius, what);
  ASSERT_GE(reading.tool.shank.size(), 2u);
  EXPECT_NEAR(reading.tool.shank.back().x(), kEnd - kBall, kMicron);
  EXPECT_NEAR(reading.tool.shank.back().y(), kShank, kMicron);
}

Placing turned(double degrees, const Vec2& by) {
  const double c = std::cos(degrees * kDegree), s = std::sin(degrees * kDegree);
  return {[=](const Vec2& p) { return Vec2(c * p.x() - s * p.y() + by.x(), s * p.x() + c * p.y() + by.y()); }, false};
}
Placing flipped(double x, double y) {
  return {[=](const Vec2& p) { return Vec2(x * p.x(), y * p.y()); }, x * y < 0.0};
}
std::string centreline(const Placing& where) {
  return line(where.map({-5.0, 0.0}), where.map({60.0, 0.0}), "8\n0\n6\nCenter\n");
}

TEST(ToolFiles, DrawingsOfEveryKindAreTheSameTool) {
  const std::vector<ProfileArc> half = half_tool();
  const auto at = [&](const Placing& where) { return lines_and_arcs(placed(half, where)); };
  const Placing moved = turned(0.0, {123.0, -45.0}), slanted = turned(30.0, {7.0, 9.0});
  expect_drawn(drawing(at({})), "lines and arcs");
  expect_drawn(drawing(polyline(half, true, true)), "light polyline, closed over the axis");
  expect_drawn(drawing(polyline(half, false, false)), "polyline with vertices");
  expect_drawn(drawing(at(moved) + centreline(moved)), "elsewhere, with a centreline");
  expect_drawn(drawing(at(turned(90.0, {0.0, 0.0}))), "upright");
  expect_drawn(drawing(at(turned(-90.0, {0.0, 80.0}))), "upside down");
  expect_drawn(drawing(at(flipped(-1.0, 1.0))), "tip to the right");
  expect_drawn(drawing(at(flipped(1.0, -1.0))), "below the axis");
  expect_drawn(drawing(at(slanted) + centreline(slanted)), "slanted");
  expect_drawn(drawing(at({}) + at(flipped(1.0, -1.0)) + centreline({})), "both halves");
  const Placing inches{[](const Vec2& p) { return Vec2(p / 25.4); }, false};
  expect_drawn(drawing(at(inches), 1), "inches");
  expect_drawn(drawing(polyline(placed(half, flipped(-1.0, 1.0)), true, false, "230\n-1.0\n")),
               "mirrored by its extrusion");
  // As splines become: a ball of many chords.
  std::vector<ProfileArc> fine;
  const std::vector<Vec2> ball = points_of(half[0], 2e-5);
  for (std::size_t k = 0; k < ball.size(); ++k)
    fine.push_back({ball[k], k + 1 < ball.size() ? ball[k + 1] : half[0].to, 0.0});
  fine.insert(fine.end(), half.begin() + 1, half.end());
  expect_drawn(drawing(polyline(fine, true, false)), "a ball of chords");
  std::vector<ProfileArc> mixed;
  for (std::size_t k : {3u, 0u, 4u, 2u, 1u}) mixed.push_back({half[k].to, half[k].from, -half[k].bulge});
  expect_drawn(drawing(lines_and_arcs(mixed)), "in any order, backwards");
}

TEST(ToolFiles, AFlankOfSplinesAndOneOfChords) {
  // A parabola rho = 4 + 0.1 z - 0.002 z^2 from z = 0 to 20 as a Bezier curve; the flank alone, without a tip.
  const Radius rho = [](double z) { return 4.0 + 0.1 * z - 0.002 * z * z; };
  std::string spline = "0\nSPLINE\n8\n0\n71\n2\n";
  for (const int knot : {0, 0, 0, 1, 1, 1}) spline += fmt::format("40\n{}\n", knot);
  for (const Vec2& p : {Vec2(0.0, 4.0), Vec2(10.0, 5.0), Vec2(20.0, 5.2)}) spline += point(10, p);
  const Tool tool = tool_from_dxf(drawing(spline), "t.dxf");
  const double begin = meridian_point(tool.radial, 0.0).x();
  expect_radius(tool, -begin, 0.0, 20.0, rho, "spline");
  std::vector<ProfileArc> chords;
  for (int k = 0; k < 400; ++k)
    chords.push_back({{0.05 * k, rho(0.05 * k)}, {0.05 * (k + 1), rho(0.05 * (k + 1))}, 0.0});
  const Tool again = tool_from_dxf(drawing(polyline(chords, true, false)), "t.dxf");
  expect_radius(again, -meridian_point(again.radial, 0.0).x(), 0.0, 20.0, rho, "chords");
}

TEST(ToolFiles, OwnDrawingReadsBackWithItsShankAndArcs) {
  for (const double r : {85.0, -60.0}) {
    Tool tool;
    tool.radial = RadialFunction(ToolFamily::kBarrel, 24.0, Eigen::Vector3d(r, 5, 10));
    tool.shank = {{24.0, 4.0}, {50.0, 4.0}};
    const Tool read = tool_from_dxf(tool_to_dxf(tool), "t.dxf");
    EXPECT_EQ(read.radial.family(), ToolFamily::kBarrel);  // one arc is one arc
    for (double s = 0.0; s < 24.0; s += 0.5) EXPECT_NEAR(read.radial.at(s).r, tool.radial.at(s).r, kMicron);
    ASSERT_EQ(read.shank.size(), 2u);
    EXPECT_NEAR(read.shank[1].x(), 50.0, kMicron);
    const std::string text = tool_to_dxf(tool);
    EXPECT_NE(text.find(r < 0.0 ? "LEAST R 60.0000 MM" : "NO CONCAVE ARC"), std::string::npos);
    EXPECT_NE(text.find("OVERALL LENGTH"), std::string::npos);
  }
}

std::string bit(const std::string& shape, const std::string& parameters, const std::string& type = "") {
  return fmt::format(R"({{"version": 2, "name": "b", "shape": "{}.fcstd",{} "parameter": {{{}}}, "attribute": {{}}}})",
                     shape, type.empty() ? "" : "\"shape-type\": \"" + type + "\",", parameters);
}

TEST(ToolFiles, ShapesOfFreeCad) {
  const std::string mill =
      R"("Diameter": "8.0 mm", "CuttingEdgeHeight": "20.0 mm", "Length": "50.0 mm", "ShankDiameter": "6 mm")";
  const Radius cylinder = [](double) { return 4.0; };
  const ToolReading ball = tool_from_fctb(bit("ballend", mill), "b.fctb");
  EXPECT_TRUE(ball.notes.empty());
  expect_radius(ball.tool, 4.0, 4.0, 20.0, cylinder, "ball end");
  EXPECT_EQ(ball.tool.shank, (std::vector<Vec2>{{16.0, 3.0}, {46.0, 3.0}}));
  const ToolReading flat = tool_from_fctb(bit("endmill", mill, "Endmill"), "b.fctb");
  expect_radius(flat.tool, 4.0, 4.0, 20.0, cylinder, "end mill");
  ASSERT_EQ(flat.notes.size(), 1u);  // its corner is 4 (sqrt 2 - 1) mm outside the ball
  EXPECT_NE(flat.notes[0].find("1.66 mm"), std::string::npos) << flat.notes[0];
  for (const char* corner : {R"("FlatRadius": "2.5 mm",)", R"("CornerRadius": "1.5 mm",)"}) {
    const ToolReading nose = tool_from_fctb(bit("bullnose", corner + mill), "b.fctb");
    expect_radius(nose.tool, 4.0, 4.0, 20.0, cylinder, "bull nose");
    EXPECT_NE(nose.notes.at(0).find("1.04 mm"), std::string::npos) << nose.notes[0];  // 2.5 (sqrt 2 - 1)
  }
  const Radius cone = [](double h) { return 1.0 + h * std::tan(15.0 * kDegree); };
  const std::string chamfer =
      R"("CuttingEdgeAngle": "30 °", "TipDiameter": "2 mm", "CuttingEdgeHeight": "0.5 in", "Diameter": "12 mm")";
  const Tool cut = tool_from_fctb(bit("chamfer", chamfer), "b.fctb").tool;
  const double s0 = cut.radial.at(0.0).r;  // its ball touches the flat end
  expect_radius(cut, s0, s0, 12.7, cone, "chamfer");
  const std::string v =
      R"("CuttingEdgeAngle": "30 deg", "TipDiameter": "2 mm", "CuttingEdgeHeight": "5 mm", "Diameter": "8 mm")";
  const Tool vbit = tool_from_fctb(bit("v-bit", v, "VBit"), "b.fctb").tool;
  expect_radius(vbit, vbit.radial.at(0.0).r, 2.0, 3.0 / std::tan(15.0 * kDegree), cone, "V-bit");
  const std::string taper =
      R"("Diameter": "6 mm", "TaperAngle": "16 °", "CuttingEdgeHeight": "20 mm", "TaperDiameter": "11 mm")";
  const ToolReading tapered = tool_from_fctb(bit("taperedballnose", taper, "TaperedBallNose"), "b.fctb");
  expect_radius(tapered.tool, 3.0, 2.7, 20.0, cone_radius, "tapered ball nose");
  EXPECT_TRUE(tapered.notes.empty());
}

std::string refusal(const std::function<void()>& read) {
  try {
    read();
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(ToolFiles, WhatCutsWithItsEndIsRefusedByName) {
  const auto of = [](const std::string& text) { return refusal([&] { (void)tool_from_fctb(text, "b.fctb"); }); };
  EXPECT_NE(of(bit("drill", R"("Diameter": "5 mm")")).find("\"drill\" does not cut with its flank"), std::string::npos);
  EXPECT_NE(of(bit("ballend", R"("Diameter": "5 mm")")).find("CuttingEdgeHeight"), std::string::npos);
  EXPECT_NE(of(bit("ballend", R"("Diameter": "5 furlongs", "CuttingEdgeHeight": "9 mm")")).find("is not a length"),
            std::string::npos);
  EXPECT_NE(of(bit("v-bit", R"("CuttingEdgeAngle": "30 °", "TipDiameter": "0 mm", "Diameter": "8 mm")")).find("> 0"),
            std::string::npos);
}

const char* const kLibrary = R"({"version": 36, "data": [
 {"type": "ball end mill", "unit": "inches", "description": "quarter ball", "product-id": "B4",
  "post-process": {"number": 7}, "geometry": {"DC": 0.25, "LCF": 0.75, "LB": 2.0, "SFDM": 0.25, "NOF": 4, "OAL": 3.0},
  "holder": {"segments": [{"height": 1.0, "lower-diameter": 0.8, "upper-diameter": 1.0}]}},
 {"type": "tapered mill", "unit": "millimeters", "description": "taper", "geometry":
  {"DC": 6.0, "RE": 3.0, "TA": 8.0, "LCF": 20.0, "LB": 45.0, "SFDM": 13.0}},
 {"type": "holder", "unit": "millimeters", "description": "ER16", "segments": [
  {"height": 10.0, "lower-diameter": 22.0, "upper-diameter": 28.0}, {"height": 30.0, "lower-diameter": 32.0, "upper-diameter": 32.0}]}]})";

TEST(ToolFiles, LibraryOfFusion) {
  const JsonInput library("l.json", kLibrary);
  ASSERT_TRUE(is_fusion(library));
  for (const char* name : {"quarter ball", "B4", "7"}) {
    const Tool ball = tool_from_fusion(library, name, "l.json").tool;
    expect_radius(
        ball, 3.175, 3.175, 19.05, [](double) { return 3.175; }, name);
    EXPECT_NEAR(ball.shank.back().x(), 2.0 * 25.4 - 3.175, kMicron);
    ASSERT_EQ(ball.holder.size(), 2u);
    EXPECT_NEAR(ball.holder[1].x(), 3.0 * 25.4 - 3.175, kMicron);
    EXPECT_NEAR(ball.holder[1].y(), 12.7, kMicron);
  }
  expect_radius(tool_from_fusion(library, "taper", "l.json").tool, 3.0, 2.7, 20.0, cone_radius, "tapered mill");
  const std::string which = refusal([&] { (void)tool_from_fusion(library, "", "l.json"); });
  EXPECT_NE(which.find("2 tools"), std::string::npos) << which;
  EXPECT_NE(which.find("\"quarter ball\", \"taper\""), std::string::npos) << which;
  EXPECT_EQ(holder_from_fusion(library, "", "l.json"), (std::vector<Vec2>{{0, 11}, {10, 14}, {10, 16}, {40, 16}}));
}

TEST(ToolFiles, HolderOfFreeCadAndOfADrawing) {
  const char* const nut =
      R"({"version": 1, "name": "nut", "units": "mm", "profile": [[0, 0], [10, 0], [11, 1], [11, 18.4], [0, 18.4]]})";
  const std::vector<Vec2> profile{{0.0, 10.0}, {1.0, 11.0}, {18.4, 11.0}};
  EXPECT_EQ(holder_from_fcholder(nut, "n.fcholder"), profile);
  const std::string inch = R"({"units": "in", "profile": [[1, 0], [1, 2]]})";
  EXPECT_NE(refusal([&] { (void)holder_from_fcholder(inch, "n.fcholder"); }).find("mm"), std::string::npos);
  std::string drawn;
  for (std::size_t k = 1; k < profile.size(); ++k)
    drawn += line(profile[k - 1] + Vec2(50.0, 0.0), profile[k] + Vec2(50.0, 0.0));
  const std::vector<Vec2> read = holder_of_drawing(read_dxf_curves(drawing(drawn), "h.dxf"), "h.dxf");
  ASSERT_EQ(read.size(), profile.size());
  for (std::size_t k = 0; k < read.size(); ++k) EXPECT_LT((read[k] - profile[k]).norm(), 1e-6);
}

}  // namespace
}  // namespace flank::internal
