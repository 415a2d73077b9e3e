#include "flank/fit/model/plunge.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {

Plunge plunge(const Vec3& velocity, const Vec3& axis, double slope) {
  /// A tool that is steeper than any is judged as this steep: its own bound pulls it back.
  constexpr double kSteepest = 0.99;
  const double tangent = std::min(std::abs(slope), kSteepest);
  const double along = velocity.dot(axis);
  const Vec3 across = velocity - along * axis;
  const double factor = tangent / std::sqrt(1.0 - tangent * tangent);
  Plunge out;
  const double speed = across.norm();
  out.excess = factor * std::abs(along) - kMostPlunge * speed;
  if (!(out.excess > 0.0)) return {};
  out.gradient = (along > 0.0 ? factor : -factor) * axis;
  if (speed > 0.0) out.gradient -= kMostPlunge / speed * across;
  return out;
}

}  // namespace flank::internal
