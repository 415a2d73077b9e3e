/// Where an arc of a ring meets a swept volume: continuous in time, by Newton's method (MATH section 10).
#pragma once

#include <cmath>

#include "flank/trochoid/stock/swept_stock.h"

namespace flank::internal {

/// A circle in space: centre + radius (cos a * x + sin a * y); x and y orthonormal.
struct RingCircle {
  Vec3 centre, x, y;
  double radius = 0.0;
  [[nodiscard]] Vec3 direction(double angle) const { return std::cos(angle) * x + std::sin(angle) * y; }
  [[nodiscard]] Vec3 at(double angle) const { return centre + radius * direction(angle); }
};

/// A sweep as far as it counts, and the place in it to begin with.
struct SweepPlace {
  const Sweep* sweep = nullptr;
  double last = 0.0;  ///< places in [0, last] count
  double place = 0.0;
};

/// On which side of an end the circle is in the swept volume: at larger angles, or at smaller ones.
enum class Taken { kAbove, kBelow };

/// The angle near `angle` at which the circle leaves the volume that the sweep takes: gap and its derivative by time vanish
/// there. Where they vanish at another time, too, the iteration may go there: an end beyond which the sweep takes what it
/// should not, or does not take what it should, is looked for again by halving. Where there is none near, the guess is returned.
[[nodiscard]] double arc_end(const ToolProfile& profile, const RingCircle& circle, const SweepPlace& cover,
                             double angle, Taken taken);

/// Whether the sweep takes x at some time near a place.
[[nodiscard]] bool is_taken_near(const ToolProfile& profile, const SweepPlace& cover, const Vec3& x);

}  // namespace flank::internal
