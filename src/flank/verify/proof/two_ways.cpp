#include "flank/verify/proof/two_ways.h"

#include <algorithm>

#include "flank/base/assert.h"

namespace flank::internal::verify {

Near::Near(const SweptVolume::BallWay& way, double tolerance_mm)
    : from_(way.from),
      along_(way.along),
      squared_(way.along.squaredNorm()),
      reach_(way.radius + tolerance_mm - way.off) {}

Vec3 Near::nearest(const Vec3& p) const {
  const double t = squared_ > 0.0 ? std::clamp((p - from_).dot(along_) / squared_, 0.0, 1.0) : 0.0;
  return from_ + t * along_;
}

// The part on one side of the plane is the hull of the points on that side and of where lines to the others cross the plane.
bool hold_together(std::span<const Vec3> points, const Near& a, const Near& b, const Vec3& middle,
                   std::span<double> sides) {
  FLANK_ASSERT(sides.size() == points.size());
  const Vec3 at_a = a.nearest(middle), at_b = b.nearest(middle), across = 2.0 * (at_b - at_a);
  const double same = at_b.squaredNorm() - at_a.squaredNorm() + a.reach() * a.reach() - b.reach() * b.reach();
  for (std::size_t i = 0; i < points.size(); ++i) {
    sides[i] = across.dot(points[i]) - same;
    if (!(sides[i] <= 0.0 ? a : b).holds(points[i])) return false;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < points.size() && sides[i] <= 0.0; ++j) {
      if (sides[j] <= 0.0) continue;
      const Vec3 crossing = points[i] + (sides[i] / (sides[i] - sides[j])) * (points[j] - points[i]);
      if (!a.holds(crossing) || !b.holds(crossing)) return false;
    }
  }
  return true;
}

}  // namespace flank::internal::verify
