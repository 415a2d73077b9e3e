/// Faces whose areas are known in closed form, as exact rational B-splines, and their way through a STEP file.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "flank/io/cad/triangulate.h"
#include "flank/io/cad/write_step.h"
#include "io/part_files.h"
#include "verify/faces.h"

namespace flank::internal::testing_io {

/// A quarter turn about z of the rational quadratic through (rho, z, weight) in the half plane.
inline Face quarter_turn(const std::string& id, const std::vector<Vec3>& meridian, const std::vector<double>& knots,
                         int degree) {
  const double w = std::sqrt(0.5);
  const std::array<Vec3, 3> turn = {Vec3(1, 0, 1), Vec3(1, 1, w), Vec3(0, 1, 1)};
  Face face;
  face.id = id;
  BSplineSurface& s = face.surface;
  s.degree_u = 2, s.count_u = 3, s.knots_u = {0, 0, 0, 1, 1, 1};
  s.degree_v = degree, s.count_v = static_cast<int>(meridian.size()), s.knots_v = knots;
  for (const Vec3& t : turn) {
    for (const Vec3& m : meridian) {
      s.poles.emplace_back(m.x() * t.x(), m.x() * t.y(), m.y());
      s.weights.push_back(m.z() * t.z());
    }
  }
  return face;
}

inline const std::vector<double> kOneArc = {0, 0, 0, 1, 1, 1};

/// An eighth of a sphere; its upper border is one point.
inline Face octant(double r) { return quarter_turn("F1", {{r, 0, 1}, {r, r, std::sqrt(0.5)}, {0, r, 1}}, kOneArc, 2); }
/// A quarter of the upper outer quarter of a torus.
inline Face torus_patch(double ring, double tube) {
  return quarter_turn("F1", {{ring + tube, 0, 1}, {ring + tube, tube, std::sqrt(0.5)}, {ring, tube, 1}}, kOneArc, 2);
}
inline Face cone_patch(double low, double high, double height) {
  return quarter_turn("F1", {{low, 0, 1}, {high, height, 1}}, {0, 0, 1, 1}, 1);
}

inline Part through_step(const std::vector<Face>& faces) {
  const Scratch scratch;
  write_step(scratch.path("faces.step"), faces);
  return read_part(scratch.path("faces.step"));
}

inline double triangle_area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    sum += 0.5 * (mesh.vertices[static_cast<std::size_t>(t[1])] - a)
                     .cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a)
                     .norm();
  }
  return sum;
}

inline double area_of(const Face& face, double deviation_mm = 1e-3) {
  return triangle_area(triangulate_face(face, deviation_mm).mesh);
}

/// Enclosed by the loop in the parameter plane, by the trapezoidal rule; negative if it runs clockwise.
inline double enclosed(const TrimLoop& loop) {
  double twice = 0.0;
  for (const BSplineCurve2& edge : loop.edges) {
    Vec2 before = edge.value(edge.first());
    for (int i = 1; i <= 2000; ++i) {
      const Vec2 p = edge.value(edge.first() + (edge.last() - edge.first()) * i / 2000);
      twice += before.x() * p.y() - p.x() * before.y();
      before = p;
    }
  }
  return 0.5 * twice;
}

}  // namespace flank::internal::testing_io
