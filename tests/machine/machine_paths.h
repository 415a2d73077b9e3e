/// Paths for tests of machines.
#pragma once

#include <cmath>
#include <vector>

#include "flank/path.h"

namespace flank::internal::paths {

/// A strip along a twisted ruling, about 60 mm long, whose axis leans and turns by some 50 degrees.
inline Path twisted(int poses) {
  Path path;
  Strip strip{1, "flank", "F1", {}};
  for (int k = 0; k < poses; ++k) {
    const double t = poses > 1 ? static_cast<double>(k) / (poses - 1) : 0.0;
    const Vec3 axis(0.45 + 0.3 * std::sin(2.0 * t), 0.6 * t - 0.2, 0.8);
    strip.poses.push_back({Vec3(60.0 * t - 30.0, 12.0 * std::sin(3.0 * t), 6.0 * t * t), axis.normalized()});
  }
  path.strips.push_back(strip);
  return path;
}

/// A strip whose axis passes the spindle's direction at the distance `miss` (sine), leaning by 15 degrees on either side.
inline Path across_the_cone(int poses, double miss) {
  Path path;
  Strip strip{1, "flank", "F1", {}};
  for (int k = 0; k < poses; ++k) {
    const double t = static_cast<double>(k) / (poses - 1);
    const Vec3 axis(std::sin((t - 0.5) * 0.52), miss, 1.0);
    strip.poses.push_back({Vec3(40.0 * t - 20.0, 10.0, 5.0), axis.normalized()});
  }
  path.strips.push_back(strip);
  return path;
}

}  // namespace flank::internal::paths
