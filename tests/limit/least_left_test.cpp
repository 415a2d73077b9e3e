// Beside what a path leaves at its worst place: what every tool leaves there.
#include "flank/limit/least_left.h"

#include <gtest/gtest.h>

#include <cmath>

#include "seed/sheet.h"

namespace flank::internal {
namespace {

const double kCorner = (std::sqrt(2.0) - 1.0) / (std::sqrt(2.0) + 1.0);  // of a ball's radius, beside a wall

/// A floor with a wall on it at x = 0; 1 mm is left on the floor at a place beside the wall.
class BesideAWall : public ::testing::Test {
 protected:
  internal::Setup setup_;
  VerifyReport report_;

  BesideAWall() {
    Face floor = testing::rectangle(0.0, 0.0, 20.0, 10.0);
    Face wall = testing::sheet([](double u, double v) { return Vec3(0.0, 10.0 * u, 15.0 * v); }, 4, 4);
    wall.id = "F2";
    setup_.part.faces = {floor, wall};
    setup_.part.box.add(Vec3(0, 0, 0));
    setup_.part.box.add(Vec3(20, 10, 15));
    setup_.targets = {0};
    setup_.checks = {1};
    report_.tolerance_mm = 0.05;
    report_.reach_radius_mm = 2.0;
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
  const auto left = least_left(setup_, report_);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->face, "F1");
  EXPECT_EQ(left->left_mm, 1.0);
  EXPECT_EQ(left->radius_mm, 2.0);
  EXPECT_LE(left->bound_mm, 2.0 * kCorner);
  EXPECT_GE(left->bound_mm, 0.85 * 2.0 * kCorner);
}

TEST_F(BesideAWall, NothingIsProvedWhereABallTouchesFreely) {
  leaves(1.0, Vec3(10, 5, 0));
  EXPECT_FALSE(least_left(setup_, report_));
  setup_.checks.clear();
  leaves(1.0, Vec3(0, 5, 0));
  EXPECT_FALSE(least_left(setup_, report_)) << "the wall may be entered";
}

TEST_F(BesideAWall, IsNotAskedOfWhatIsFinished) {
  leaves(0.05, Vec3(0, 5, 0));
  EXPECT_FALSE(least_left(setup_, report_));
  leaves(INFINITY, Vec3(0, 5, 0));
  EXPECT_FALSE(least_left(setup_, report_)) << "nobody knows where";
  leaves(1.0, Vec3(0, 5, 0));
  setup_.allowance_mm = 0.2;
  EXPECT_FALSE(least_left(setup_, report_));
}

}  // namespace
}  // namespace flank::internal
