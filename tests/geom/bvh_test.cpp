#include "flank/geom/bvh.h"

#include <gtest/gtest.h>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

TEST(OrientedBox, HoldsItsPointsAndIsTightOnATiltedPlate) {
  Random random(1);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vec3> points;
  for (int k = 0; k < 500; ++k)
    points.push_back(turn * Vec3(random.uniform(-10, 10), random.uniform(-3, 3), random.uniform(-0.01, 0.01)) +
                     Vec3(100, 0, 0));
  const OrientedBox box = bounding_box(points);
  for (const Vec3& p : points) EXPECT_EQ(box.squared_distance(p), 0.0);
  EXPECT_LT(box.half.minCoeff(), 0.05);
  EXPECT_NEAR(box.squared_distance(turn * Vec3(0, 0, 5) + Vec3(100, 0, 0)), 25, 1.0);
}

TEST(OrientedBox, OfNothingAndOfOnePoint) {
  EXPECT_EQ(bounding_box({}).half.norm(), 0.0);
  const OrientedBox box = bounding_box({Vec3(1, 2, 3)});
  EXPECT_NEAR(box.squared_distance({1, 2, 5}), 4, 1e-10);
}

TEST(BoxTree, FindsTheNearestOfManyPoints) {
  Random random(2);
  std::vector<std::vector<Vec3>> hulls;
  for (int k = 0; k < 3000; ++k) hulls.push_back({Vec3(random.uniform(), random.uniform(), random.uniform())});
  hulls.insert(hulls.end(), 200, hulls.front());  // many items at one place
  const BoxTree tree(hulls);
  for (int k = 0; k < 200; ++k) {
    const Vec3 p(random.uniform(-1, 2), random.uniform(-1, 2), random.uniform(-1, 2));
    double truth = 1e300, best = 1e300;
    for (const auto& h : hulls) truth = std::min(truth, (h[0] - p).squaredNorm());
    int visits = 0;
    tree.nearest(p, best, [&](int item) {
      ++visits;
      best = std::min(best, (hulls[static_cast<std::size_t>(item)][0] - p).squaredNorm());
    });
    EXPECT_DOUBLE_EQ(best, truth);
    EXPECT_LT(visits, 400);
  }
}

TEST(BoxTree, AnEmptyTreeVisitsNothing) {
  const std::vector<BoxTree> trees(2);
  int visits = 0;
  for (const BoxTree& tree : trees) {
    double best = 1.0;
    tree.nearest({0, 0, 0}, best, [&](int) { ++visits; });
  }
  EXPECT_EQ(visits, 0);
}

}  // namespace
}  // namespace flank::internal
