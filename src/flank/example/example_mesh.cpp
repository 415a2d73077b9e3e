#include "flank/example/example_mesh.h"

#include <cmath>

#include "flank/envelope.h"
#include "flank/error.h"

namespace flank::internal {
namespace {

/// An ellipse in shares of the grid.
struct Hole {
  double t, s;      ///< centre, shares of the grid
  double radius_t;  ///< share of the grid
  [[nodiscard]] bool holds(double x, double y) const {
    return std::hypot((x - t) / radius_t, (y - s) / (1.5 * radius_t)) < 1.0;
  }
};
constexpr Hole kHoles[] = {{0.3, 0.55, 0.08}, {0.68, 0.4, 0.06}};

/// Vertices are numbered anew, in the order in which triangles name them.
TriangleMesh without_unused_vertices(const TriangleMesh& mesh) {
  TriangleMesh out;
  std::vector<int> number(mesh.vertices.size(), -1);
  for (const auto& triangle : mesh.triangles) {
    auto& copy = out.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      int& n = number[static_cast<std::size_t>(triangle[k])];
      if (n < 0) {
        n = static_cast<int>(out.vertices.size());
        out.vertices.push_back(mesh.vertices[static_cast<std::size_t>(triangle[k])]);
      }
      copy[k] = n;
    }
  }
  return out;
}

/// A normal distribution in each coordinate favours no direction.
Vec3 random_direction(Random& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return Vec3(x, y, z).normalized();
}

}  // namespace

TriangleMesh envelope_mesh(const RuledMotion& motion, const RadialFunction& radial, int count_t, int count_s) {
  TriangleMesh mesh;
  for (const ContactPoint& contact : sample_envelope(motion, radial, +1, count_t, count_s)) {
    if (!contact.exists) throw InternalError("an example has a gap in its surface");
    mesh.vertices.push_back(contact.point);
  }
  for (int i = 0; i + 1 < count_t; ++i) {
    for (int j = 0; j + 1 < count_s; ++j) {
      const int a = i * count_s + j, b = a + count_s;
      // E_t x E_s looks to the axis for contact side +1; the diagonals alternate so that no direction is favoured.
      if ((i + j) % 2 == 0) {
        mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({a, b + 1, a + 1});
      } else {
        mesh.triangles.push_back({a, b, a + 1});
        mesh.triangles.push_back({b, b + 1, a + 1});
      }
    }
  }
  return mesh;
}

TriangleMesh with_noise(TriangleMesh mesh, double length_mm, Random& random) {
  for (Vec3& vertex : mesh.vertices) vertex += length_mm * random_direction(random);
  return mesh;
}

TriangleMesh with_two_holes(const TriangleMesh& mesh, int count_t, int count_s) {
  TriangleMesh kept = mesh;
  kept.triangles.clear();
  for (const auto& triangle : mesh.triangles) {
    double t = 0.0, s = 0.0;
    for (const int vertex : triangle) {
      const int row = vertex / count_s, column = vertex % count_s;
      t += row / (3.0 * (count_t - 1));
      s += column / (3.0 * (count_s - 1));
    }
    // By the middle of the triangle: the rim of a hole is as ragged as that of a scanned one.
    if (!kHoles[0].holds(t, s) && !kHoles[1].holds(t, s)) kept.triangles.push_back(triangle);
  }
  return without_unused_vertices(kept);
}

}  // namespace flank::internal
