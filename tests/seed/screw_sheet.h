/// Faces that a motion moves along themselves, with that motion.
#pragma once

#include <cmath>
#include <memory>

#include "flank/seed/self_motion.h"
#include "flank/target.h"
#include "seed/sheet.h"

namespace flank::internal::testing {

inline constexpr double kScrewTurn = 1.2, kScrewLead = 60.0;  ///< radians over the whole face; mm

/// A bent profile that is screwed about the z axis: u goes across, v with the screw. The ends are cut off askew.
inline Vec3 on_screw(double u, double v) {
  const double radius = 25.0 + 16.0 * u - 2.0 * u * u, angle = 0.1 * u * u + kScrewTurn * (v - 0.2 * u);
  return {radius * std::cos(angle), radius * std::sin(angle), kScrewLead * (v - 0.2 * u) + 3.0 * u};
}

inline std::unique_ptr<Target> screw_target() {
  Face face = sheet(on_screw, 17, 33);
  return make_target({face});
}

/// The screw, by formula.
inline SelfMotion screw_motion() {
  SelfMotion motion;
  motion.turn = kScrewTurn * Vec3::UnitZ();
  motion.slide = kScrewLead * Vec3::UnitZ();
  return motion;
}

}  // namespace flank::internal::testing
