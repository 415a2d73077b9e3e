// How deep half paths enter faces: the deepest moment, not the deepest sample.
#include "flank/trochoid/half_guard.h"

#include <gtest/gtest.h>

#include "flank/trochoid/half_path.h"
#include "obstacle/obstacle_scene.h"

namespace flank::internal {
namespace {

TEST(HalfGuard, SeesTheMomentAtWhichAHalfTurnsBackBeforeAWall) {
  constexpr double kLength = 15.0, kRadius = 2.0;
  const RadialFunction radial(ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius));
  const auto wall =
      make_target({testing::quad(Vec3(4, 50, -50), Vec3(4, -50, -50), Vec3(4, 50, 50), Vec3(4, -50, 50), "F1")});
  const HalfGuard guard({{wall.get()}, {}}, radial);
  const auto place = [](double x, double y) {
    return AxisPlace{Vec3(x, y, 0.0), Vec3::UnitZ(), Vec3::UnitX(), Vec3::Zero()};
  };
  // Where the turn lies between the samples is another for each.
  for (const double ahead : {0.0, 0.3, 0.6, 0.9, 1.2}) {
    const RuledMotion half = half_path(kLength, place(0.0, 0.0), place(ahead, 9.0).reversed(), {2.5, 0.8, 2.0, 0.0});
    GuardDepth dense;
    for (int k = 0; k <= 4000; ++k) guard.look(half.pose(k / 4000.0), 9, dense);
    ASSERT_GT(dense.sides, 0.1);
    EXPECT_NEAR(guard.depth(half, 25, 9).sides, dense.sides, 1e-4) << ahead;
  }
}

}  // namespace
}  // namespace flank::internal
