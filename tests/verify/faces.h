/// Faces whose measures are known in closed form.
#pragma once

#include <cmath>

#include "flank/face.h"
#include "flank/geom/trim.h"

namespace flank::internal::test {

/// The rectangle [0, a] x [0, b] of the plane y = height, spanned by x and z.
inline Face plane_face(const std::string& id, double a, double b, double height = 0.0) {
  Face face;
  face.id = id;
  BSplineSurface& s = face.surface;
  s.degree_u = s.degree_v = 1;
  s.knots_u = s.knots_v = {0, 0, 1, 1};
  s.count_u = s.count_v = 2;
  s.poles = {Vec3(0, height, 0), Vec3(0, height, b), Vec3(a, height, 0), Vec3(a, height, b)};
  return face;
}

/// A quarter of a cylinder of the given radius about z, rational.
inline Face quarter_cylinder(const std::string& id, double radius, double height) {
  Face face;
  face.id = id;
  BSplineSurface& s = face.surface;
  s.degree_u = 2, s.degree_v = 1;
  s.knots_u = {0, 0, 0, 1, 1, 1};
  s.knots_v = {0, 0, 1, 1};
  s.count_u = 3, s.count_v = 2;
  const double w = std::sqrt(0.5);
  for (const Vec2& p : {Vec2(radius, 0), Vec2(radius, radius), Vec2(0, radius)}) {
    s.poles.push_back({p.x(), p.y(), 0.0});
    s.poles.push_back({p.x(), p.y(), height});
  }
  s.weights = {1, 1, w, w, 1, 1};
  return face;
}

/// A floor, [0, width] x [0, length] of the plane y = 0, and a wall as high at x = 0, one face with a sharp corner. Its outward
/// normal points into the corner, to +x and +y.
inline Face corner_face(const std::string& id, double width, double length) {
  Face face = plane_face(id, width, length);
  BSplineSurface& s = face.surface;
  s.knots_u = {0, 0, 0.5, 1, 1};
  s.count_u = 3;
  s.poles.insert(s.poles.begin(), {Vec3(0, width, 0), Vec3(0, width, length)});
  s.poles[2].x() = s.poles[3].x() = 0.0;
  face.reversed = true;
  return face;
}

/// A polygon as a loop of straight edges.
inline TrimLoop polygon(const std::vector<Vec2>& corners) {
  TrimLoop loop;
  for (std::size_t i = 0; i < corners.size(); ++i)
    loop.edges.push_back(straight_edge(corners[i], corners[(i + 1) % corners.size()]));
  return loop;
}

/// A full circle of four rational quarters.
inline TrimLoop circle(const Vec2& center, double radius) {
  TrimLoop loop;
  const Vec2 turn[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}};
  for (int i = 0; i < 4; ++i) {
    BSplineCurve2 edge;
    edge.degree = 2;
    edge.knots = {0, 0, 0, 1, 1, 1};
    edge.poles.resize(2, 3);
    edge.poles.col(0) = center + radius * turn[i];
    edge.poles.col(1) = center + radius * (turn[i] + turn[i + 1]);
    edge.poles.col(2) = center + radius * turn[i + 1];
    edge.weights = {1, std::sqrt(0.5), 1};
    loop.edges.push_back(edge);
  }
  return loop;
}

}  // namespace flank::internal::test
