// Bodies of revolution as signed distances: from the definition, with derivatives, and taken apart into convex ones.
#include "flank/obstacle/convex_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

using Profile = std::vector<Vec2>;

const std::vector<Profile> kConvex = {{{0, 4}, {30, 4}},
                                      {{0, 0}, {30, 9}},
                                      {{0, 7}, {20, 2}},
                                      {{-3, 5}, {-3, 6}, {12, 6}},
                                      {{0, 3}, {5, 6}, {20, 8}, {30, 8}, {34, 2}, {34, 0}}};

/// The outline from the axis over the outside back to the axis.
Profile outline_of(const Profile& profile) {
  Profile outline{Vec2(profile.front().x(), 0.0)};
  outline.insert(outline.end(), profile.begin(), profile.end());
  outline.emplace_back(profile.back().x(), 0.0);
  return outline;
}

/// Distance to the outline, negative inside: a point is inside where it is below the profile.
double brute_distance(const Profile& profile, double z, double rho) {
  const Profile outline = outline_of(profile);
  double border = 1e300;
  bool inside = z >= profile.front().x() && z <= profile.back().x();
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    const Vec2 d = outline[i + 1] - outline[i], e = Vec2(z, rho) - outline[i];
    if (!(d.squaredNorm() > 0.0)) continue;
    border = std::min(border, (e - std::clamp(d.dot(e) / d.squaredNorm(), 0.0, 1.0) * d).norm());
    if (d.x() > 0.0 && z >= outline[i].x() && z <= outline[i + 1].x())
      inside = inside && rho <= outline[i].y() + d.y() * (z - outline[i].x()) / d.x();
  }
  return inside ? -border : border;
}

Vec3 random_direction(Random& random) { return Vec3(random.normal(), random.normal(), random.normal()).normalized(); }

TEST(ConvexProfile, IsTheDistanceToTheOutline) {
  Random random(3);
  for (const Profile& profile : kConvex) {
    const ConvexProfile body(profile);
    for (int k = 0; k < 3000; ++k) {
      const double z = random.uniform(-15.0, 50.0), rho = random.uniform(0.0, 20.0);
      ASSERT_NEAR(body.at(z, rho).value, brute_distance(profile, z, rho), 1e-12) << z << " " << rho;
    }
  }
}

TEST(ConvexProfile, ClosedFormsOfACylinder) {
  const ConvexProfile body({{0, 4}, {30, 4}});
  EXPECT_NEAR(body.at(10.0, 9.0).value, 5.0, 1e-14);
  EXPECT_NEAR(body.at(-2.0, 1.0).value, 2.0, 1e-14);
  EXPECT_NEAR(body.at(33.0, 8.0).value, 5.0, 1e-14) << "the rim: 3 along, 4 across";
  EXPECT_NEAR(body.at(33.0, 8.0).corner, 0.2, 1e-14);
  EXPECT_EQ(body.at(10.0, 9.0).corner, 0.0);
  EXPECT_NEAR(body.at(15.0, 1.0).value, -3.0, 1e-14) << "the mantle is nearer than the ends";
  EXPECT_NEAR(body.at(1.0, 0.0).value, -1.0, 1e-14);
  EXPECT_EQ(body.at(1.0, 0.0).along, -1.0) << "the shortest way out is through the lower end";
}

TEST(ConvexProfile, RoundingGrowsTheBody) {
  Random random(4);
  for (const Profile& profile : kConvex) {
    const ConvexProfile sharp(profile), round(profile, 1.5);
    for (int k = 0; k < 200; ++k) {
      const double z = random.uniform(-15.0, 50.0), rho = random.uniform(0.0, 20.0);
      EXPECT_NEAR(round.at(z, rho).value, sharp.at(z, rho).value - 1.5, 1e-14);
      EXPECT_EQ(round.at(z, rho).along, sharp.at(z, rho).along);
    }
  }
}

TEST(ConvexProfile, OneCornerOnTheAxisIsABall) {
  const ConvexProfile ball({{5, 0}}, 3.0);
  EXPECT_NEAR(ball.at(8.0, 4.0).value, 2.0, 1e-14);
  EXPECT_NEAR(ball.at(8.0, 4.0).along, 0.6, 1e-14);
  EXPECT_NEAR(ball.at(8.0, 4.0).out, 0.8, 1e-14);
  EXPECT_NEAR(ball.at(8.0, 4.0).corner, 0.2, 1e-14);
  const ProfileJet middle = ball.at(5.0, 0.0);
  EXPECT_EQ(middle.value, -3.0);
  EXPECT_EQ(std::hypot(middle.along, middle.out), 1.0) << "some unit vector, and no division by zero";
  EXPECT_TRUE(std::isfinite(middle.corner));
}

TEST(ConvexProfile, OneCornerOffTheAxisIsADisc) {
  const ConvexProfile disc({{5, 7}});
  EXPECT_NEAR(disc.at(9.0, 3.0).value, 4.0, 1e-14);
  EXPECT_NEAR(disc.at(1.0, 10.0).value, 5.0, 1e-14);
  EXPECT_NEAR(disc.at(5.0, 2.0).value, 0.0, 1e-14);
}

TEST(ConvexProfile, IsConvexInSpace) {
  Random random(6);
  for (const Profile& profile : kConvex) {
    const ConvexProfile body(profile);
    const Pose pose{Vec3(1, 2, 3), random_direction(random)};
    for (int k = 0; k < 500; ++k) {
      const Vec3 a = pose.at(random.uniform(-10.0, 40.0)) + 12.0 * random_direction(random);
      const Vec3 b = pose.at(random.uniform(-10.0, 40.0)) + 12.0 * random_direction(random);
      const double middle = body_jet(body, pose, 0.5 * (a + b)).value;
      EXPECT_LE(middle, 0.5 * (body_jet(body, pose, a).value + body_jet(body, pose, b).value) + 1e-12);
      // Its tangent plane lies below it.
      const BodyJet jet = body_jet(body, pose, a);
      EXPECT_GE(body_jet(body, pose, b).value, jet.value + jet.gradient.dot(b - a) - 1e-9);
    }
  }
}

/// Derivatives against differences, except next to a kink or to where another side takes over.
TEST(BodyJet, DerivativesAgreeWithDifferences) {
  Random random(8);
  int checked = 0, off = 0;
  for (const Profile& profile : kConvex) {
    const ConvexProfile body(profile);
    for (int k = 0; k < 300; ++k) {
      const Pose pose{5.0 * random_direction(random), random_direction(random)};
      const Vec3 x = pose.at(random.uniform(-10.0, 45.0)) + random.uniform(1.0, 20.0) * random_direction(random);
      const BodyJet jet = body_jet(body, pose, x);
      if (jet.value < 0.2) continue;
      const Vec3 a = random_direction(random), b = random_direction(random);
      const double h = 1e-4;
      const BodyJet up = body_jet(body, pose, x + h * b), down = body_jet(body, pose, x - h * b);
      const double slope = (up.value - down.value) / (2.0 * h), bend = (up.gradient - down.gradient).dot(a) / (2.0 * h);
      EXPECT_NEAR(jet.gradient.norm(), 1.0, 1e-12);
      EXPECT_NEAR(jet.gradient.dot(b), slope, 1e-4);
      EXPECT_NEAR(jet.second(pose.axis, a, b), jet.second(pose.axis, b, a), 1e-12);
      ++checked;
      if (std::abs(jet.second(pose.axis, a, b) - bend) > 1e-5) ++off;  // the second derivative jumps at a rim's plane
    }
  }
  EXPECT_GT(checked, 1000);
  EXPECT_LE(off, 2);
}

TEST(BodyJet, SaysWhereThePointIs) {
  const ConvexProfile body({{0, 4}, {30, 4}});
  const Pose pose{Vec3(1, 1, 1), Vec3(0.6, 0.0, 0.8)};
  const Vec3 across(0.8, 0.0, -0.6);
  const BodyJet jet = body_jet(body, pose, pose.at(12.0) + 7.0 * across);
  EXPECT_NEAR(jet.z, 12.0, 1e-12);
  EXPECT_NEAR(jet.rho, 7.0, 1e-12);
  EXPECT_NEAR((jet.across - across).norm(), 0.0, 1e-12);
  EXPECT_NEAR((jet.gradient - across).norm(), 0.0, 1e-12);
  EXPECT_NEAR(body_jet(body, pose, pose.at(15.0)).across.dot(pose.axis), 0.0, 1e-12) << "any, where the point is on it";
}

TEST(SplitConvex, TheUnionIsTheBody) {
  Random random(10);
  const std::vector<Profile> profiles = {{{0, 4}, {30, 4}},
                                         {{0, 4}, {20, 4}, {30, 9}, {40, 9}},  // a cone that opens: two bodies
                                         {{0, 8}, {10, 3}, {20, 8}},           // a waist
                                         {{0, 5}, {10, 5}, {10, 12}, {30, 12}, {40, 5}},        // a step out
                                         {{0, 9}, {8, 9}, {8, 2}, {25, 2}},                     // a step in
                                         {{0, 2}, {6, 5}, {9, 4}, {15, 7}, {18, 3}, {22, 6}}};  // up and down
  for (const Profile& profile : profiles) {
    const std::vector<ConvexProfile> bodies = split_convex(profile);
    for (int k = 0; k < 2000; ++k) {
      const double z = random.uniform(-10.0, 50.0), rho = random.uniform(0.0, 18.0);
      double least = 1e300;
      for (const ConvexProfile& body : bodies) least = std::min(least, body.at(z, rho).value);
      const double brute = brute_distance(profile, z, rho);
      if (brute > 1e-9) {
        ASSERT_NEAR(least, brute, 1e-9) << z << " " << rho;
      } else if (brute < -1e-9) {
        ASSERT_LE(least, 1e-9) << z << " " << rho;
        ASSERT_GE(least, brute - 1e-9) << "no deeper than the whole";
      }
    }
  }
}

TEST(SplitConvex, CutsOnlyWhereTheProfileIsHollow) {
  EXPECT_EQ(split_convex({{0, 4}, {30, 4}}).size(), 1u);
  EXPECT_EQ(split_convex({{0, 3}, {5, 6}, {20, 8}, {30, 8}, {34, 2}}).size(), 1u);
  EXPECT_EQ(split_convex({{0, 2}, {10, 4}, {20, 6}}).size(), 1u) << "on one line";
  EXPECT_EQ(split_convex({{0, 8}, {10, 3}, {20, 8}}).size(), 2u);
  EXPECT_EQ(split_convex({{0, 5}, {10, 5}, {10, 12}, {30, 12}}).size(), 2u);
  EXPECT_TRUE(split_convex({}).empty());
}

TEST(SplitConvex, APlateWithoutThicknessIsAsWideAsItsWidestCorner) {
  const std::vector<ConvexProfile> bodies = split_convex({{5, 2}, {5, 7}, {5, 4}});
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_NEAR(bodies.front().at(5.0, 10.0).value, 3.0, 1e-12);
  EXPECT_NEAR(bodies.front().at(9.0, 0.0).value, 4.0, 1e-12);
}

}  // namespace
}  // namespace flank::internal
