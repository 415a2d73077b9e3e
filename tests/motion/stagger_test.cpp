// Closed forms: axes that lean apart by an angle, along the way and across it.
#include "flank/motion/stagger.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fit/flat_scene.h"

namespace flank::internal {
namespace {

/// At height y, leaning by an angle along the way and by another one across it.
RuledMotion leaning(double y, double along, double across = 0.0) {
  RuledMotion motion = testing::upright_motion({.y = y});
  motion.direction.poles.colwise() = Vec3(std::sin(along), std::sin(across), std::cos(along)).normalized();
  return motion;
}

TEST(Stagger, IsWhatTheAxesDifferAlongTheWay) {
  EXPECT_NEAR(stagger(leaning(0.0, 0.1), leaning(20.0, -0.1)), std::sin(0.1), 1e-12);
  EXPECT_NEAR(stagger(leaning(0.0, 0.2), leaning(20.0, 0.2)), 0.0, 1e-12) << "parallel";
  EXPECT_NEAR(stagger(leaning(0.0, 0.0, 0.2), leaning(20.0, 0.0, -0.3)), 0.0, 1e-12) << "a cavity that opens upwards";
}

TEST(Stagger, OfSeveralPairsIsTheMean) {
  const std::vector<RuledMotion> motions = {leaning(0.0, 0.1), leaning(20.0, -0.1), leaning(0.0, 0.0),
                                            leaning(20.0, 0.0)};
  EXPECT_NEAR(mean_stagger(motions), 0.5 * std::sin(0.1), 1e-12);
}

TEST(Stagger, LeanIsThatOfEveryMotionByItself) {
  const std::vector<RuledMotion> motions = {leaning(0.0, 0.1, 0.3), leaning(20.0, -0.1, 0.3)};
  EXPECT_NEAR(mean_lean(motions), std::sin(0.1) / std::sqrt(1.0 + std::sin(0.3) * std::sin(0.3)), 1e-12);
  EXPECT_EQ(mean_lean({}), 0.0);
}

}  // namespace
}  // namespace flank::internal
