#include "flank/verify/clearance/revolved.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/base/random.h"
#include "verify/clearance/clearance_fixture.h"

namespace flank::internal::verify {
namespace {

const std::vector<std::vector<Vec2>> kProfiles = {{{0, 4}, {30, 4}},
                                                  {{10, 2}, {40, 9}},
                                                  {{10, 9}, {40, 0}},
                                                  {{0, 3}, {5, 6}, {20, 8}, {30, 8}, {34, 2}},
                                                  {{-20, 0}, {0, 12}, {20, 0}}};

TEST(Revolved, DistanceIsThatOfTheOutline) {
  Random random(3);
  for (const auto& profile : kProfiles) {
    const Revolved body(profile);
    int inside = 0;
    for (int i = 0; i < 4000; ++i) {
      const double z = random.uniform(-40.0, 60.0), rho = random.uniform(0.0, 30.0);
      const double wanted = profile_distance(profile, z, rho);
      inside += wanted < 0.0;
      ASSERT_NEAR(body.value(z, rho), wanted, 1e-12) << z << ' ' << rho;
    }
    EXPECT_GT(inside, 50);
  }
}

TEST(Revolved, DepthIsTheDistanceToTheNearestSide) {
  const Revolved cylinder({{0, 4}, {30, 4}});
  EXPECT_NEAR(cylinder.value(15.0, 0.0), -4.0, 1e-15);
  EXPECT_NEAR(cylinder.value(1.0, 0.0), -1.0, 1e-15);
  EXPECT_NEAR(cylinder.value(29.5, 3.0), -0.5, 1e-15);
  EXPECT_NEAR(cylinder.value(15.0, 3.25), -0.75, 1e-15);
  const double slope = 7.0 / 30.0;
  EXPECT_NEAR(Revolved({{10, 2}, {40, 9}}).value(25.0, 1.0), -(2.0 + slope * 15.0 - 1.0) / std::hypot(1.0, slope),
              1e-14);
}

TEST(Revolved, ASingleCornerOnTheAxisIsABall) {
  const Revolved ball({{5.0, 0.0}}, 3.0);
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    const double z = random.uniform(-10.0, 20.0), rho = random.uniform(0.0, 15.0);
    const ProfileDistance d = ball.distance(z, rho);
    const double r = std::hypot(z - 5.0, rho);
    ASSERT_NEAR(d.value, r - 3.0, 1e-13);
    ASSERT_NEAR(d.dz, (z - 5.0) / r, 1e-13);
    ASSERT_NEAR(d.drho, rho / r, 1e-13);
    ASSERT_NEAR(d.corner, 1.0 / r, 1e-12) << "a sphere about the corner bends by one over its radius";
  }
  EXPECT_EQ(ball.value(5.0, 0.0), -3.0);
  EXPECT_NEAR(std::hypot(ball.distance(5.0, 0.0).dz, ball.distance(5.0, 0.0).drho), 1.0, 1e-15);
}

TEST(Revolved, ASingleCornerOffTheAxisIsADisc) {
  const Revolved disc({{5.0, 7.0}});
  EXPECT_NEAR(disc.value(9.0, 2.0), 4.0, 1e-15);
  EXPECT_NEAR(disc.value(2.0, 6.9), 3.0, 1e-15);
  EXPECT_NEAR(disc.value(8.0, 11.0), 5.0, 1e-15);
  EXPECT_NEAR(disc.value(5.0, 3.0), 0.0, 1e-15) << "a disc has no inside";
}

TEST(Revolved, RoundingGrowsTheBodyEverywhere) {
  Random random(5);
  for (const auto& profile : kProfiles) {
    const Revolved sharp(profile), round(profile, 1.5);
    for (int i = 0; i < 500; ++i) {
      const double z = random.uniform(-40.0, 60.0), rho = random.uniform(0.0, 30.0);
      ASSERT_NEAR(round.value(z, rho), sharp.value(z, rho) - 1.5, 1e-13);
    }
  }
}

TEST(Revolved, GradientIsAUnitVectorAndTheSlopeOfTheValue) {
  constexpr double kStep = 1e-6;
  Random random(6);
  for (const auto& profile : kProfiles) {
    const Revolved body(profile, 0.5);
    int looked = 0;
    for (int i = 0; i < 2000; ++i) {
      const double z = random.uniform(-40.0, 60.0), rho = random.uniform(0.1, 30.0);
      const ProfileDistance d = body.distance(z, rho);
      ASSERT_NEAR(std::hypot(d.dz, d.drho), 1.0, 1e-12);
      const double dz = (body.value(z + kStep, rho) - body.value(z - kStep, rho)) / (2.0 * kStep);
      const double dr = (body.value(z, rho + kStep) - body.value(z, rho - kStep)) / (2.0 * kStep);
      if (std::abs(std::hypot(dz, dr) - 1.0) > 1e-6) continue;  // across a crease inside
      ++looked;
      ASSERT_NEAR(dz, d.dz, 1e-5) << z << ' ' << rho;
      ASSERT_NEAR(dr, d.drho, 1e-5) << z << ' ' << rho;
    }
    EXPECT_GT(looked, 1900);
  }
}

TEST(Revolved, ValueIsConvexInSpace) {
  Random random(7);
  for (const auto& profile : kProfiles) {
    const Revolved body(profile);
    const auto at = [&](const Vec3& x) { return body.value(x.z(), std::hypot(x.x(), x.y())); };
    for (int i = 0; i < 2000; ++i) {
      const Vec3 a = random_point(random, 30.0), b = random_point(random, 30.0);
      const double t = random.uniform();
      ASSERT_LE(at((1.0 - t) * a + t * b), (1.0 - t) * at(a) + t * at(b) + 1e-12);
    }
  }
}

TEST(Revolved, SupportIsTheCornerFarthestInTheDirection) {
  Random random(8);
  for (const auto& profile : kProfiles) {
    const Revolved body(profile);
    for (int i = 0; i < 200; ++i) {
      const double angle = random.uniform(-1.5707, 1.5707), along = std::sin(angle), across = std::cos(angle);
      double most = -1e300;
      for (const Vec2& c : profile) most = std::max(most, c.x() * along + c.y() * across);
      const Vec2 c = body.support(along, across);
      ASSERT_EQ(c.x() * along + c.y() * across, most);
      // No point outside lies farther behind the supporting plane than it is away from the body.
      const Vec2 x(random.uniform(-60.0, 80.0), random.uniform(0.0, 40.0));
      if (const double d = body.value(x.x(), x.y()); d > 0.0) {
        ASSERT_GE(d, x.x() * along + x.y() * across - most - 1e-12);
      }
    }
  }
}

/// Whether (z, rho) lies under the polyline.
bool under(const std::vector<Vec2>& profile, double z, double rho) {
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Vec2 &a = profile[i], &b = profile[i + 1];
    if (z >= a.x() && z <= b.x() && b.x() > a.x() && rho <= a.y() + (z - a.x()) / (b.x() - a.x()) * (b.y() - a.y()))
      return true;
  }
  return false;
}

TEST(ConvexBodies, TheirUnionIsWhatLiesUnderTheProfile) {
  Random random(9);
  for (int round = 0; round < 40; ++round) {
    std::vector<Vec2> profile;
    double z = random.uniform(-5.0, 5.0);
    for (int i = 0; i < 2 + round % 8; ++i) {
      profile.emplace_back(z, random.uniform(0.0, 10.0));
      if (i % 3 != 1) z += random.uniform(0.5, 6.0);  // else a step at one z
    }
    const std::vector<Revolved> bodies = convex_bodies(profile);
    if (profile.back().x() == profile.front().x()) continue;
    for (int i = 0; i < 400; ++i) {
      const double at = random.uniform(profile.front().x() - 1.0, profile.back().x() + 1.0);
      const double rho = random.uniform(0.0, 11.0);
      double least = 1e300;
      for (const Revolved& body : bodies) least = std::min(least, body.value(at, rho));
      if (std::abs(least) < 1e-9) continue;
      ASSERT_EQ(least < 0.0, under(profile, at, rho)) << at << ' ' << rho;
    }
  }
}

TEST(ConvexBodies, AStraightProfileCutInManyPiecesIsOneBody) {
  std::vector<Vec2> cone;
  for (int i = 0; i <= 300; ++i) cone.emplace_back(0.1 * i, 2.0 + 0.1 * i * 0.07);
  EXPECT_EQ(convex_bodies(cone).size(), 1u);
  std::vector<Vec2> waist;
  for (int i = 0; i <= 10; ++i) waist.emplace_back(i, 3.0 + 0.02 * (i - 5) * (i - 5));
  EXPECT_EQ(convex_bodies(waist).size(), 10u) << "every piece of a concave profile is a body of its own";
}

}  // namespace
}  // namespace flank::internal::verify
