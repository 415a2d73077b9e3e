// The time of a control that comes to rest at the end of every block, against ways from rest to rest in closed form.
#include "flank/machine/control_time.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/machine/model/machine_file.h"

namespace flank::internal {
namespace {

/// Blocks of inverse time: X, Y, Z in mm, A and C in degrees, and how long each is to take, s.
NcProgram program_of(const std::vector<std::pair<std::array<double, 5>, double>>& blocks) {
  NcProgram program;
  program.feed_mode = NcFeedMode::kInverseTime;
  for (const auto& [at, seconds] : blocks) {
    NcMove move;
    move.kind = program.moves.empty() ? NcKind::kRapid : NcKind::kFeed;
    move.position = Vec3(at[0], at[1], at[2]);
    move.orientation = Vec3(at[3], at[4], 0.0);
    move.feed = seconds > 0.0 ? 60.0 / seconds : 0.0;
    program.moves.push_back(move);
  }
  return program;
}

// 30,000 mm/min and 3,000 mm/s^2; A 50 degrees/s and 400 degrees/s^2; C 100 and 800.
TEST(ControlTime, OfAWayFromRestToRest) {
  const Machine machine = read_machine("linuxcnc-xyzac-trt");
  const std::vector<double> seconds = resting_seconds(machine, program_of({{{0, 0, 0, 0, 0}, 0.0},
                                                                           {{10, 0, 0, 0, 0}, 0.5},
                                                                           {{10, 0.03, 0, 0, 0}, 0.001},
                                                                           {{10, 0.03, 0, 6, 0}, 0.6},
                                                                           {{10, 0.03, 0, 6, 50}, 0.01},
                                                                           {{12, 0.03, 0, 7, 50}, 0.2}}));
  EXPECT_EQ(seconds[0], 0.0);
  // 20 mm/s: a ramp at each end takes 20 / 3000 s, on average at half of it.
  EXPECT_NEAR(seconds[1], 0.5 + 20.0 / 3000.0, 1e-12);
  EXPECT_NEAR(seconds[2], 2.0 * std::sqrt(0.03 / 3000.0), 1e-12) << "no room for the feed";
  EXPECT_NEAR(seconds[3], 0.6 + 10.0 / 400.0, 1e-12);
  EXPECT_NEAR(seconds[4], 0.5 + 100.0 / 800.0, 1e-12) << "faster than the axis";
  EXPECT_NEAR(seconds[5], 0.2 + 5.0 / 400.0, 1e-12) << "the slower of two axes";
}

TEST(ControlTime, KeepsTheJerkOfEachAxis) {
  Machine machine = read_machine("linuxcnc-xyzac-trt");
  for (Joint& joint : machine.joints) joint.jerk = 40.0 * joint.acceleration;
  const std::vector<double> seconds =
      resting_seconds(machine, program_of({{{0, 0, 0, 0, 0}, 0.0}, {{10, 0, 0, 0, 0}, 0.1}, {{10, 0, 0, 6, 0}, 0.6}}));
  EXPECT_NEAR(seconds[1], 0.1 + 100.0 / 3000.0 + 1.0 / 40.0, 1e-12);
  EXPECT_NEAR(seconds[2], 0.6 + 10.0 / 400.0 + 1.0 / 40.0, 1e-12);
}

TEST(ControlTime, IsOfLinuxCncAlone) {
  const NcProgram program = program_of({{{0, 0, 0, 0, 0}, 0.0}});
  EXPECT_TRUE(rests_between_blocks(read_machine("linuxcnc-xyzac-trt"), program));
  EXPECT_FALSE(rests_between_blocks(read_machine("siemens-ac"), program));
}

}  // namespace
}  // namespace flank::internal
