/// Whether two balls of the path, each as it goes from one pose to the next, are near all of a cell together: where passes lie side by
/// side, the crest between them is near neither of them alone.
#pragma once

#include <span>

#include "flank/judge.h"
#include "flank/vec.h"

namespace flank::internal::verify {

/// All places that a ball comes within a tolerance of on its straight way. Convex: a hull is inside if its points are.
class Near {
 public:
  Near(const SweptVolume::BallWay& way, double tolerance_mm);
  [[nodiscard]] bool holds(const Vec3& p) const { return beyond(p) <= 0.0; }
  /// How far outside p is, mm; not above 0: inside.
  [[nodiscard]] double beyond(const Vec3& p) const { return (p - nearest(p)).norm() - reach_; }
  /// The place of the way that is nearest to p, and what it reaches from there, mm.
  [[nodiscard]] Vec3 nearest(const Vec3& p) const;
  [[nodiscard]] double reach() const { return reach_; }

 private:
  Vec3 from_, along_;
  double squared_ = 0.0, reach_ = 0.0;
};

/// Whether the convex hull of `points` lies inside `a` and `b` together. It is cut by the plane that is as near to the one way as to the
/// other about `middle`; each part is inside one of the two, or the answer is no. `sides`, of the same size, is room to compute in.
[[nodiscard]] bool hold_together(std::span<const Vec3> points, const Near& a, const Near& b, const Vec3& middle,
                                 std::span<double> sides);

}  // namespace flank::internal::verify
