/// A small upright tool along the face y = 0 of a block: before it, or inside.
#pragma once

#include "flank/path.h"
#include "flank/tool.h"

namespace flank::internal::testing {

inline constexpr double kRadius = 1.0, kLength = 8.0;

inline Tool cylinder() {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius));
  return tool;
}

/// Along x at z from 6, upright, at y.
inline Strip along(double y) {
  Strip strip;
  for (int k = 0; k <= 10; ++k) strip.poses.push_back({Vec3(3.0 + 3.4 * k, y, 6.0), Vec3::UnitZ()});
  return strip;
}

}  // namespace flank::internal::testing
