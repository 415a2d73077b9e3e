// Boxes and poses.
#include "flank/vec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

Vec3 random_point(Random& random) { return {random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5)}; }

TEST(Box3, IsEmptyUntilAPointIsAdded) {
  Box3 box;
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.diagonal(), 0.0);
  box.add(Box3{});
  EXPECT_TRUE(box.empty()) << "an empty box adds nothing";
  box.add(Vec3(1, 2, 3));
  EXPECT_FALSE(box.empty());
  EXPECT_EQ(box.diagonal(), 0.0) << "one point has no extent";
  EXPECT_EQ(box.center(), Vec3(1, 2, 3));
}

TEST(Box3, HoldsItsPointsTightly) {
  Random random(1);
  Box3 box, left, right;
  std::vector<Vec3> points;
  for (int k = 0; k < 50; ++k) {
    points.push_back(random_point(random));
    box.add(points.back());
    (k % 2 == 0 ? left : right).add(points.back());
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto less = [axis](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; };
    EXPECT_EQ(box.low[axis], (*std::min_element(points.begin(), points.end(), less))[axis]);
    EXPECT_EQ(box.high[axis], (*std::max_element(points.begin(), points.end(), less))[axis]);
  }
  left.add(right);
  EXPECT_EQ(left.low, box.low);
  EXPECT_EQ(left.high, box.high);
}

TEST(Box3, DistanceIsThatOfTheNearestPointOfTheBox) {
  Random random(2);
  const Box3 box{Vec3(-1, 0, 2), Vec3(3, 1, 4)};
  EXPECT_NEAR(box.diagonal(), std::sqrt(16.0 + 1.0 + 4.0), 1e-15);
  for (int k = 0; k < 500; ++k) {
    const Vec3 p = random_point(random);
    const Vec3 nearest = p.cwiseMax(box.low).cwiseMin(box.high);
    EXPECT_NEAR(box.squared_distance(p), (p - nearest).squaredNorm(), 1e-13);
  }
  EXPECT_EQ(box.squared_distance(Vec3(0, 0.5, 3)), 0.0);
  EXPECT_EQ(box.squared_distance(Vec3(0, 3, 3)), 4.0);
}

TEST(Box3, ABoxThatLacksOneDirectionIsEmpty) {
  Box3 box{Vec3(0, 0, 1), Vec3(1, 1, 0)};
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.diagonal(), 0.0);
}

TEST(Pose, RunsAlongItsAxisFromTheTip) {
  const Pose pose{Vec3(1, 2, 3), Vec3(0, 0.6, 0.8)};
  EXPECT_EQ(pose.at(0.0), Vec3(1, 2, 3));
  EXPECT_LT((pose.at(10.0) - Vec3(1, 8, 11)).norm(), 1e-14);
  EXPECT_NEAR((pose.at(7.0) - pose.at(2.0)).norm(), 5.0, 1e-14);
  EXPECT_EQ(Pose{}.at(4.0), Vec3(0, 0, 4)) << "upright at the origin unless said otherwise";
}

}  // namespace
}  // namespace flank::internal
