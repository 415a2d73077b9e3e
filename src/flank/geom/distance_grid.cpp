#include "flank/geom/distance_grid.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace flank::internal {
namespace {

std::size_t blocks_of(const std::array<int, 3>& count) {
  return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]);
}

std::array<int, 3> counts(const Box3& box, double margin_mm, double block_mm) {
  std::array<int, 3> out{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    out[k] = std::max(1, static_cast<int>(std::ceil((box.high[i] - box.low[i] + 2.0 * margin_mm) / block_mm)));
  }
  return out;
}

}  // namespace

DistanceGrid::DistanceGrid(const TriangleBvh& triangles, const Box3& box, double margin_mm, double cell_mm)
    : triangles_(triangles),
      box_(box),
      low_(box.low - Vec3::Constant(margin_mm)),
      cell_(cell_mm),
      count_(counts(box, margin_mm, kCells * cell_mm)),
      blocks_(blocks_of(count_)) {}

DistanceGrid::~DistanceGrid() {
  for (std::atomic<Block*>& one : blocks_) delete one.load();
}

/// From corner to corner in rows, so that each one knows how far the next one is at most.
DistanceGrid::Block* DistanceGrid::measured(const std::array<int, 3>& at) const {
  auto out = std::make_unique<Block>();
  const double size = kCells * cell_;
  const Vec3 low = low_ + size * Vec3(at[0], at[1], at[2]);
  const double middle = std::sqrt(triangles_.closest(low + Vec3::Constant(0.5 * size)).squared_distance);
  out->cells = middle - kMostOff * size > far_mm() ? 1 : kCells;
  const int corners = out->cells + 1;
  const double cell = size / out->cells;
  out->corners.resize(static_cast<std::size_t>(corners * corners * corners));
  for (int x = 0; x < corners; ++x) {
    double known = middle + 2.0 * kMostOff * size;
    for (int y = 0; y < corners; ++y)
      for (int i = 0; i < corners; ++i) {
        const int z = y % 2 == 0 ? i : corners - 1 - i;
        const BvhHit hit = triangles_.closest_within(low + cell * Vec3(x, y, z), known + 1.001 * cell);
        known = std::sqrt(hit.squared_distance);
        out->corners[static_cast<std::size_t>((x * corners + y) * corners + z)] = static_cast<float>(known);
      }
  }
  return out.release();
}

const DistanceGrid::Block& DistanceGrid::block(const std::array<int, 3>& at) const {
  std::atomic<Block*>& held = blocks_[static_cast<std::size_t>((at[0] * count_[1] + at[1]) * count_[2] + at[2])];
  if (Block* known = held.load(std::memory_order_acquire)) return *known;
  // Two threads may measure the same one: both find the same, and the first one's is taken.
  Block *found = measured(at), *none = nullptr;
  if (held.compare_exchange_strong(none, found, std::memory_order_acq_rel)) return *found;
  delete found;
  return *none;
}

double DistanceGrid::at(const Vec3& p) const {
  const std::optional<Between> known = between_corners(p);
  return known ? known->mm : std::sqrt(triangles_.closest(p).squared_distance);
}

double DistanceGrid::at_least(const Vec3& p) const {
  const std::optional<Between> known = between_corners(p);
  return known ? known->mm - known->off : std::sqrt(box_.squared_distance(p));
}

std::optional<DistanceGrid::Between> DistanceGrid::between_corners(const Vec3& p) const {
  const double size = kCells * cell_;
  std::array<int, 3> at{};
  Vec3 t = (p - low_) / size;  // in blocks, then within the block, then within the cell
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (!(t[k] >= 0.0) || t[k] >= static_cast<double>(count_[i])) return {};
    at[i] = static_cast<int>(t[k]);
    t[k] -= at[i];
  }
  const Block& here = block(at);
  const int up = here.cells + 1, out = up * up;
  std::array<int, 3> cell{};
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    t[k] *= here.cells;
    cell[i] = std::min(here.cells - 1, static_cast<int>(t[k]));
    t[k] -= cell[i];
  }
  const float* f = here.corners.data() + cell[0] * out + cell[1] * up + cell[2];
  const auto along = [&](int offset) { return f[offset] + t[2] * (f[offset + 1] - f[offset]); };
  const double near = along(0) + t[1] * (along(up) - along(0)),
               far = along(out) + t[1] * (along(out + up) - along(out));
  return Between{near + t[0] * (far - near), kMostOff * size / here.cells};
}

}  // namespace flank::internal
