#include "flank/bound/contact/pose_plane.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {

PosePlane::PosePlane(double most_rise, double most_slope) : count_(4) {
  corners_[0] = {-most_rise, -most_slope};
  corners_[1] = {most_rise, -most_slope};
  corners_[2] = {most_rise, most_slope};
  corners_[3] = {-most_rise, most_slope};
}

void PosePlane::cut(double sigma, double low, double high) {
  const Vec2 along(1.0, sigma);
  cut_above(along, high);
  cut_above(-along, -low);
}

void PosePlane::cut(const PosePlane& other) {
  if (other.empty()) count_ = 0;
  double size = 0.0;
  for (std::size_t k = 0; k < count_; ++k) size = std::max(size, corners_[k].norm());
  for (std::size_t k = 0; k < other.count_; ++k) size = std::max(size, other.corners_[k].norm());
  // Rounding must not take away what both have. The shorter an edge is, the less its direction is known; what that moves at
  // the far end of the polygon, times the length of the edge, is the same for all of them.
  const double spare = 1e-14 * size * size;
  for (std::size_t k = 0; k < other.count_ && count_ > 0; ++k) {
    const Vec2& here = other.corners_[k];
    const Vec2 edge = other.corners_[(k + 1) % other.count_] - here;
    const Vec2 out(edge.y(), -edge.x());
    cut_above(out, out.dot(here) + spare);
  }
}

void PosePlane::cut_above(const Vec2& along, double limit) {
  // Not a number, or without end: the caller knows nothing, so nothing is cut.
  if (!std::isfinite(limit)) return;
  std::array<Vec2, kMostCorners + 1> kept;
  std::size_t count = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    const Vec2& here = corners_[k];
    const Vec2& next = corners_[(k + 1) % count_];
    const double a = along.dot(here) - limit, b = along.dot(next) - limit;
    if (a <= 0.0) kept[count++] = here;
    // Both are finite and on different sides, so the share is between 0 and 1.
    if ((a <= 0.0) != (b <= 0.0)) kept[count++] = here + (a / (a - b)) * (next - here);
    if (count > kMostCorners - 1 && k + 1 < count_) return;
  }
  std::copy(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(count), corners_.begin());
  count_ = count;
}

double PosePlane::most_rise(double sigma) const {
  double most = 0.0;
  for (std::size_t k = 0; k < count_; ++k) most = std::max(most, std::abs(corners_[k].x() + corners_[k].y() * sigma));
  return most;
}

double PosePlane::most_slope() const {
  double most = 0.0;
  for (std::size_t k = 0; k < count_; ++k) most = std::max(most, std::abs(corners_[k].y()));
  return most;
}

Vec2 PosePlane::middle() const {
  Vec2 sum = Vec2::Zero();
  for (std::size_t k = 0; k < count_; ++k) sum += corners_[k];
  return sum / static_cast<double>(count_);
}

}  // namespace flank::internal
