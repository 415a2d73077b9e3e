#include "flank/geom/stray_pole.h"

#include <algorithm>

namespace flank::internal {
namespace {

/// Distance of p from the segment between its neighbours: zero for uneven steps along a line.
double off_between(const Vec3& before, const Vec3& p, const Vec3& after) {
  const Vec3 way = after - before;
  const double square = way.squaredNorm();
  const double share = square > 0.0 ? std::clamp((p - before).dot(way) / square, 0.0, 1.0) : 0.0;
  return (p - before - share * way).norm();
}

/// Distance of p, the last of a row, from where the two before it lead.
double off_at_end(const Vec3& second, const Vec3& first, const Vec3& p) {
  const Vec3 way = first - second;
  const double square = way.squaredNorm();
  const double share = square > 0.0 ? std::max(0.0, (p - first).dot(way) / square) : 0.0;
  return (p - first - share * way).norm();
}

/// How far point k of a row of `count` lies from the line of its neighbours.
template <class Row>
double off_row(const Row& row, int k, int count) {
  if (k == 0) return off_at_end(row(2), row(1), row(0));
  if (k == count - 1) return off_at_end(row(count - 3), row(count - 2), row(count - 1));
  return off_between(row(k - 1), row(k), row(k + 1));
}

}  // namespace

std::optional<StrayPole> stray_pole(const BSplineSurface& surface) {
  constexpr int kLeast = 4;  // rows and columns
  constexpr double kSize = 0.01, kOthers = 5.0;
  if (!surface.weights.empty() || surface.count_u < kLeast || surface.count_v < kLeast) return std::nullopt;
  StrayPole worst;
  double second = 0.0;
  Box3 box;
  for (int i = 0; i < surface.count_u; ++i)
    for (int j = 0; j < surface.count_v; ++j) {
      const double along_u = off_row([&](int k) -> const Vec3& { return surface.pole(k, j); }, i, surface.count_u);
      const double along_v = off_row([&](int k) -> const Vec3& { return surface.pole(i, k); }, j, surface.count_v);
      const double off = std::min(along_u, along_v);
      if (off > worst.off_mm) {
        second = worst.off_mm;
        worst = {i, j, off};
      } else {
        second = std::max(second, off);
      }
      box.add(surface.pole(i, j));
    }
  if (worst.off_mm > kSize * box.diagonal() && worst.off_mm > kOthers * second) return worst;
  return std::nullopt;
}

}  // namespace flank::internal
