// Beside what a path leaves: what every tool that is thick enough leaves on the same face.
#include "flank/limit/least_left.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "seed/sheet.h"

namespace flank::internal {
namespace {

constexpr double kRadius = 2.0;                                          // no tool has a smaller one
const double kCorner = (std::sqrt(2.0) - 1.0) / (std::sqrt(2.0) + 1.0);  // of a ball's radius, beside a wall

/// A floor with a wall on it at x = 0; 1 mm is left on the floor at a place beside the wall.
class BesideAWall : public ::testing::Test {
 protected:
  internal::Setup setup_;
  VerifyReport report_;

  BesideAWall() {
    setup_.part.faces = {testing::rectangle(0.0, 0.0, 20.0, 10.0)};
    // A block whose near side is the wall: all of its sides, or a ball inside of it would count.
    const Vec3 low(-40, -40, -40), size(40, 90, 80);
    for (int k = 0; k < 3; ++k)
      for (const bool high : {false, true}) {
        const Vec3 e = Vec3::Unit(k), across = Vec3::Unit((k + (high ? 1 : 2)) % 3),
                   along = Vec3::Unit((k + (high ? 2 : 1)) % 3);
        const Vec3 corner = low + (high ? size[k] : 0.0) * e;
        Face side = testing::sheet(
            [=](double u, double v) {
              return Vec3(corner + u * size.dot(across) * across + v * size.dot(along) * along);
            },
            4, 4);
        side.id = "F" + std::to_string(setup_.part.faces.size() + 1);
        side.solid = 1;
        setup_.part.faces.push_back(side);
      }
    setup_.part.box.add(low);
    setup_.part.box.add(Vec3(20, 50, 40));
    setup_.targets = {0};
    setup_.checks = {1, 2, 3, 4, 5, 6};
    report_.tolerance_mm = 0.05;
    leaves(1.0, Vec3(0, 5, 0));
  }
  void leaves(double mm, const Vec3& at) {
    FaceVerdict face;
    face.face = "F1";
    face.target = true;
    face.undercut_mm = mm;
    face.undercut_point = at;
    report_.faces = {face};
  }
};

TEST_F(BesideAWall, ABallOfTheRadiusLeavesAsMuch) {
  const auto left = least_left(setup_, report_, kRadius);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->face, "F1");
  EXPECT_EQ(left->left_mm, 1.0);
  EXPECT_EQ(left->radius_mm, kRadius);
  EXPECT_LE(left->bound_mm, kRadius * kCorner);
  EXPECT_GE(left->bound_mm, 0.85 * kRadius * kCorner);
}

TEST_F(BesideAWall, WhatIsProvedElsewhereOnTheFaceCounts) {
  leaves(1.0, Vec3(10, 5, 0));
  const auto left = least_left(setup_, report_, kRadius);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->left_mm, 1.0);
  EXPECT_LT(left->point.x(), 0.1) << "beside the wall";
  EXPECT_LE(left->bound_mm, kRadius * kCorner);
  EXPECT_GE(left->bound_mm, 0.85 * kRadius * kCorner);
}

TEST_F(BesideAWall, NothingIsProvedWhereABallTouchesFreely) {
  setup_.checks.clear();
  EXPECT_FALSE(least_left(setup_, report_, kRadius)) << "the wall may be entered";
}

/// A thicker tool leaves more of the same corner.
TEST_F(BesideAWall, IsAboutToolsOfTheRadiusThatIsGiven) {
  const auto thin = least_left(setup_, report_, kRadius), thick = least_left(setup_, report_, 2.0 * kRadius);
  ASSERT_TRUE(thin && thick);
  EXPECT_EQ(thick->radius_mm, 2.0 * kRadius);
  EXPECT_GT(thick->bound_mm, 1.5 * thin->bound_mm);
}

TEST_F(BesideAWall, IsNotAskedOfWhatIsFinished) {
  leaves(0.05, Vec3(0, 5, 0));
  EXPECT_FALSE(least_left(setup_, report_, kRadius));
  leaves(INFINITY, Vec3(0, 5, 0));
  EXPECT_FALSE(least_left(setup_, report_, kRadius)) << "nobody knows where";
  leaves(1.0, Vec3(0, 5, 0));
  setup_.allowance_mm = 0.2;
  EXPECT_FALSE(least_left(setup_, report_, kRadius));
}

}  // namespace
}  // namespace flank::internal
