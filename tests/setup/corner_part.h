/// A part with one fillet.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "flank/part.h"
#include "geom/skins.h"

namespace flank::internal::testing {

/// A floor, a round corner of this radius that bends up from it, and a wall, drawn along Z, of one solid that lies below the floor
/// (`hollow`) or above it.
inline Part corner(bool hollow, double radius = 5.0) {
  const auto line = [](Vec3 a, Vec3 b) { return [=](double f) { return Vec3(a + f * (b - a)); }; };
  const auto arc = [radius](double f) {
    const double angle = f * std::numbers::pi / 2;
    return Vec3(20.0 + radius * std::sin(angle), radius - radius * std::cos(angle), 0.0);
  };
  Part part;
  const auto add = [&](const auto& section) {
    Face face = drawn_skin(section, 30.0, 0.0, 40);
    face.id = "F" + std::to_string(part.faces.size() + 1);
    face.of_solid = true;
    face.solid = 0;
    const SurfaceJet jet = face.surface.jet(face.surface.u_first(), face.surface.v_first());
    // Towards the middle of the arc, from the floor, the arc and the wall alike: the room that a tool comes from.
    const Vec3 inwards = Vec3(20.0, radius, 0.0) - Vec3(jet.p.x(), jet.p.y(), 0.0);
    const bool towards = jet.du.cross(jet.dv).dot(inwards) > 0.0;
    face.reversed = towards != hollow;
    part.faces.push_back(face);
    part.surface_types.emplace_back("B-spline");
    for (const Vec3& p : face.surface.poles) part.box.add(p);
  };
  add(line({0, 0, 0}, {20, 0, 0}));
  add(arc);
  add(line({20 + radius, radius, 0}, {20 + radius, 30, 0}));
  return part;
}

}  // namespace flank::internal::testing
