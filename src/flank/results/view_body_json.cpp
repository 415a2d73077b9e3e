#include "flank/results/view_body_json.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace flank::internal {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kQuantum = 65535.0;  // the largest 16-bit number

/// In full: ends of boxes are what the page scales positions by.
Json point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

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

Json body_json(const ViewFace& body) {
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
  if (!body.bent_mm.empty()) j["bent_mm"] = to_base64(as_floats(body.bent_mm));
  if (!body.gap_mm.empty()) j["gap_mm"] = to_base64(as_floats(body.gap_mm));
  return j;
}

}  // namespace flank::internal
