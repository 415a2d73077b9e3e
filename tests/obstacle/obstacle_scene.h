// A blade that stands on a hub, as flat faces: what clearance, seed and fit are tried on.
#pragma once

#include <memory>
#include <vector>

#include "flank/obstacle_field.h"

namespace flank::internal::testing {

/// A bilinear face; its normal is du x dv.
inline Face quad(const Vec3& p00, const Vec3& p10, const Vec3& p01, const Vec3& p11, const std::string& id) {
  Face face;
  face.id = id;
  face.surface.degree_u = face.surface.degree_v = 1;
  face.surface.knots_u = face.surface.knots_v = {0.0, 0.0, 1.0, 1.0};
  face.surface.count_u = face.surface.count_v = 2;
  face.surface.poles = {p00, p01, p10, p11};
  return face;
}

/// The target: the plane y = 0, x from 0 to 60, z from `bottom` to 40, machined from y > 0.
inline std::unique_ptr<Target> standing_blade(double bottom) {
  return make_target({quad(Vec3(60, 0, bottom), Vec3(0, 0, bottom), Vec3(60, 0, 40), Vec3(0, 0, 40), "F1")});
}

/// The hub: the plane z = 0 with its normal up, far past the blade; `turned` points it down.
inline ObstacleFace hub(bool oriented, bool turned = false) {
  Face face = quad(Vec3(-50, -50, 0), Vec3(110, -50, 0), Vec3(-50, 50, 0), Vec3(110, 50, 0), "F2");
  face.reversed = turned;
  return {make_target({face}), oriented};
}

/// Plates across the blade's ends, at x = 0 and x = 60, seen from between them.
inline Obstacles plates() {
  const Face low = quad(Vec3(0, -50, -50), Vec3(0, 50, -50), Vec3(0, -50, 90), Vec3(0, 50, 90), "F3");
  const Face high = quad(Vec3(60, -50, -50), Vec3(60, -50, 90), Vec3(60, 50, -50), Vec3(60, 50, 90), "F4");
  Obstacles obstacles;
  for (const Face& plate : {low, high}) obstacles.faces.push_back({make_target({plate}), true});
  return obstacles;
}

inline Obstacles only(ObstacleFace face) {
  Obstacles obstacles;
  obstacles.faces.push_back(std::move(face));
  return obstacles;
}

}  // namespace flank::internal::testing
