#include "flank/limit/least_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analytic_targets.h"
#include "flank/base/random.h"

namespace flank::internal {
namespace {

/// A ball of radius r beside a wall that stands on the floor, for a site x off the wall: it cuts both by e and leaves e, so
/// (r - e - x)^2 + (r - e)^2 = (r + e)^2.
double in_a_corner(double r, double x) {
  double low = 0.0, high = r;
  for (int k = 0; k < 200; ++k) {
    const double e = 0.5 * (low + high);
    (std::hypot(r - e - x, r - e) > r + e ? low : high) = e;
  }
  return low;
}

TEST(LeastError, BesideAWallIsThatOfTheFormula) {
  const PlaneTarget floor(Vec3::Zero(), Vec3::UnitZ()), wall(Vec3::Zero(), Vec3::UnitX());
  EXPECT_NEAR(in_a_corner(1.0, 0.0), (std::sqrt(2.0) - 1.0) / (std::sqrt(2.0) + 1.0), 1e-12);
  for (const double x : {0.0, 0.3, 1.0, 2.5}) {
    const LeastError error = least_error(Vec3(x, 7, 0), Vec3::UnitZ(), {.faces = {&floor, &wall}}, 5.0, {.gap = 0.02});
    EXPECT_LE(error.bound_mm, in_a_corner(5.0, x)) << x;
    EXPECT_GE(error.bound_mm, 0.975 * in_a_corner(5.0, x)) << x;
    EXPECT_GE(error.found_mm, in_a_corner(5.0, x)) << x;
    EXPECT_LE(error.found_mm, 1.025 * in_a_corner(5.0, x)) << x;
  }
}

TEST(LeastError, WhereABallTouchesFreelyIsNone) {
  const PlaneTarget floor(Vec3::Zero(), Vec3::UnitZ()), wall(Vec3::Zero(), Vec3::UnitX());
  const SphereTarget hill(4.0, +1), hollow(4.0, -1);
  EXPECT_EQ(least_error(Vec3(6, 0, 0), Vec3::UnitZ(), {.faces = {&floor, &wall}}, 5.0, {}).bound_mm, 0.0);
  EXPECT_EQ(least_error(Vec3(0, 0, 4), Vec3::UnitZ(), {.faces = {&hill}}, 5.0, {}).bound_mm, 0.0);
  EXPECT_EQ(least_error(Vec3(0, 0, 4), -Vec3::UnitZ(), {.faces = {&hollow}}, 3.9, {}).bound_mm, 0.0);
}

/// In the middle a ball of radius r cuts a hollow of radius R < r by r - R on all sides; off it, deeper.
TEST(LeastError, InAHollowThatIsTooNarrowIsTheDifferenceOfTheRadii) {
  const SphereTarget hollow(4.5, -1);
  const LeastError error = least_error(Vec3(0, 4.5, 0), -Vec3::UnitY(), {.faces = {&hollow}}, 5.0, {.gap = 0.02});
  EXPECT_LE(error.bound_mm, 0.5);
  EXPECT_GE(error.bound_mm, 0.4875);
  EXPECT_NEAR(error.centre.norm(), 0.0, 0.05);
}

/// Balls at random, and larger ones that hold a smaller ball: none does better than the bound.
TEST(LeastError, IsNotReachedByAnyBall) {
  const PlaneTarget floor(Vec3::Zero(), Vec3::UnitZ()), wall(Vec3(-0.2, 0, 0), Vec3(1, 0.2, 0.3)),
      other(Vec3(0, -0.5, 0), Vec3(0.1, 1, -0.2));
  const BallScene faces{.faces = {&floor, &wall, &other}};
  const Vec3 site(0.1, 0.2, 0.0);
  const LeastError error = least_error(site, Vec3::UnitZ(), faces, 3.0, {});
  ASSERT_GT(error.bound_mm, 0.05);
  Random random(3);
  double best = 1e9;
  for (int k = 0; k < 20000; ++k) {
    const double r = 3.0 + (k % 2) * random.uniform(0.0, 2.0);
    const Vec3 centre =
        error.centre + random.uniform(0.0, 1.5) * Vec3(random.normal(), random.normal(), random.normal());
    if (centre.z() < -1.5) continue;
    double worst = (centre - site).norm() - r;
    for (const Target* face : faces.faces) worst = std::max(worst, r - std::abs(face->closest(centre).distance));
    best = std::min(best, worst);
  }
  EXPECT_GE(best, error.bound_mm);
  EXPECT_LT(best, 2.0 * error.bound_mm);  // else nothing near was tried
}

TEST(LeastError, GrowsWithTheRadiusAndEndsEarlyWhereItIsEnough) {
  const PlaneTarget floor(Vec3::Zero(), Vec3::UnitZ()), wall(Vec3::Zero(), Vec3::UnitX());
  double before = 0.0;
  for (const double radius : {1.0, 2.0, 4.0}) {
    const LeastError error = least_error(Vec3::Zero(), Vec3::UnitZ(), {.faces = {&floor, &wall}}, radius, {});
    EXPECT_GT(error.bound_mm, before);
    before = error.found_mm;
    EXPECT_LT(
        least_error(Vec3::Zero(), Vec3::UnitZ(), {.faces = {&floor, &wall}}, radius, {.enough_mm = 0.3 * radius}).cubes,
        error.cubes);
  }
}

}  // namespace
}  // namespace flank::internal
