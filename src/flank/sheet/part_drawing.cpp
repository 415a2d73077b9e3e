#include "flank/sheet/part_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "flank/io/cad/triangulate.h"

namespace flank::internal {
namespace {

/// Of the drawing: how true its lines are, its margin, the length of an axis and the spacing of the hatching, as shares of its size.
constexpr double kDeviation = 1.0 / 500.0, kMargin = 0.18, kAxis = 0.1, kHatch = 0.03;

/// Sides of triangles that only one of them has: the borders of a face.
std::vector<std::pair<int, int>> borders_of(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> count;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[static_cast<std::size_t>(k)], b = t[static_cast<std::size_t>((k + 1) % 3)];
      ++count[{std::min(a, b), std::max(a, b)}];
    }
  std::vector<std::pair<int, int>> borders;
  for (const auto& [side, times] : count)
    if (times == 1) borders.push_back(side);
  return borders;
}

}  // namespace

PartDrawing::PartDrawing(const Part& part, const std::vector<int>& targets, const WorkSetup& place)
    : zero_(place.translation) {
  const Eigen::Matrix3d turn = place.rotation();
  const std::vector<FaceTriangles> faces = triangulate(part, kDeviation * part.box.diagonal());
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const bool target = std::find(targets.begin(), targets.end(), static_cast<int>(k)) != targets.end();
    const TriangleMesh& mesh = faces[k].mesh;
    const auto at = [&](int i) -> Vec3 {
      return turn * mesh.vertices[static_cast<std::size_t>(i)] + place.translation;
    };
    for (const auto& [a, b] : borders_of(mesh)) lines_.push_back({at(a), at(b), target});
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) box_.add(at(static_cast<int>(i)));
  }
}

std::string PartDrawing::svg(DrawnFrom side) const {
  const int up = side == DrawnFrom::kFront ? 2 : 1;
  Box3 all = box_;
  all.add(zero_);
  const double size = std::max(all.high.x() - all.low.x(), all.high[up] - all.low[up]);
  const double margin = kMargin * size, left = all.low.x() - margin, top = all.high[up] + margin;
  const double width = all.high.x() - all.low.x() + 2.0 * margin, height = top - all.low[up] + margin;
  const auto line = [&](double x1, double y1, double x2, double y2, const char* kind) {
    return fmt::format("<line class=\"{}\" x1=\"{:.3f}\" y1=\"{:.3f}\" x2=\"{:.3f}\" y2=\"{:.3f}\"/>\n", kind,
                       x1 - left, top - y1, x2 - left, top - y2);
  };
  const auto text = [&](double x, double y, const char* words) {
    return fmt::format("<text x=\"{:.3f}\" y=\"{:.3f}\" font-size=\"{:.3f}\">{}</text>\n", x - left, top - y,
                       0.045 * size, words);
  };
  std::string out =
      fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.3f} {:.3f}\">\n", width, height);
  for (const bool target : {false, true})
    for (const Line& l : lines_)
      if (l.target == target) out += line(l.from.x(), l.from[up], l.to.x(), l.to[up], target ? "target" : "edge");
  if (side == DrawnFrom::kFront) {
    const double low = box_.low.z(), step = kHatch * size;
    out += line(box_.low.x() - step, low, box_.high.x() + step, low, "clamp");
    for (double x = box_.low.x(); x < box_.high.x() + step; x += step)
      out += line(x, low, x - step, low - step, "clamp");
  }
  // The zero point, and where its axes go.
  const double axis = kAxis * size;
  out += fmt::format("<circle class=\"zero\" cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"{:.3f}\"/>\n", zero_.x() - left,
                     top - zero_[up], 0.02 * size);
  out += line(zero_.x(), zero_[up], zero_.x() + axis, zero_[up], "axis");
  out += line(zero_.x(), zero_[up], zero_.x(), zero_[up] + axis, "axis");
  out += text(zero_.x() + 1.1 * axis, zero_[up] - 0.1 * axis, "X");
  out += text(zero_.x() - 0.2 * axis, zero_[up] + 1.15 * axis, side == DrawnFrom::kFront ? "Z" : "Y");
  return out + "</svg>\n";
}

}  // namespace flank::internal
