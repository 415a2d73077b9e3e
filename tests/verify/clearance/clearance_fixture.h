/// Meshes, poses and brute force for the tests of clearances.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/random.h"
#include "flank/path.h"
#include "flank/triangle_mesh.h"

namespace flank::internal::verify {

/// Signed distance of (z, rho) to one profile that is convex: straight from the definition, by its own formulas.
inline double profile_distance(const std::vector<Vec2>& corners, double z, double rho) {
  std::vector<Vec2> outline{Vec2(corners.front().x(), 0.0)};
  outline.insert(outline.end(), corners.begin(), corners.end());
  outline.emplace_back(corners.back().x(), 0.0);
  bool inside = z >= corners.front().x() && z <= corners.back().x();
  for (std::size_t i = 0; i + 1 < corners.size() && inside; ++i) {
    const double a = corners[i].x(), b = corners[i + 1].x();
    if (z >= a && z <= b && b > a)
      inside = rho <= corners[i].y() + (corners[i + 1].y() - corners[i].y()) * (z - a) / (b - a);
  }
  double least = 1e300;
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    const Vec2 d = outline[i + 1] - outline[i], x(z - outline[i].x(), rho - outline[i].y());
    const double t = d.squaredNorm() > 0.0 ? std::clamp(x.dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
    least = std::min(least, (x - t * d).norm());
  }
  return inside ? -least : least;
}

/// Least signed distance of a triangle to a convex profile about the z axis, by golden sections one in the other.
template <class Distance>
double brute_triangle(const std::array<Vec3, 3>& v, const Distance& distance) {
  constexpr double kGolden = 0.6180339887498949;
  const auto golden = [](const auto& f) {
    double a = 0.0, b = 1.0, c = 1.0 - kGolden, d = kGolden, fc = f(c), fd = f(d);
    for (int i = 0; i < 55; ++i) {
      if (fc < fd)
        b = d, d = c, fd = fc, c = b - kGolden * (b - a), fc = f(c);
      else
        a = c, c = d, fc = fd, d = a + kGolden * (b - a), fd = f(d);
    }
    return std::min({fc, fd, f(0.0), f(1.0)});
  };
  return golden([&](double s) {
    return golden([&](double t) { return distance(v[0] + s * (v[1] - v[0] + t * (v[2] - v[1]))); });
  });
}

inline Vec3 random_point(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

inline Vec3 random_unit(Random& random) { return Vec3(random.normal(), random.normal(), random.normal()).normalized(); }

/// A square [-half, half]^2 at z = height, as two triangles.
inline TriangleMesh square(double half, double height) {
  return {{{-half, -half, height}, {half, -half, height}, {half, half, height}, {-half, half, height}},
          {{0, 1, 2}, {0, 2, 3}}};
}

inline Path path_of(std::vector<Pose> poses) {
  Strip strip;
  strip.poses = std::move(poses);
  return {{strip}};
}

}  // namespace flank::internal::verify
