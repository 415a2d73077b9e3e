// The program of a slot in two layers: its strips say what they are, and of which layer.
#include "flank/trochoid/plan_program.h"

#include <gtest/gtest.h>

#include <numbers>

#include "flank/base/work_count.h"
#include "flank/threads.h"
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

CavityProgram planned(const Progress& progress) {
  const RadialFunction radial(ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius));
  const double near = kRadius, far = kWidth - kRadius;
  const std::vector<RuledMotion> sides{along(near, kStep), along(far, kStep), along(near, 0.0), along(far, 0.0)};
  ProgramOptions options;
  options.cycles.strategy = CycleStrategy::kPlain;
  options.cycles.largest_rad = std::numbers::pi / 2.0;
  return plan_program(sides, radial, *wall(0.0), *wall(kWidth), {}, options, progress);
}

TEST(PlanProgram, EndsAtItsLimitOfWorkWithTheCyclesThatItHasForAnyNumberOfThreads) {
  if (kSanitized) GTEST_SKIP() << "cycles_test plans the same";
  // What it takes to get so far along the first layer that cycles are between the sides; once there, this run ends, too.
  constexpr double kFar = 0.45;
  const std::uint64_t before = work_done();
  double done = 0.0;
  Progress watched;
  watched.report = [&](std::string_view, double share) {
    if (share > kFar && done == 0.0) done = static_cast<double>(work_done() - before);
  };
  watched.cancelled = [&] { return done > 0.0; };
  const std::size_t cycles = planned(watched).layers.front().cycles.cycles.size();
  ASSERT_GT(cycles, 1u);
  for (const int threads : {1, 4}) {
    set_thread_count(threads);
    const CavityProgram some = planned(limited({}, done));
    set_thread_count(0);
    ASSERT_EQ(some.layers.size(), 1u);
    const PlannedLayer& layer = some.layers.front();
    EXPECT_EQ(layer.cycles.status, CycleStatus::kCancelled);
    EXPECT_EQ(layer.cycles.cycles.size(), cycles) << threads << " threads";
    EXPECT_GT(layer.share, 0.0);
    EXPECT_LT(layer.share, 1.0);
    EXPECT_EQ(some.path.strips.back().kind, "side") << "the sides are finished as far";
  }
}

TEST(PlanProgram, StripsSayOfWhichLayerTheyAre) {
  if (kSanitized) GTEST_SKIP() << "cycles_test plans the same";
  const CavityProgram out = planned({});
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
