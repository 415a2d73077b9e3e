/// Motions that tests of several folders use.
#pragma once

#include <cmath>
#include <vector>

#include "flank/base/random.h"
#include "flank/ruled_motion.h"

namespace flank::internal::testing {

/// A straight sweep with a constant axis: the tip runs from `from` by `travel`.
inline RuledMotion translation(const Vec3& from, const Vec3& travel, const Vec3& u, double axis_length) {
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int i = 0; i <= 20; ++i) {
    t.push_back(i / 20.0);
    poses.push_back({from + t.back() * travel, u.normalized()});
  }
  return fit_motion(poses, t, axis_length, 6);
}

/// A smooth motion of blade size that bends and twists, with a random wobble; |w| is not 1 between the knots.
inline RuledMotion random_motion(std::uint64_t seed, double axis_length = 40.0) {
  Random random(seed);
  constexpr int kCount = 9;
  RuledMotion motion;
  motion.axis_length = axis_length;
  motion.tip.knots = motion.direction.knots = uniform_knots(3, kCount);
  motion.tip.poles.resize(3, kCount);
  motion.direction.poles.resize(3, kCount);
  for (int i = 0; i < kCount; ++i) {
    const double x = static_cast<double>(i) / (kCount - 1);
    const Vec3 wobble(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    motion.tip.poles.col(i) = Vec3(80.0 * x, 12.0 * std::sin(2.5 * x), 4.0 * x * x) + 0.7 * wobble;
    motion.direction.poles.col(i) =
        Vec3(0.25 * std::sin(2.0 * x), 0.5 * x - 0.2, 1.0 + 0.1 * random.uniform(-1, 1)) + 0.02 * wobble;
  }
  return motion;
}

}  // namespace flank::internal::testing
