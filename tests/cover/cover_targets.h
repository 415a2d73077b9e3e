/// What the tests of this folder cover.
#pragma once

#include <memory>

#include "flank/example.h"
#include "flank/obstacle/pose_guard.h"
#include "seed/exact_targets.h"

namespace flank::internal::testing {

/// The exact envelope of a barrel 40 mm long, and the middle 24 mm of that barrel: the surface is longer than the tool.
struct LongSurface {
  ExactTarget exact = barrel_target();
  double first = 8.0;  ///< of the short tool's s = 0 on the long axis
  RadialFunction tool = RadialFunction(ToolFamily::kBarrel, 24.0, Eigen::Vector3d(160.0, 6.0, 10.0));

  [[nodiscard]] Pose pose(double t) const {
    const Pose whole = exact.motion.pose(t);
    return {whole.at(first), whole.axis};
  }
};

inline Tool cylinder(double radius, double length) {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, length, Eigen::VectorXd::Constant(1, radius));
  return tool;
}

/// A flat bicubic sheet over [x0, x1] x [y0, y1] at height z, normal up.
inline Face flat_face(double x0, double x1, double y0, double y1, double z) {
  std::vector<double> u = {0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0};
  std::vector<Vec3> points;
  for (const double a : u)
    for (const double b : u) points.emplace_back(x0 + a * (x1 - x0), y0 + b * (y1 - y0), z);
  Face face;
  face.id = "F1";
  face.surface = interpolate_grid(points, u, u, 3);
  return face;
}

inline std::unique_ptr<Target> flat_target(double x0, double x1, double y0, double y1) {
  return make_target(std::vector<Face>{flat_face(x0, x1, y0, y1, 0.0)});
}

/// One large triangle.
inline Obstacles triangle_obstacle(const Vec3& a, const Vec3& b, const Vec3& c) {
  Obstacles obstacles;
  ObstacleMesh surface;
  surface.mesh = {{a, b, c}, {{0, 1, 2}}};
  obstacles.meshes.push_back(surface);
  return obstacles;
}
/// A wall across a flat target, at this y.
inline Obstacles wall_at(double y) {
  return triangle_obstacle(Vec3(-90.0, y, -1.0), Vec3(140.0, y, -1.0), Vec3(25.0, y, 120.0));
}
/// A lid over a flat target, at this z.
inline Obstacles lid_at(double z) {
  return triangle_obstacle(Vec3(-200.0, -200.0, z), Vec3(300.0, -200.0, z), Vec3(0.0, 400.0, z));
}

}  // namespace flank::internal::testing
