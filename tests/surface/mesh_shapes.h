/// Meshes of known surfaces, for tests.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "flank/base/random.h"
#include "flank/triangle_mesh.h"

namespace flank::internal::shapes {

/// Vertices exactly on S(u, v) over a grid of nu x nv cells of [0, 1]^2; `wrap_u`, `wrap_v`: the last row is the first
/// one. Normal S_u x S_v.
inline TriangleMesh grid(int nu, int nv, const std::function<Vec3(double, double)>& surface, bool wrap_u = false,
                         bool wrap_v = false) {
  TriangleMesh mesh;
  const int rows = wrap_u ? nu : nu + 1, columns = wrap_v ? nv : nv + 1;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) mesh.vertices.push_back(surface(double(i) / nu, double(j) / nv));
  const auto at = [&](int i, int j) { return (i % rows) * columns + j % columns; };
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// Sphere of radius r as a cube of 6 n^2 cells blown up: 6 n^2 + 2 vertices.
inline TriangleMesh sphere(double r, int n) {
  TriangleMesh mesh;
  std::vector<std::vector<int>> ids;
  const auto spread = [](double x) { return std::tan(x * std::numbers::pi / 4.0); };
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, sign = face % 2 == 0 ? 1 : -1;
    const int start = static_cast<int>(mesh.vertices.size());
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        Vec3 x;
        x[axis] = sign;
        x[(axis + 1) % 3] = i == 0 ? -1.0 : i == n ? 1.0 : spread(2.0 * i / n - 1.0);
        x[(axis + 2) % 3] = j == 0 ? -1.0 : j == n ? 1.0 : spread(2.0 * j / n - 1.0);
        mesh.vertices.push_back(r * x.normalized());
      }
    }
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const int a = start + i * (n + 1) + j, b = a + n + 1;
        if (sign > 0) {
          mesh.triangles.push_back({a, b, b + 1});
          mesh.triangles.push_back({a, b + 1, a + 1});
        } else {
          mesh.triangles.push_back({a, b + 1, b});
          mesh.triangles.push_back({a, a + 1, b + 1});
        }
      }
    }
  }
  return mesh;
}

inline Vec3 torus_point(double R, double r, double u, double v) {
  const double a = 2.0 * std::numbers::pi * u, b = 2.0 * std::numbers::pi * v;
  return {(R + r * std::cos(b)) * std::cos(a), (R + r * std::cos(b)) * std::sin(a), r * std::sin(b)};
}

inline TriangleMesh torus(double R, double r, int nu, int nv) {
  return grid(
      nu, nv, [=](double u, double v) { return torus_point(R, r, u, v); }, true, true);
}

/// A twisted, graph-like patch of about 40 x 60 mm.
inline Vec3 twisted_point(double u, double v) {
  const double x = 40.0 * (u - 0.5), y = 60.0 * (v - 0.5), angle = 0.6 * y / 60.0;
  const double z = 3.0 * std::sin(x / 14.0) + 2.0 * std::cos(y / 17.0);
  return {x * std::cos(angle) - z * std::sin(angle), y, x * std::sin(angle) + z * std::cos(angle)};
}

inline TriangleMesh twisted(int n) { return grid(n, n, twisted_point); }

/// The saddle z = x y / radius over [-size, size]^2.
inline TriangleMesh saddle(double size, double radius, int n) {
  return grid(n, n, [=](double u, double v) {
    const double x = size * (2.0 * u - 1.0), y = size * (2.0 * v - 1.0);
    return Vec3(x, y, x * y / radius);
  });
}

/// Adds normal noise of standard deviation sigma to every coordinate.
inline void shake(TriangleMesh& mesh, double sigma, std::uint64_t seed) {
  Random random(seed);
  for (Vec3& x : mesh.vertices) x += sigma * Vec3(random.normal(), random.normal(), random.normal());
}

/// Removes the triangles whose centre satisfies `gone`.
inline void cut(TriangleMesh& mesh, const std::function<bool(const Vec3&)>& gone) {
  std::erase_if(mesh.triangles, [&](const std::array<int, 3>& t) {
    return gone((mesh.vertices[static_cast<std::size_t>(t[0])] + mesh.vertices[static_cast<std::size_t>(t[1])] +
                 mesh.vertices[static_cast<std::size_t>(t[2])]) /
                3.0);
  });
}

}  // namespace flank::internal::shapes
