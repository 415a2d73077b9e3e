// Faces and meshes through the points of a function over the unit square.
#pragma once

#include <cmath>
#include <vector>

#include "flank/face.h"
#include "flank/triangle_mesh.h"

namespace flank::internal::testing {

/// The bicubic face through at(u, v) on a grid; its normal is d/du x d/dv.
template <class Shape>
Face sheet(const Shape& at, int count_u = 13, int count_v = 13) {
  std::vector<double> u, v;
  for (int i = 0; i < count_u; ++i) u.push_back(static_cast<double>(i) / (count_u - 1));
  for (int j = 0; j < count_v; ++j) v.push_back(static_cast<double>(j) / (count_v - 1));
  std::vector<Vec3> points;
  for (const double a : u)
    for (const double b : v) points.push_back(at(a, b));
  Face face;
  face.id = "F1";
  face.surface = interpolate_grid(points, u, v, 3);
  return face;
}

/// The rectangle [x, x + width] x [y, y + depth] at z = 0, normal up.
inline Face rectangle(double x, double y, double width, double depth) {
  return sheet([=](double u, double v) { return Vec3(x + width * u, y + depth * v, 0.0); }, 4, 4);
}

/// A tube of this radius about the z axis, from z = 0 on, as a mesh whose outside is machined; closed round the axis.
inline TriangleMesh tube(double radius, double height, int sectors, int rings) {
  TriangleMesh mesh;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double angle = 2.0 * 3.14159265358979324 * j / sectors;
      mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height * i / rings);
    }
  const auto index = [=](int i, int j) { return i * sectors + j % sectors; };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      mesh.triangles.push_back({index(i, j), index(i, j + 1), index(i + 1, j)});
      mesh.triangles.push_back({index(i, j + 1), index(i + 1, j + 1), index(i + 1, j)});
    }
  return mesh;
}

/// The face moved by a turn about an axis through the origin and a shift.
inline Face moved(Face face, const Eigen::AngleAxisd& turn, const Vec3& shift) {
  for (Vec3& pole : face.surface.poles) pole = turn * pole + shift;
  return face;
}

}  // namespace flank::internal::testing
