// Which way up a part is put: rotary joints that need not move stand still, and a part is clamped as it is said to be.
#include "flank/machine/setup_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/error.h"
#include "flank/machine/model/machine_file.h"

namespace flank::internal {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

/// Once round a pocket with drafted walls: the axis leans by 10 degrees outwards, all the way.
std::vector<Pose> round_a_pocket() {
  std::vector<Pose> poses;
  for (int k = 0; k <= 144; ++k) {
    const double a = 2.5 * k * kRadians;
    const Vec3 out(std::cos(a), std::sin(a), 0.0);
    poses.push_back({15.0 * out, std::sin(10.0 * kRadians) * out + std::cos(10.0 * kRadians) * Vec3::UnitZ()});
  }
  return poses;
}

/// How much a rotary joint turns from its lowest to its highest angle, radians; the one next to the tool or to the work.
double range_of(const Machine& machine, const WorkSetup& setup, const std::vector<Pose>& poses, std::size_t rotary) {
  const Kinematics kinematics(machine, machine.tool_length);
  std::vector<MachinePose> placed;
  for (const Pose& p : poses) placed.push_back({setup.to_work(p), !placed.empty()});
  const JointChoice choice = choose_joints(machine, kinematics, placed);
  double low = 1e9, high = -1e9;
  for (const JointValues& q : choice.joints) {
    const double at = q[kinematics.rotary_joints()[rotary]];
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return high - low;
}

class SetupSearchOn : public ::testing::TestWithParam<const char*> {
 protected:
  Machine machine_ = read_machine(GetParam());
  Kinematics kinematics_{machine_, machine_.tool_length};
};

TEST_P(SetupSearchOn, KeepsAJointStillThatNeedNotMove) {
  const FoundSetup found = search_setup(machine_, kinematics_, {.poses = round_a_pocket()});
  ASSERT_TRUE(found.setup) << found.reason;
  EXPECT_LT(range_of(machine_, *found.setup, round_a_pocket(), 1), 1e-6);
  EXPECT_NEAR(range_of(machine_, *found.setup, round_a_pocket(), 0), 2.0 * std::numbers::pi, 0.01);
}

TEST_P(SetupSearchOn, DoesNotCountWhatLinksTurn) {
  SetupSearch search{.poses = round_a_pocket()};
  search.cutting.assign(search.poses.size(), true);
  // Before and after: upright, as a link is.
  for (const std::size_t at : {std::size_t{0}, search.poses.size()}) {
    search.poses.insert(search.poses.begin() + static_cast<std::ptrdiff_t>(at), Pose{Vec3(0, 0, 60), Vec3::UnitZ()});
    search.cutting.insert(search.cutting.begin() + static_cast<std::ptrdiff_t>(at), false);
  }
  const FoundSetup found = search_setup(machine_, kinematics_, search);
  ASSERT_TRUE(found.setup) << found.reason;
  EXPECT_LT(range_of(machine_, *found.setup, round_a_pocket(), 1), 1e-6);
}

/// Between two walls, to and fro, with the axis upright but for some degrees; and, where it is said, four poses at which it leans by 34
/// degrees, each between two of those that all set-ups are tried with.
std::vector<Pose> between_walls(bool leaning) {
  std::vector<Pose> poses;
  for (int k = 0; k <= 1000; ++k) {
    const double y = std::cos(k * std::numbers::pi / 25.0);
    poses.push_back({Vec3(0.03 * k - 15.0, 8.0 * y, 0.0), Vec3(0.003, 0.063 * y, 1.0).normalized()});
  }
  const Vec3 sides[] = {Vec3::UnitX(), -Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitY()};
  for (int n = 0; leaning && n < 4; ++n)
    for (const int beside : {-1, 0, 1})
      poses[static_cast<std::size_t>(253 + 100 * n + n / 2 + beside)].axis =
          (std::tan((beside == 0 ? 34.0 : 17.0) * kRadians) * sides[n] + Vec3::UnitZ()).normalized();
  return poses;
}

void expect_held(const Machine& machine, const Kinematics& kinematics, const FoundSetup& found) {
  ASSERT_TRUE(found.setup) << found.reason;
  std::vector<MachinePose> placed;
  for (const Pose& p : between_walls(true)) placed.push_back({found.setup->to_work(p), !placed.empty()});
  const JointChoice choice = choose_joints(machine, kinematics, placed);
  EXPECT_FALSE(choice.unreachable) << choice.unreachable->reason;
}

/// The set-up that was found lay on its side, where a pose that was not looked at is 4 degrees beyond the tilting axis' travel.
TEST_P(SetupSearchOn, HoldsAllPosesNotOnlyTheFewItTries) {
  expect_held(machine_, kinematics_, search_setup(machine_, kinematics_, {.poses = between_walls(true)}));
}

/// And so was one on the way to it from upright, which is known when a set-up is.
TEST_P(SetupSearchOn, HoldsWaysThatDependOnTheSetUp) {
  SetupSearch search{.poses = between_walls(false)};
  search.whole = [](const WorkSetup&) { return std::vector<std::vector<Pose>>{between_walls(true)}; };
  expect_held(machine_, kinematics_, search_setup(machine_, kinematics_, search));
}

TEST_P(SetupSearchOn, PutsThePartAsItIsClamped) {
  // Lying on its side, so that nothing else would bring it upright.
  const Vec3 up = Vec3(0.0, -0.6, 0.8);
  const Eigen::Matrix3d lay = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), up).toRotationMatrix();
  SetupSearch search;
  for (const Pose& p : round_a_pocket()) search.poses.push_back({lay * p.tip + Vec3(3.0, 4.0, 5.0), lay * p.axis});
  search.clamping = {.up = up, .centred = Vec3(3.0, 4.0, 5.0)};
  const FoundSetup found = search_setup(machine_, kinematics_, search);
  ASSERT_TRUE(found.setup) << found.reason;
  EXPECT_LT((found.setup->rotation() * up - machine_.tool_axis).norm(), 1e-5);
  // The point is on the axis of the joint that carries the part, to the micrometres of a set-up that people type.
  const Joint& carries = machine_.joints[kinematics_.rotary_joints()[0]];
  const Vec3 at = found.setup->to_work({Vec3(3.0, 4.0, 5.0), up}).tip - carries.point;
  EXPECT_LT((at - at.dot(carries.direction) * carries.direction).norm(), 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Tables, SetupSearchOn, ::testing::Values("linuxcnc-xyzac-trt", "fanuc-ac", "siemens-ac"));

TEST(SetupSearchOfHeads, HasNoTableToCentreOn) {
  const Machine machine = read_machine("heidenhain-head-head-ca");
  const Kinematics kinematics(machine, machine.tool_length);
  SetupSearch search{.poses = round_a_pocket()};
  search.clamping = {.up = Vec3::UnitZ(), .centred = Vec3(0.0, 0.0, 0.0)};
  EXPECT_THROW((void)search_setup(machine, kinematics, search), UsageError);
}

}  // namespace
}  // namespace flank::internal
