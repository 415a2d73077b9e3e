/// Half of a blank's section along the wheel's axis.
#pragma once

#include <vector>

#include "flank/feature/wheel_axis.h"
#include "flank/vec.h"

namespace flank::internal {

/// The body that an outline makes when it is turned, as depths on a grid. Immutable.
class BlankSection {
 public:
  /// `outline`: along the axis and radius, mm, along the axis from one end to the other.
  BlankSection(const WheelAxis& axis, const std::vector<Vec2>& outline);
  /// How deep a place is in the body, mm; < 0: outside of it, by so much.
  [[nodiscard]] double depth(const Vec3& p) const;

 private:
  WheelAxis axis_;
  Vec2 low_ = Vec2::Zero();
  double cell_ = 1.0;
  int rows_ = 0, columns_ = 0;
  std::vector<float> depths_;
};

}  // namespace flank::internal
