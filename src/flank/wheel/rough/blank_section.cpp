#include "flank/wheel/rough/blank_section.h"

#include <algorithm>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/wheel/rough/channel_section.h"

namespace flank::internal {
namespace {

constexpr double kCells = 600.0;      ///< of a section, in its longer direction
constexpr double kMarginShare = 0.3;  ///< of that, that the grid goes on beyond

/// Below the outline at its place along the axis.
bool is_inside(const std::vector<Vec2>& outline, const Vec2& p) {
  for (std::size_t k = 0; k + 1 < outline.size(); ++k) {
    const Vec2 &a = outline[k], &b = outline[k + 1];
    if (p.x() < a.x() || p.x() > b.x() || !(b.x() > a.x())) continue;
    return p.y() < a.y() + (p.x() - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
  }
  return false;
}

}  // namespace

BlankSection::BlankSection(const WheelAxis& axis, const std::vector<Vec2>& outline) : axis_(axis) {
  std::vector<Vec2> line = outline;
  double top = 0.0;
  for (const Vec2& p : outline) top = std::max(top, p.y());
  line.insert(line.begin(), Vec2(outline.front().x(), 0.0));
  line.emplace_back(outline.back().x(), 0.0);
  const double length = outline.back().x() - outline.front().x(), size = std::max(length, top),
               margin = kMarginShare * size;
  cell_ = size / kCells;
  low_ = {outline.front().x() - margin, 0.0};
  columns_ = 2 + static_cast<int>(std::ceil((length + 2.0 * margin) / cell_));
  rows_ = 2 + static_cast<int>(std::ceil((top + margin) / cell_));
  depths_.resize(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_));
  parallel_for(static_cast<std::size_t>(columns_), [&](std::size_t x) {
    for (int y = 0; y < rows_; ++y) {
      const Vec2 p = low_ + cell_ * Vec2(static_cast<double>(x), y);
      const double off = distance_to(line, p);
      depths_[x * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(y)] =
          static_cast<float>(is_inside(outline, p) ? off : -off);
    }
  });
}

double BlankSection::depth(const Vec3& p) const {
  const Vec2 q = (Vec2(axis_.along(p), axis_.radius(p)) - low_) / cell_;
  // Beyond the grid is air.
  const double x = std::clamp(q.x(), 0.0, columns_ - 1.001), y = std::clamp(q.y(), 0.0, rows_ - 1.001);
  const auto i = static_cast<std::size_t>(x), j = static_cast<std::size_t>(y);
  const double t = x - static_cast<double>(i), u = y - static_cast<double>(j);
  const auto at = [&](std::size_t a, std::size_t b) {
    return static_cast<double>(depths_[a * static_cast<std::size_t>(rows_) + b]);
  };
  return std::lerp(std::lerp(at(i, j), at(i, j + 1), u), std::lerp(at(i + 1, j), at(i + 1, j + 1), u), t);
}

}  // namespace flank::internal
