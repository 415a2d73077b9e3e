/// Closed skins, as aerofoils have them.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "flank/face.h"

namespace flank::internal::testing {

/// Exact circle in the parameter plane, of four rational quarter arcs, counter-clockwise.
inline TrimLoop circle_loop(double x, double y, double radius) {
  BSplineCurve2 c;
  c.degree = 2;
  c.knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  c.poles.resize(2, 9);
  for (int k = 0; k < 9; ++k) {
    const double angle = k * std::numbers::pi / 4, reach = k % 2 == 1 ? std::numbers::sqrt2 : 1.0;
    c.poles.col(k) = Eigen::Vector2d(x + radius * reach * std::cos(angle), y + radius * reach * std::sin(angle));
    c.weights.push_back(1 / reach);
  }
  return {{c}};
}

/// A section through points at equal steps of its parameter, drawn along Z and twisted about it on the way: u round the
/// section from 0 to 1, v along Z. `at(f)`: the point of the section at the share f of its way.
template <class Section>
Face drawn_skin(const Section& at, double height, double twist_rad, int steps = 120) {
  std::vector<double> u, v = {0.0, 0.25, 0.5, 0.75, 1.0};
  std::vector<Vec3> points;
  for (int i = 0; i <= steps; ++i) {
    u.push_back(static_cast<double>(i) / steps);
    const Vec3 p = i == steps ? at(0.0) : at(u.back());
    const bool closes = (at(1.0) - at(0.0)).norm() < 1e-9;
    const Vec3 q = closes ? p : at(u.back());
    for (const double f : v) {
      const double c = std::cos(f * twist_rad), s = std::sin(f * twist_rad);
      points.emplace_back(c * q.x() - s * q.y(), s * q.x() + c * q.y(), f * height);
    }
  }
  Face face;
  face.id = "F1";
  face.surface = interpolate_grid(points, u, v, 3);
  return face;
}

/// An ellipse of the given axes, from the middle of one of its flat sides on.
inline Face elliptic_skin(double chord, double thickness, double height, double twist_rad = 0.0) {
  return drawn_skin(
      [&](double f) {
        const double angle = (2.0 * f + 0.5) * std::numbers::pi;
        return Vec3(0.5 * chord * std::cos(angle), 0.5 * thickness * std::sin(angle), 0.0);
      },
      height, twist_rad);
}

}  // namespace flank::internal::testing
