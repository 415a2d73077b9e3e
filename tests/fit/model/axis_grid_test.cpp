#include "flank/fit/model/axis_grid.h"

#include <gtest/gtest.h>

#include "fit/flat_scene.h"

namespace flank::internal {
namespace {

using testing::upright_motion;

TEST(AxisGrid, HoldsBothEndsOfTheMotionAndOfTheAxis) {
  const RuledMotion motion = upright_motion();
  const AxisGrid grid(motion, 7, 3);
  ASSERT_EQ(grid.times().size(), 7u);
  EXPECT_EQ(grid.times().front().t, 0.0);
  EXPECT_EQ(grid.times().back().t, 1.0);
  EXPECT_EQ(grid.s(), (std::vector<double>{0.0, 0.5 * motion.axis_length, motion.axis_length}));
}

TEST(AxisGrid, PosesAreThoseOfTheMotion) {
  const RuledMotion motion = upright_motion();
  const AxisGrid grid(motion, 7, 3);
  for (std::size_t i = 0; i < grid.times().size(); ++i) {
    const AxisGrid::Pose pose = grid.pose(motion, i);
    const AxisJet jet = motion.jet(grid.times()[i].t);
    EXPECT_LT((pose.tip - jet.tip).norm(), 1e-12);
    EXPECT_LT((pose.u - jet.u).norm(), 1e-14);
  }
}

TEST(AxisGrid, RowIsTheDerivativeByTipAndScaledDirection) {
  const RuledMotion motion = upright_motion();
  const AxisGrid grid(motion, 3, 3);
  const Vec3 gradient(0.3, -0.5, 0.8);
  const double s = 12.0, step = 1e-5;
  AxisGrid::Pose pose = grid.pose(motion, 1);
  pose.w = Vec3(0.2, -0.1, 1.3);  // of a length that is not one
  pose.length_w = pose.w.norm();
  pose.u = pose.w / pose.length_w;
  const Vec6 row = grid.row(pose, s, gradient);
  const auto value = [&](const Vec6& by) {
    const Vec3 w = pose.w + by.tail<3>() / grid.axis_length();
    return gradient.dot(pose.tip + by.head<3>() + s * w.normalized());
  };
  for (int k = 0; k < 6; ++k) {
    const Vec6 by = step * Vec6::Unit(k);
    EXPECT_NEAR(row[k], (value(by) - value(-by)) / (2.0 * step), 1e-9) << k;
  }
}

}  // namespace
}  // namespace flank::internal
