#include "flank/bound/contact/free_ball.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace flank::internal {
namespace {

/// Directions about the point: two coordinates on the plane that touches the unit sphere at the normal, and half a width.
struct DirectionBox {
  double u, v, half;
};

}  // namespace

bool may_be_finished(const Vec3& point, const Vec3& normal, const std::vector<const Target*>& faces, double radius_mm,
                     double tolerance_mm, int boxes) {
  // Half a ball of directions: beyond it the ball would be sunk into the face itself by its whole radius. A direction is
  // a point of the plane, projected from the far pole, which stretches nothing by more than 2.
  const Vec3 across = normal.unitOrthogonal(), along = normal.cross(across);
  const auto direction = [&](double u, double v) {
    const double w = u * u + v * v;
    return Vec3(((1.0 - w) * normal + 2.0 * (u * across + v * along)) / (1.0 + w));
  };
  const auto distance = [&](const Vec3& centre) {
    double least = radius_mm;
    for (const Target* face : faces) {
      const Footpoint foot = face->closest_within(centre, least);
      if (foot.patch >= 0) least = std::min(least, (centre - foot.point).norm());
    }
    return least;
  };
  std::deque<DirectionBox> open = {{0.0, 0.0, 1.0}};
  for (int k = 0; !open.empty(); ++k) {
    if (k >= boxes) return true;
    const DirectionBox box = open.front();
    open.pop_front();
    const double depth = radius_mm - distance(point + radius_mm * direction(box.u, box.v));
    if (depth <= tolerance_mm) return true;
    // The centre of a ball in this box is no farther off than this.
    if (depth > 2.0 * tolerance_mm + 2.0 * std::sqrt(2.0) * box.half * radius_mm) continue;
    const double h = 0.5 * box.half;
    for (const double u : {-h, h})
      for (const double v : {-h, h}) open.push_back({box.u + u, box.v + v, h});
  }
  return false;
}

}  // namespace flank::internal
