#include "flank/geom/stray_pole.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

constexpr double kOthers = 5.0;  ///< so many times as far off as any other

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

/// The same, where a row does not lead on beyond what it has.
double off_last_two(const Vec3& second, const Vec3& first, const Vec3& p) { return off_between(second, p, first); }

/// How far point k of a row of `count` lies from the line of its neighbours; `at_end`: of the last of a row.
template <class Row, class AtEnd>
double off_row(const Row& row, int k, int count, const AtEnd& at_end) {
  if (k == 0) return at_end(row(2), row(1), row(0));
  if (k == count - 1) return at_end(row(count - 3), row(count - 2), row(count - 1));
  return off_between(row(k - 1), row(k), row(k + 1));
}

/// The entry of a grid that lies off the line of its neighbours both ways by more than `kOthers` times as much as any other. `at`: (i, j).
template <class Grid, class AtEnd>
StrayPole astray(int count_u, int count_v, const Grid& at, const AtEnd& at_end) {
  StrayPole worst;
  double second = 0.0;
  for (int i = 0; i < count_u; ++i)
    for (int j = 0; j < count_v; ++j) {
      const double along_u = off_row([&](int k) { return at(k, j); }, i, count_u, at_end);
      const double along_v = off_row([&](int k) { return at(i, k); }, j, count_v, at_end);
      const double off = std::min(along_u, along_v);
      second = std::max(second, std::min(off, worst.off));
      if (off > worst.off) worst = {i, j, off};
    }
  return worst.off > kOthers * second ? worst : StrayPole{};
}

bool large_enough(const BSplineSurface& surface) {
  constexpr int kLeast = 4;  // rows and columns
  return surface.count_u >= kLeast && surface.count_v >= kLeast;
}

}  // namespace

std::optional<StrayPole> stray_pole(const BSplineSurface& surface) {
  constexpr double kSize = 0.01;
  if (!surface.weights.empty() || !large_enough(surface)) return std::nullopt;
  Box3 box;
  for (const Vec3& pole : surface.poles) box.add(pole);
  const StrayPole worst = astray(
      surface.count_u, surface.count_v, [&](int i, int j) { return surface.pole(i, j); }, off_at_end);
  return worst.off > kSize * box.diagonal() ? std::optional(worst) : std::nullopt;
}

std::optional<StrayPole> stray_weight(const BSplineSurface& surface) {
  constexpr double kFactor = 1.25;
  if (surface.weights.empty() || !large_enough(surface)) return std::nullopt;
  const auto logarithm = [&](int i, int j) {
    return Vec3(std::log(surface.weights[static_cast<std::size_t>(i * surface.count_v + j)]), 0.0, 0.0);
  };
  const StrayPole worst = astray(surface.count_u, surface.count_v, logarithm, off_last_two);
  return worst.off > std::log(kFactor) ? std::optional(StrayPole{worst.u, worst.v, std::exp(worst.off)}) : std::nullopt;
}

double stray_curve_weight(const std::vector<double>& weights) {
  // The weight between the ends of an arc is the cosine of half its angle.
  constexpr double kFactor = 4.0;
  const int count = static_cast<int>(weights.size());
  if (count < 5) return 0.0;
  const auto logarithm = [&](int k) { return Vec3(std::log(weights[static_cast<std::size_t>(k)]), 0.0, 0.0); };
  double worst = 0.0, second = 0.0;
  for (int k = 0; k < count; ++k) {
    const double off = off_row(logarithm, k, count, off_last_two);
    second = std::max(second, std::min(off, worst));
    worst = std::max(worst, off);
  }
  return worst > kOthers * second && worst > std::log(kFactor) ? std::exp(worst) : 0.0;
}

}  // namespace flank::internal
