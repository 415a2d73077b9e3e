#include "flank/bound/contact/free_ball.h"

#include <gtest/gtest.h>

#include "analytic_targets.h"

namespace flank::internal {
namespace {

TEST(FreeBall, TouchesAPlainFaceEverywhere) {
  const PlaneTarget floor(Vec3::Zero(), Vec3::UnitZ());
  EXPECT_TRUE(may_be_finished(Vec3(1, 2, 0), Vec3::UnitZ(), {&floor}, 5.0, 0.01));
}

TEST(FreeBall, DoesNotComeNearerToAWallThanItsRadius) {
  const PlaneTarget floor(Vec3::Zero(), Vec3::UnitZ()), wall(Vec3::Zero(), Vec3::UnitX());
  for (const double x : {0.5, 3.0, 4.3})
    EXPECT_FALSE(may_be_finished(Vec3(x, 0, 0), Vec3::UnitZ(), {&floor, &wall}, 5.0, 0.01)) << x;
  // Within the tolerance a ball may touch a little beside its lowest point: 4.3 is far enough off for a proof, 4.9 is reached.
  for (const double x : {4.9, 5.0, 8.0})
    EXPECT_TRUE(may_be_finished(Vec3(x, 0, 0), Vec3::UnitZ(), {&floor, &wall}, 5.0, 0.01)) << x;
}

TEST(FreeBall, OfALargerRadiusThanTheHollowTouchesNowhere) {
  const SphereTarget hollow(4.0, -1);
  EXPECT_FALSE(may_be_finished(Vec3(0, 0, 4), Vec3(0, 0, -1), {&hollow}, 5.0, 0.01));
  EXPECT_TRUE(may_be_finished(Vec3(0, 0, 4), Vec3(0, 0, -1), {&hollow}, 3.9, 0.01));
}

}  // namespace
}  // namespace flank::internal
