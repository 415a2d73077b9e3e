// Solids of many shapes are as far apart as the nearest of their shapes.
#include "flank/machine/bodies/solid_body.h"

#include <gtest/gtest.h>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

TEST(SolidBody, IsAsFarAsItsNearestShape) {
  Random random(5);
  const auto near = [&](const Vec3& at) -> Vec3 {
    return at + Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  };
  std::vector<ConvexShape> many, few;
  for (int k = 0; k < 400; ++k) {
    const Vec3 at(random.uniform(-30, 30), random.uniform(-30, 30), random.uniform(-2, 2));
    many.push_back(ConvexShape::triangle(near(at), near(at), near(at)));
  }
  for (int k = 0; k < 5; ++k)
    few.push_back(ConvexShape::frustum(Vec3(0, 0, 2.0 * k), 1.0 + k, Vec3(0, 0, 2.0 * k + 2.0), 2.0));
  const SolidBody ground("ground", SolidKind::kWork, 0, many), head("head", SolidKind::kMachine, 5, few);
  for (int trial = 0; trial < 40; ++trial) {
    Eigen::Isometry3d to = Eigen::Isometry3d::Identity();
    to.translate(Vec3(random.uniform(-40, 40), random.uniform(-40, 40), random.uniform(0, 12)));
    to.rotate(Eigen::AngleAxisd(random.uniform(-1, 1), Vec3::UnitX()));
    double least = 1e9;
    for (const ConvexShape& a : many)
      for (const ConvexShape& b : few) least = std::min(least, gap(a, b, to, 1e9));
    EXPECT_NEAR(ground.gap(head, to, 1e9), least, kGapErrorMm) << trial;
    EXPECT_LE(ground.gap(head, to, 1.0), 1.0);
  }
  EXPECT_EQ(SolidBody("none", SolidKind::kWork, 0, {}).gap(head, Eigen::Isometry3d::Identity(), 7.0), 7.0);
}

}  // namespace
}  // namespace flank::internal
