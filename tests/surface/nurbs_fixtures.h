/// Faces with known closest points, and brute force for those without.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "flank/base/random.h"
#include "flank/face.h"
#include "flank/target.h"

namespace flank::internal::test {

/// How many of n random points a test with dense search looks at: fewer under a sanitizer, which is 10 to 20 times
/// slower.
constexpr int few_if_sanitized(int n) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return n / 6;
#else
  return n;
#endif
}

inline Face bilinear(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Face f;
  f.id = "F1";
  f.surface = {1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, 2, 2, {a, b, c, d}, {}};
  return f;
}

/// Square [0, size]^2 in the plane z = 0, normal +z, u along x.
inline Face plane(double size) { return bilinear({0, 0, 0}, {0, size, 0}, {size, 0, 0}, {size, size, 0}); }

/// Exact arcs of 90 degrees, as many as `quarters`, of a profile turned about z: profile pole k is (radius, height)
/// with a weight.
struct ProfilePole {
  double radius, height, weight;
};
inline Face revolved(int quarters, int degree_v, std::vector<double> knots_v, const std::vector<ProfilePole>& profile) {
  Face f;
  f.id = "F1";
  BSplineSurface& s = f.surface;
  s.degree_u = 2;
  s.degree_v = degree_v;
  s.knots_v = std::move(knots_v);
  s.count_u = 2 * quarters + 1;
  s.count_v = static_cast<int>(profile.size());
  s.knots_u = {0, 0, 0};
  for (int k = 1; k < quarters; ++k) s.knots_u.insert(s.knots_u.end(), 2, k);
  s.knots_u.insert(s.knots_u.end(), 3, quarters);
  const double quarter = std::numbers::pi / 2;
  for (int i = 0; i < s.count_u; ++i) {
    const double angle = i * quarter / 2, reach = i % 2 == 1 ? std::numbers::sqrt2 : 1.0;
    for (const ProfilePole& p : profile) {
      s.poles.emplace_back(p.radius * reach * std::cos(angle), p.radius * reach * std::sin(angle), p.height);
      s.weights.push_back(p.weight / reach);
    }
  }
  return f;
}

/// Cylinder about z, 0 <= z <= height; outward normal away from the axis.
inline Face cylinder(double radius, double height, int quarters) {
  return revolved(quarters, 1, {0, 0, 1, 1}, {{radius, 0, 1}, {radius, height, 1}});
}

/// Cone of half angle 45 degrees with its apex at the origin.
inline Face cone(double height) { return revolved(4, 1, {0, 0, 1, 1}, {{0, 0, 1}, {height, height, 1}}); }

inline Face sphere(double r) {
  const double h = std::numbers::sqrt2 / 2;
  return revolved(4, 2, {0, 0, 0, 1, 1, 2, 2, 2}, {{0, -r, 1}, {r, -r, h}, {r, 0, 1}, {r, r, h}, {0, r, 1}});
}

inline Face torus(double ring, double r) {
  const double h = std::numbers::sqrt2 / 2;
  return revolved(4, 2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4},
                  {{ring + r, 0, 1},
                   {ring + r, r, h},
                   {ring, r, 1},
                   {ring - r, r, h},
                   {ring - r, 0, 1},
                   {ring - r, -r, h},
                   {ring, -r, 1},
                   {ring + r, -r, h},
                   {ring + r, 0, 1}});
}

/// A wavy height field over [0, 100]^2 with random poles.
inline Face wavy(std::uint64_t seed, int degree_u, int degree_v, int count_u, int count_v, bool rational,
                 double height) {
  Random random(seed);
  Face f;
  f.id = "F1";
  BSplineSurface& s = f.surface;
  s.degree_u = degree_u;
  s.degree_v = degree_v;
  s.count_u = count_u;
  s.count_v = count_v;
  s.knots_u = uniform_knots(degree_u, count_u);
  s.knots_v = uniform_knots(degree_v, count_v, -2.0, 5.0);
  for (int i = 0; i < count_u; ++i)
    for (int j = 0; j < count_v; ++j) {
      const double x = 100.0 * i / (count_u - 1), y = 100.0 * j / (count_v - 1);
      s.poles.emplace_back(x + random.uniform(-3, 3), y + random.uniform(-3, 3), random.uniform(-height, height));
      if (rational) s.weights.push_back(random.uniform(0.6, 1.6));
    }
  return f;
}

/// A strongly twisted ruled patch of degree 3 x 1, like an impeller's blade.
inline Face twisted_ruled() {
  Face f;
  f.id = "F1";
  f.surface = {3, 1, uniform_knots(3, 6), {0, 0, 1, 1}, 6, 2, {}, {}};
  for (int i = 0; i < 6; ++i) {
    const double x = 10.0 * i, turn = 0.2 * i;
    f.surface.poles.emplace_back(x, 0.02 * x * x, 0.0);
    f.surface.poles.emplace_back(x, 30.0 * std::sin(turn), 30.0 * std::cos(turn));
  }
  return f;
}

/// Dense search: distance from p to the untrimmed face by a grid, its best points polished by compass search in (u, v).
/// Independent of all that the target uses.
inline double brute_distance(const BSplineSurface& s, const Vec3& p, int grid = 120) {
  struct Start {
    double squared, u, v;
  };
  std::vector<Start> starts;
  const double u0 = s.u_first(), u1 = s.u_last(), v0 = s.v_first(), v1 = s.v_last();
  for (int i = 0; i <= grid; ++i)
    for (int j = 0; j <= grid; ++j) {
      const double u = u0 + (u1 - u0) * i / grid, v = v0 + (v1 - v0) * j / grid;
      starts.push_back({(s.value(u, v) - p).squaredNorm(), u, v});
    }
  const std::size_t keep = 12;
  std::partial_sort(starts.begin(), starts.begin() + keep, starts.end(),
                    [](const Start& a, const Start& b) { return a.squared < b.squared; });
  double best = starts[0].squared;
  for (std::size_t k = 0; k < keep; ++k) {
    Start x = starts[k];
    double hu = (u1 - u0) / grid, hv = (v1 - v0) / grid;
    while (hu > 1e-11 * (u1 - u0)) {
      // Quadratic model over the compass, so that narrow valleys do not stall the search.
      Start next = x;
      for (int a = -1; a <= 1; ++a)
        for (int b = -1; b <= 1; ++b) {
          const double u = std::clamp(x.u + a * hu, u0, u1), v = std::clamp(x.v + b * hv, v0, v1);
          const double d = (s.value(u, v) - p).squaredNorm();
          if (d < next.squared) next = {d, u, v};
        }
      if (next.squared < x.squared) {
        x = next;
      } else {
        hu *= 0.5;
        hv *= 0.5;
      }
    }
    best = std::min(best, x.squared);
  }
  return std::sqrt(best);
}

inline Vec3 random_in(Random& random, const Box3& box, double margin) {
  const Vec3 size = Vec3::Constant(margin * box.diagonal());
  const Vec3 low = box.low - size, high = box.high + size;
  return {random.uniform(low[0], high[0]), random.uniform(low[1], high[1]), random.uniform(low[2], high[2])};
}

}  // namespace flank::internal::test
