/// Walls of pockets and bosses with draft, as faces.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "flank/face.h"
#include "flank/target.h"

namespace flank::internal::testing {

inline constexpr double kDraft = 10.0 * std::numbers::pi / 180.0, kHeight = 20.0;

inline BSplineSurface bilinear(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return {1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, 2, 2, {a, b, c, d}, {}};
}

/// From the foot line a, b to the head line c, d, seen from the side that `outside` lies on.
inline Face plane(const std::string& id, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                  const Vec3& outside) {
  Face face;
  face.id = id;
  face.surface = bilinear(a, b, c, d);
  face.of_solid = true;
  face.solid = 0;
  face.reversed = (c - a).cross(b - a).dot(outside - a) < 0.0;
  return face;
}

/// A quarter of a cone about a vertical axis through `centre` (the height is that of the foot), from `angle` on.
inline Face quarter(const std::string& id, const Vec3& centre, double foot_r, double head_r, double angle,
                    bool hollow) {
  const auto rim = [&](double r, double z, int k) {
    const double a = angle + 0.25 * k * std::numbers::pi, size = k == 1 ? r * std::sqrt(2.0) : r;
    return Vec3(centre.x() + size * std::cos(a), centre.y() + size * std::sin(a), centre.z() + z);
  };
  Face face;
  face.id = id;
  BSplineSurface& s = face.surface;
  s = {2, 1, {0, 0, 0, 1, 1, 1}, {0, 0, 1, 1}, 3, 2, {}, {}};
  for (int k = 0; k < 3; ++k)
    for (const bool head : {false, true}) {
      s.poles.push_back(rim(head ? head_r : foot_r, head ? kHeight : 0.0, k));
      s.weights.push_back(k == 1 ? std::sqrt(0.5) : 1.0);
    }
  face.of_solid = true;
  face.solid = 0;
  face.reversed = hollow;  // u goes round, v up: their product points away from the axis
  return face;
}

/// Half sizes of a rectangle with round corners; `lean`: how much wider each side is at the head (a pocket) or narrower (a boss).
struct Ring {
  double half_x = 20.0, half_y = 12.0, corner = 6.0;
  bool hollow = true;
  [[nodiscard]] double lean() const { return (hollow ? 1.0 : -1.0) * kHeight * std::tan(kDraft); }
};

/// Walls of the ring: four planes, and four cones where the corners are round. In no order.
inline std::vector<Face> walls_of(const Ring& ring) {
  std::vector<Face> faces;
  const bool round = ring.corner > 0.0;
  const Vec3 inside(0, 0, 0.5 * kHeight);
  const double grown = round ? 0.0 : ring.lean();
  for (int k = 0; k < 4; ++k) {
    const double a = 0.5 * k * std::numbers::pi;
    const Vec3 out(std::cos(a), std::sin(a), 0), along(-std::sin(a), std::cos(a), 0);
    const double far = k % 2 == 0 ? ring.half_x : ring.half_y,
                 wide = (k % 2 == 0 ? ring.half_y : ring.half_x) - ring.corner;
    const Vec3 foot = far * out, head = (far + ring.lean()) * out + kHeight * Vec3::UnitZ();
    const Vec3 seen = ring.hollow ? inside : Vec3(10.0 * far * out + inside);
    faces.push_back(plane("P" + std::to_string(k), foot - wide * along, foot + wide * along,
                          head - (wide + grown) * along, head + (wide + grown) * along, seen));
  }
  for (int k = 0; k < 4 && round; ++k) {
    const double a = 0.5 * k * std::numbers::pi, x = ring.half_x - ring.corner, y = ring.half_y - ring.corner;
    const Vec3 centre((k == 0 || k == 3) ? x : -x, k < 2 ? y : -y, 0.0);
    faces.push_back(quarter("C" + std::to_string(k), centre, ring.corner, ring.corner + ring.lean(), a, ring.hollow));
  }
  return faces;
}

}  // namespace flank::internal::testing
