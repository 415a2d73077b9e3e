// The program of a slot in two layers: its strips say what they are, and of which layer.
#include "flank/trochoid/plan_program.h"

#include <gtest/gtest.h>

#include <numbers>

#include "obstacle/obstacle_scene.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

using testing::quad;

constexpr double kRadius = 5.0, kLength = 15.0, kWidth = 20.0, kLong = 12.0, kStep = 14.0;

std::unique_ptr<Target> wall(double y) {
  const double top = kStep + kLength;
  return make_target({quad({0.0, y, 0.0}, {kLong, y, 0.0}, {0.0, y, top}, {kLong, y, top}, "F1")});
}

RuledMotion along(double y, double z) {
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k <= 20; ++k) {
    t.push_back(k / 20.0);
    poses.push_back({Vec3(kLong * t.back(), y, z), Vec3::UnitZ()});
  }
  return fit_motion(poses, t, kLength, 6);
}

TEST(PlanProgram, StripsSayOfWhichLayerTheyAre) {
  if (kSanitized) GTEST_SKIP() << "cycles_test plans the same";
  const RadialFunction radial(ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius));
  const double near = kRadius, far = kWidth - kRadius;
  const std::vector<RuledMotion> sides{along(near, kStep), along(far, kStep), along(near, 0.0), along(far, 0.0)};
  ProgramOptions options;
  options.cycles.strategy = CycleStrategy::kPlain;
  options.cycles.largest_rad = std::numbers::pi / 2.0;
  const CavityProgram out = plan_program(sides, radial, *wall(0.0), *wall(kWidth), {}, options, {});
  ASSERT_TRUE(out.done());
  ASSERT_EQ(out.layers.size(), 2u);
  int last = 1, lower = 0;
  for (const Strip& strip : out.path.strips) {
    EXPECT_GE(strip.layer, last);
    EXPECT_LE(strip.layer, 2);
    // Between layers the tool is elsewhere; a layer's halves and sweeps lie where its sides do.
    if (strip.kind != "link") {
      EXPECT_NEAR(strip.poses.front().tip.z(), strip.layer == 1 ? kStep : 0.0, 1e-6) << strip.id;
    }
    if (strip.layer == 2 && lower++ == 0) {
      EXPECT_EQ(strip.kind, "link") << "the way there is the layer's";
    }
    last = strip.layer;
  }
  EXPECT_GT(lower, 4);
}

}  // namespace
}  // namespace flank::internal
