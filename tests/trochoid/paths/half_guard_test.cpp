// How deep half paths enter faces: the deepest moment, not the deepest sample.
#include "flank/trochoid/paths/half_guard.h"

#include <gtest/gtest.h>

#include "flank/trochoid/paths/half_path.h"
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

TEST(HalfGuard, SeesAMomentBetweenTwoSamplesThatEnterNothing) {
  constexpr double kLength = 15.0, kRadius = 2.0, kDeep = 0.02, kAtEnd = 0.006;
  const RadialFunction radial(ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius));
  const auto place = [](double x, double y) {
    return AxisPlace{Vec3(x, y, 0.0), Vec3::UnitZ(), Vec3::UnitX(), Vec3::Zero()};
  };
  const double y = kAtEnd - kRadius;
  const auto side =
      make_target({testing::quad(Vec3(-50, y, -50), Vec3(-50, y, 50), Vec3(50, y, -50), Vec3(50, y, 50), "F1")});
  for (const double ahead : {0.0, 0.3, 0.6, 0.9, 1.2}) {
    const RuledMotion half = half_path(kLength, place(0.0, 0.0), place(ahead, 9.0).reversed(), {2.5, 0.8, 2.0, 0.0});
    double farthest = 0.0;
    for (int k = 0; k <= 4000; ++k) farthest = std::max(farthest, half.pose(k / 4000.0).tip.x());
    const double x = farthest + kRadius - kDeep;
    // The half starts a little inside the side: what it enters there must not keep the look off the wall.
    const auto wall =
        make_target({testing::quad(Vec3(x, 50, -50), Vec3(x, -50, -50), Vec3(x, 50, 50), Vec3(x, -50, 50), "F2")});
    const ObstacleField field(
        testing::only(
            {make_target({testing::quad(Vec3(x, 50, -50), Vec3(x, -50, -50), Vec3(x, 50, 50), Vec3(x, -50, 50), "F2")}),
             true}),
        *side, kRadius, 0.01);
    const GuardDepth of_sides = HalfGuard({{side.get(), wall.get()}, {}}, radial).depth(half, 25, 9);
    EXPECT_NEAR(of_sides.sides, kDeep, 1e-4) << ahead;
    const GuardDepth of_both = HalfGuard({{side.get()}, {&field}}, radial).depth(half, 25, 9);
    EXPECT_NEAR(of_both.sides, kAtEnd, 1e-9) << ahead;
    EXPECT_NEAR(of_both.others, kDeep, 1e-4) << ahead;
    const GuardDepth of_tips = HalfGuard({{side.get()}, {nullptr, &field}}, radial).of_tips().depth(half, 25, 9);
    EXPECT_EQ(of_tips.sides, 0.0) << ahead;
    EXPECT_NEAR(of_tips.others, kDeep, 1e-4) << ahead;
  }
}

TEST(HalfGuard, KnowsWhetherItSeesAnything) {
  const RadialFunction radial(ToolFamily::kCylinder, 15.0, Eigen::VectorXd::Constant(1, 2.0));
  const auto side = testing::standing_blade(0.0);
  const HalfGuard guard({{side.get()}, {nullptr, nullptr}}, radial);
  EXPECT_TRUE(guard.has_faces());
  EXPECT_FALSE(guard.of_tips().has_faces()) << "no field is no face";
  const ObstacleField hub(testing::only(testing::hub(true)), *side, 2.0, 0.0);
  EXPECT_TRUE(HalfGuard({{side.get()}, {nullptr, &hub}}, radial).of_tips().has_faces());
}

}  // namespace
}  // namespace flank::internal
