#include "flank/artefact/view_json.h"

#include "flank/artefact/verify_json.h"
#include "flank/io/text/json_dump.h"
#include "flank/version.h"

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

namespace flank::internal {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kQuantum = 65535.0;  // the largest 16-bit number

/// JSON has no infinity: null stands for it. Seven digits are more than a picture shows.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  if (value == 0.0) return 0.0;  // its logarithm is not finite; and -0 becomes 0
  const double scale = std::pow(10.0, 6.0 - std::floor(std::log10(std::abs(value))));
  // Of numbers at the ends of the range the scale under- or overflows: they stay as they are.
  return std::isfinite(scale) && scale > 0.0 ? std::round(value * scale) / scale : value;
}

/// In full: ends of boxes are what the page scales positions by.
Json point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

Json pairs(const std::vector<Vec2>& points) {
  Json out = Json::array();
  for (const Vec2& p : points) out.push_back({number(p.x()), number(p.y())});
  return out;
}

/// One face as blocks of bytes: a part has a million numbers, which as decimals would make the page many times
/// larger.
Json to_json(const ViewFace& body) {
  Box3 box = body.mesh.box();
  std::vector<Vec3> border;
  Json counts = Json::array();
  for (const auto& polyline : body.borders) {
    counts.push_back(polyline.size());
    // Borders lie on the true edges, a chord away from the triangles: outside of their box they would be clamped.
    for (const Vec3& p : polyline) box.add(p);
    border.insert(border.end(), polyline.begin(), polyline.end());
  }
  // A face that was left out: any finite box will do for no points.
  if (box.empty()) box.add(Vec3::Zero());
  std::vector<int> indices;
  for (const auto& t : body.mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  Json j = {{"face", body.face},
            {"target", body.target},
            {"box", {point(box.low), point(box.high)}},
            {"vertices", body.mesh.vertices.size()},
            {"triangles", body.mesh.triangles.size()},
            {"positions", to_base64(quantised(body.mesh.vertices, box))},
            {"indices", to_base64(delta_coded(indices))},
            {"border_counts", counts},
            {"borders", to_base64(quantised(border, box))}};
  if (!body.f_mm.empty()) j["f_mm"] = to_base64(as_floats(body.f_mm));
  if (!body.gap_mm.empty()) j["gap_mm"] = to_base64(as_floats(body.gap_mm));
  return j;
}

/// Poses as six numbers each, tip and axis. Single precision is far below a pixel.
Json to_json(const ViewStrip& strip) {
  std::vector<double> poses;
  for (const Pose& p : strip.poses)
    poses.insert(poses.end(), {p.tip.x(), p.tip.y(), p.tip.z(), p.axis.x(), p.axis.y(), p.axis.z()});
  Json j = {{"id", strip.id},
            {"face", strip.face},
            {"pose_count", strip.pose_count},
            {"index", strip.index},
            {"poses", to_base64(as_floats(poses))}};
  Json t = Json::array(), low = Json::array(), high = Json::array(), c = Json::array(), clearance = Json::array();
  bool any_clearance = false;
  for (const ViewPlace& place : strip.places) {
    t.push_back(number(place.t));
    low.push_back(number(place.lowest_f_mm));
    high.push_back(number(place.highest_f_mm));
    c.push_back(number(place.largest_c));
    clearance.push_back(number(place.clearance_mm));
    any_clearance = any_clearance || std::isfinite(place.clearance_mm);
  }
  j["places"] = {{"t", t}, {"lowest_f_mm", low}, {"highest_f_mm", high}, {"largest_c", c}};
  // Without anything to keep clear of, a row of nulls would only say that nobody asked.
  if (any_clearance) j["places"]["clearance_mm"] = clearance;
  return j;
}

Json tool_to_view(const View& view) {
  Json profile = Json::array();
  for (const ProfilePoint& p : view.profile)
    profile.push_back({number(p.s), number(p.z), number(p.rho), number(p.curvature_per_mm)});
  // Asked for here and not taken from a report: a picture of an illegitimate tool must say so, whoever made it.
  const RadialFunction& radial = view.tool.radial;
  const Legitimacy legitimacy = check_legitimacy(radial);
  return {{"name", view.tool.name},
          {"legitimate", legitimacy.legitimate},
          {"reason", legitimacy.reason},
          {"family", family_name(radial.family())},
          {"axis_length_mm", radial.axis_length()},
          {"tip_radius_mm", radial.at(0.0).r},
          {"end_radius_mm", radial.at(radial.axis_length()).r},
          {"profile", profile},
          {"shank", pairs(view.tool.shank)},
          {"holder", pairs(view.tool.holder)}};
}

}  // namespace

std::string to_base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  // Three bytes are four digits of six bits; where bytes are missing at the end, "=" stands for the digits that would
  // hold nothing.
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const std::uint32_t word = static_cast<std::uint32_t>(bytes[i]) << 16 |
                               static_cast<std::uint32_t>(left > 1 ? bytes[i + 1] : 0) << 8 |
                               static_cast<std::uint32_t>(left > 2 ? bytes[i + 2] : 0);
    text += kDigits[word >> 18];
    text += kDigits[word >> 12 & 63];
    text += left > 1 ? kDigits[word >> 6 & 63] : '=';
    text += left > 2 ? kDigits[word & 63] : '=';
  }
  return text;
}

std::vector<std::uint8_t> quantised(const std::vector<Vec3>& points, const Box3& box) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(6 * points.size());
  const Vec3 size = box.high - box.low;
  for (const Vec3& p : points)
    for (int k = 0; k < 3; ++k) {
      // A flat face has no size in one direction.
      const double share = size[k] > 0.0 ? (p[k] - box.low[k]) / size[k] : 0.0;
      const auto step = static_cast<std::uint32_t>(std::lround(std::clamp(share, 0.0, 1.0) * kQuantum));
      bytes.push_back(static_cast<std::uint8_t>(step & 255));
      bytes.push_back(static_cast<std::uint8_t>(step >> 8));
    }
  return bytes;
}

std::vector<std::uint8_t> delta_coded(const std::vector<int>& indices) {
  std::vector<std::uint8_t> bytes;
  // Triangles that follow each other have corners that do, so most differences fit into one byte.
  std::int64_t before = 0;
  for (int index : indices) {
    const std::int64_t delta = index - before;
    before = index;
    // 0, -1, 1, -2, ... become 0, 1, 2, 3, ...: small numbers of either sign have few bits.
    std::uint64_t zigzag =
        delta < 0 ? static_cast<std::uint64_t>(-2 * delta - 1) : static_cast<std::uint64_t>(2 * delta);
    for (; zigzag > 127; zigzag >>= 7) bytes.push_back(static_cast<std::uint8_t>(zigzag & 127) | 128);
    bytes.push_back(static_cast<std::uint8_t>(zigzag));
  }
  return bytes;
}

std::vector<std::uint8_t> as_floats(const std::vector<double>& values) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * values.size());
  for (double value : values) {
    const auto word = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    // Byte by byte, so that the order does not depend on the machine.
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(word >> shift & 255));
  }
  return bytes;
}

std::string view_to_json(const View& view) {
  Json j = {{"schema", "openflank/view/1"},
            {"units", "mm"},
            {"program", std::string("OpenFlank ") + kVersion},
            {"command", view.command},
            {"part", view.part},
            {"faces", view.faces},
            {"tolerance_mm", view.tolerance_mm},
            {"least_coverage", view.least_coverage},
            {"tool", tool_to_view(view)},
            {"strips", Json::array()},
            {"bodies", Json::array()}};
  for (const SheetSide& side : view.sides) j["sides"].push_back(sheet_side_to_json(side));
  for (const ViewStrip& strip : view.strips) j["strips"].push_back(to_json(strip));
  for (const ViewFace& body : view.bodies) j["bodies"].push_back(to_json(body));
  for (const ViewFace& body : view.fixtures) j["fixtures"].push_back(to_json(body));
  return dumped(j) + "\n";
}

}  // namespace flank::internal
