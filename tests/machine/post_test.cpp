// From a path to a program and back: what a machine does is the path, within the bound that is told.
#include "flank/machine/post.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <utility>

#include "flank/error.h"
#include "flank/machine/backplot.h"
#include "flank/machine/links.h"
#include "flank/machine/model/machine_file.h"
#include "flank/machine/nc/dialects/read_nc.h"
#include "flank/machine/nc/dialects/write_nc.h"
#include "flank/machine/setup_search.h"
#include "flank/path/joined_pose.h"
#include "machine/machine_paths.h"

namespace flank::internal {
namespace {

const PostTool kTool{.name = "cone", .axis_length = 40.0, .tip_radius = 3.0, .largest_radius = 5.0};

PostOptions options_at(const Vec3& translation) {
  PostOptions options;
  options.setup.translation = translation;
  options.setup.angles_deg = {10.0, -5.0, 30.0};
  return options;
}

/// Distance of a planned pose from the join of two: of both ends of the flank, at the best place of the join.
double off_join(const Pose& a, const Pose& b, const Pose& wanted, double length) {
  const auto at = [&](double t) {
    const Pose p = joined_pose(a, b, t);
    return std::max((p.tip - wanted.tip).norm(), (p.at(length) - wanted.at(length)).norm());
  };
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 60; ++k) {
    const double third = (high - low) / 3.0;
    if (at(low + third) < at(high - third))
      high -= third;
    else
      low += third;
  }
  return at(0.5 * (low + high));
}

/// Distance of a planned pose from a path: the join that is nearest by its tip decides, or one beside it.
double off(const Strip& strip, const Pose& wanted, double length) {
  std::size_t nearest = 0;
  double least = 1e300;
  for (std::size_t k = 0; k + 1 < strip.poses.size(); ++k) {
    const Pose &a = strip.poses[k], &b = strip.poses[k + 1];
    const Vec3 d = b.tip - a.tip;
    const double t = d.squaredNorm() > 0.0 ? std::clamp(d.dot(wanted.tip - a.tip) / d.squaredNorm(), 0.0, 1.0) : 0.0;
    const Pose p = joined_pose(a, b, t);
    const double here = std::max((p.tip - wanted.tip).norm(), (p.at(length) - wanted.at(length)).norm());
    if (here < least) nearest = k;
    least = std::min(least, here);
  }
  for (std::size_t k = nearest - std::min<std::size_t>(nearest, 1); k < nearest + 2 && k + 1 < strip.poses.size(); ++k)
    least = std::min(least, off_join(strip.poses[k], strip.poses[k + 1], wanted, length));
  return least;
}

/// All planned poses and places between them.
double worst_off(const Path& plan, const Path& real, double length) {
  double worst = 0.0;
  for (std::size_t s = 0; s < plan.strips.size(); ++s)
    for (std::size_t k = 0; k + 1 < plan.strips[s].poses.size(); ++k)
      for (const double t : {0.0, 0.3, 0.5, 0.8, 1.0})
        worst = std::max(
            worst, off(real.strips[s], joined_pose(plan.strips[s].poses[k], plan.strips[s].poses[k + 1], t), length));
  return worst;
}

BackplotOptions backplot_options(const Machine& machine, const PostOptions& options) {
  return {options.setup, machine.tool_length, tip_offset(machine, kTool), kTool.axis_length, 1e-6};
}

/// Posted, written, read and backplotted.
Path there_and_back(const Machine& machine, const Path& path, const PostOptions& options, Post* told = nullptr) {
  Post posted = post(machine, path, kTool, options);
  EXPECT_FALSE(posted.unreachable) << machine.name << ": " << posted.unreachable->reason;
  if (posted.unreachable) return {};
  const std::string text = write_nc(posted.program, machine.dialect);
  const Backplot plot =
      backplot(machine, read_nc(text, "p.nc", machine.dialect), "p.nc", backplot_options(machine, options));
  EXPECT_TRUE(plot.travel.empty()) << machine.name << ": " << plot.travel.front().text;
  EXPECT_TRUE(plot.speed.empty()) << machine.name << ": " << plot.speed.front().text;
  if (told != nullptr) *told = std::move(posted);
  return plot.path;
}

TEST(Post, BackplotOfEveryMachineIsThePathWithinTheBound) {
  const Path path = paths::twisted(60);
  for (const std::string& name : machine_names()) {
    const Machine machine = read_machine(name);
    for (const double deviation : {1e-3, 1e-2}) {
      PostOptions options = options_at(Vec3(5, -8, 60));
      options.deviation = deviation;
      Post told;
      const Path real = there_and_back(machine, path, options, &told);
      ASSERT_EQ(real.strips.size(), 1u) << name;
      EXPECT_LE(told.deviation_mm, deviation) << name;
      EXPECT_LE(worst_off(path, real, kTool.axis_length), told.deviation_mm + told.rounding_mm + 1e-6) << name;
      EXPECT_GT(told.least_sine, 0.0);
      double farthest = 0.0;
      for (const TracePoint& at : told.trace) farthest = std::max(farthest, at.off_path_mm);
      EXPECT_LE(farthest, told.deviation_mm + 1e-9) << name;
      EXPECT_GT(farthest, 0.0) << name;
    }
  }
}

// The same path on the three nestings is the same motion.
TEST(Post, NestingsAgreeWithinAMicrometre) {
  const Path path = paths::twisted(100);
  PostOptions options = options_at(Vec3(0, 0, 80));
  options.deviation = 2e-4;
  std::vector<Path> real;
  for (const char* name : {"fanuc-ac", "fanuc-head-table-bc", "heidenhain-head-head-ca"})
    real.push_back(there_and_back(read_machine(name), path, options));
  for (std::size_t k = 1; k < real.size(); ++k) EXPECT_LT(worst_off(real[0], real[k], kTool.axis_length), 1e-3);
}

TEST(Post, GreatCirclesAndVectorsKeepTheBoundToo) {
  const Path path = paths::twisted(30);
  for (const char* name : {"siemens-ac", "fanuc-ac", "heidenhain-ac"})
    for (const NcJoin join : {NcJoin::kAxes, NcJoin::kGreatCircle})
      for (const NcPositions positions : {NcPositions::kTipRotary, NcPositions::kTipVector}) {
        Machine machine = read_machine(name);
        machine.join = machine.dialect.join = join;
        machine.positions = machine.dialect.positions = positions;
        PostOptions options = options_at(Vec3(0, 0, 60));
        options.deviation = 5e-4;
        Post told = post(machine, path, kTool, options);
        ASSERT_FALSE(told.unreachable);
        std::string text;
        try {
          text = write_nc(told.program, machine.dialect);
        } catch (const UsageError&) {
          continue;  // not every control can say all of it
        }
        const Backplot plot =
            backplot(machine, read_nc(text, "p", machine.dialect), "p", backplot_options(machine, options));
        EXPECT_LE(worst_off(path, plot.path, kTool.axis_length), told.deviation_mm + told.rounding_mm + 1e-6)
            << name << ' ' << static_cast<int>(join) << ' ' << static_cast<int>(positions);
      }
}

// A controlled point at the sphere's centre or at the lowest point: another program, the same motion.
TEST(Post, TheControlledPointDoesNotChangeTheMotion) {
  const Path path = paths::twisted(40);
  Machine machine = read_machine("fanuc-ac");
  const PostOptions options = options_at(Vec3(0, 0, 60));
  const Path lowest = there_and_back(machine, path, options);
  machine.controlled = ControlledPoint::kCentre;
  const Path centre = there_and_back(machine, path, options);
  EXPECT_LT(worst_off(lowest, centre, kTool.axis_length), 2.5e-4);
}

TEST(Post, ASmallerBoundTakesMoreBlocksAndALargerOneFewer) {
  const Path path = paths::twisted(500);
  const Machine machine = read_machine("fanuc-ac");
  std::size_t last = 0;
  for (const double deviation : {1e-1, 1e-2, 1e-3, 1e-5}) {
    PostOptions options = options_at(Vec3(0, 0, 60));
    options.deviation = deviation;
    const Post told = post(machine, path, kTool, options);
    EXPECT_GT(told.program.moves.size(), last);
    last = told.program.moves.size();
    EXPECT_EQ(told.program.moves.size(), told.planned + told.inserted - told.left_out);
    EXPECT_LE(told.deviation_mm, deviation);
  }
}

TEST(Post, LimitsOfJerkAndTheTimeOfABlockCostTimeAndNothingElse) {
  const Path path = paths::twisted(200);
  Machine machine = read_machine("fanuc-ac");
  const PostOptions options = options_at(Vec3(0, 0, 60));
  const Post free = post(machine, path, kTool, options);
  for (Joint& joint : machine.joints) joint.jerk = 20.0 * joint.acceleration;
  const Post smooth = post(machine, path, kTool, options);
  ASSERT_EQ(smooth.program.moves.size(), free.program.moves.size());
  EXPECT_EQ(smooth.program.moves.back().position, free.program.moves.back().position);
  // Each joint takes 50 ms to its largest acceleration.
  EXPECT_GT(smooth.time_s, free.time_s + 0.005);
  EXPECT_LT(smooth.time_s, 1.3 * free.time_s + 0.1);
  machine.block_time = 2.0 * free.time_s / static_cast<double>(free.program.moves.size());
  const Post slow = post(machine, path, kTool, options);
  for (std::size_t i = 1; i < slow.trace.size(); ++i) EXPECT_LT(slow.trace[i].feed_mm_s, options.feed * (1.0 + 1e-6));
  EXPECT_GT(slow.time_s, 1.5 * free.time_s);
}

/// CL points, and how far they pass the singular direction: at a point, or between two.
constexpr std::pair<int, double> kAcross[] = {{41, 0.0},  {41, 1e-9}, {41, 1e-6}, {41, 1e-4}, {41, 1e-2}, {40, 0.0},
                                              {40, 1e-9}, {40, 1e-6}, {40, 1e-4}, {40, 4e-4}, {40, 1e-2}};

// Through the singular direction, exactly and by a hair: it runs, the tool stays on its path, no joint is too fast.
TEST(Post, RunsAcrossTheSingularCone) {
  for (const char* name : {"fanuc-ac", "linuxcnc-xyzac-trt", "joint-ac", "joint-bc", "heidenhain-head-head-ca"})
    for (const auto& [poses, miss] : kAcross) {
      const Machine machine = read_machine(name);
      const Path path = paths::across_the_cone(poses, miss);
      PostOptions options;
      options.setup.translation = Vec3(0, 0, 50);
      options.deviation = 1e-3;
      Post told;
      const Path real = there_and_back(machine, path, options, &told);
      ASSERT_FALSE(real.strips.empty()) << name << ' ' << miss;
      EXPECT_LE(worst_off(path, real, kTool.axis_length), told.deviation_mm + told.rounding_mm + 1e-6)
          << name << ' ' << miss;
      for (std::size_t k = 0; k < kJointCount; ++k) {
        const Joint& joint = machine.joints[k];
        EXPECT_LE(told.use[k].speed, in_units(joint, joint.speed) * (1.0 + 1e-5)) << name << ' ' << miss;
        EXPECT_LE(told.use[k].acceleration, in_units(joint, joint.acceleration) * (1.0 + 1e-5)) << name << ' ' << miss;
      }
      EXPECT_LT(told.least_sine, miss + 1e-9 + 1e-2);
    }
}

// Where the tilting joint may not change its sign, the first one turns half round in the cone instead.
TEST(Post, TurnsRoundInTheConeWhereItMayNotTiltBack) {
  Machine machine = read_machine("fanuc-ac");
  for (Joint& joint : machine.joints)
    if (joint.name == "A") joint.low = 0.0;
  const Path path = paths::across_the_cone(41, 1e-5);
  PostOptions options;
  options.setup.translation = Vec3(0, 0, 50);
  options.deviation = 2e-3;
  Post told;
  const Path real = there_and_back(machine, path, options, &told);
  ASSERT_FALSE(real.strips.empty());
  EXPECT_EQ(told.flips, 0);
  EXPECT_LE(worst_off(path, real, kTool.axis_length), told.deviation_mm + told.rounding_mm + 1e-6);
}

TEST(Post, NamesTheJointThatCannotReach) {
  const Machine machine = read_machine("fanuc-ac");
  PostOptions options = options_at(Vec3(5000, 0, 60));
  const Post far = post(machine, paths::twisted(10), kTool, options);
  ASSERT_TRUE(far.unreachable);
  EXPECT_EQ(far.unreachable_strip, 1);
  EXPECT_NE(far.unreachable->reason.find("its travel is"), std::string::npos) << far.unreachable->reason;
  EXPECT_FALSE(far.unreachable->joint.empty());
  options.setup.translation = Vec3(0, 0, 60);
  options.setup.angles_deg = {180.0, 0.0, 0.0};
  const Post upside_down = post(machine, paths::twisted(10), kTool, options);
  ASSERT_TRUE(upside_down.unreachable);
  EXPECT_EQ(upside_down.unreachable->joint, "A") << upside_down.unreachable->reason;
}

// The rotary table goes on turning where a path winds round.
TEST(Post, WindsOnWithoutJumps) {
  Path path;
  path.strips.push_back({1, "flank", "F1", {}});
  for (int k = 0; k <= 720; ++k) {
    const double t = k * 0.0174532925199433 * 2.0;
    path.strips[0].poses.push_back({Vec3(20 * std::cos(t), 20 * std::sin(t), 0.01 * k),
                                    Vec3(0.5 * std::cos(t), 0.5 * std::sin(t), 0.8).normalized()});
  }
  const Machine machine = read_machine("fanuc-ac");
  PostOptions options;
  options.setup.translation = Vec3(0, 0, 50);
  options.deviation = 1e-3;
  Post told;
  (void)there_and_back(machine, path, options, &told);
  for (const JointUse& use : told.use) {
    if (use.name == "C") {
      EXPECT_NEAR(use.high - use.low, 1440.0, 1.0);
    }
  }
}

TEST(Post, BackplotFindsTravelAndSpeedByLineAndJoint) {
  Machine machine = read_machine("fanuc-ac");
  const PostOptions options = options_at(Vec3(5, -8, 60));
  const Post told = post(machine, paths::twisted(20), kTool, options);
  const std::string text = write_nc(told.program, machine.dialect);
  machine.joints[machine.linear[0]].high = -10.0;
  for (Joint& joint : machine.joints) joint.speed *= 1e-3;
  const Backplot plot = backplot(machine, read_nc(text, "p", machine.dialect), "p", backplot_options(machine, options));
  ASSERT_FALSE(plot.travel.empty());
  EXPECT_EQ(plot.travel[0].joint, "X");
  EXPECT_GT(plot.travel[0].line, 1);
  ASSERT_FALSE(plot.speed.empty());
}

TEST(Post, BackplotRefusesAnotherMachinesProgram) {
  const Machine joint = read_machine("joint-ac"), tip = read_machine("linuxcnc-xyzac-trt");
  const PostOptions options = options_at(Vec3(5, -8, 60));
  const Post told = post(tip, paths::twisted(20), kTool, options);
  EXPECT_THROW((void)backplot(joint, told.program, "p", backplot_options(joint, options)), InputError);
  const Machine other = read_machine("linuxcnc-xyzbc-trt");
  EXPECT_THROW((void)backplot(other, told.program, "p", backplot_options(other, options)), InputError);
}

TEST(Links, KeepOutsideOfTheSphereAndTouchOnlyAtTheirEnds) {
  Path path = paths::twisted(20);
  path.strips.push_back(path.strips[0]);
  path.strips[1].id = 2;
  for (Pose& p : path.strips[1].poses) p.tip += Vec3(0, 15, 0);
  LinkOptions options;
  for (const Strip& s : path.strips)
    for (const Pose& p : s.poses) options.keep_out.add(p.tip);
  options.tool_radius = 5.0;
  options.clearance = 4.0;
  options.lead_at_start = options.lead_at_end = {Lead{}, Lead{Vec3(0, 2, 0), Vec3::Zero()}};
  const Path linked = with_links(path, options);
  ASSERT_EQ(linked.strips.size(), 5u);
  const Vec3 centre = options.keep_out.center();
  const double radius = 0.5 * options.keep_out.diagonal() + options.tool_radius + options.clearance;
  for (std::size_t k = 0; k + 1 < linked.strips.size(); ++k)
    EXPECT_LT((linked.strips[k].poses.back().tip - linked.strips[k + 1].poses.front().tip).norm(), 1e-9);
  // Between the way out and the way in, the whole tool is outside.
  const std::vector<Pose>& between = linked.strips[2].poses;
  std::size_t outside = 0;
  for (std::size_t k = 0; k + 1 < between.size(); ++k) {
    bool clear = true;
    for (const double t : {0.0, 0.5, 1.0})
      for (const double s : {0.0, 10.0, 60.0}) {
        const Pose p = joined_pose(between[k], between[k + 1], t);
        clear = clear && (p.at(s) - centre).norm() >= radius - 1e-9;
      }
    outside += clear ? 1 : 0;
  }
  EXPECT_GE(outside + 5, between.size());
}

TEST(SetupSearch, FindsOneWhereTheOriginIsOutOfReach) {
  const Machine machine = read_machine("linuxcnc-xyzac-trt");
  const Kinematics kinematics(machine, machine.tool_length);
  std::vector<Pose> poses = paths::twisted(50).strips[0].poses;
  for (Pose& p : poses) {  // far from the origin, and from below
    p.tip = Vec3(700, 0, 0) - p.tip;
    p.axis = -p.axis;
  }
  const FoundSetup found = search_setup(machine, kinematics, {.poses = poses});
  ASSERT_TRUE(found.setup) << found.reason;
  EXPECT_GT(found.least_sine, 0.08);
  std::vector<MachinePose> placed;
  for (const Pose& p : poses) placed.push_back({found.setup->to_work(p), true});
  EXPECT_FALSE(choose_joints(machine, kinematics, placed).unreachable);
  EXPECT_EQ(setup_text(parse_setup(setup_text(*found.setup))), setup_text(*found.setup));
}

TEST(SetupSearch, SaysWhyNothingFits) {
  Machine machine = read_machine("linuxcnc-xyzac-trt");
  for (const std::size_t k : machine.linear) machine.joints[k].low = -1.0, machine.joints[k].high = 1.0;
  const Kinematics kinematics(machine, machine.tool_length);
  const FoundSetup found = search_setup(machine, kinematics, {.poses = paths::twisted(50).strips[0].poses});
  EXPECT_FALSE(found.setup);
  EXPECT_NE(found.reason.find("its travel is"), std::string::npos) << found.reason;
}

TEST(WorkSetupText, RefusesWhatIsNone) {
  for (const char* bad : {"", "1", "1,2", "1,2,3,4", "1,2,x", "1,2,3,4,5,nan", "1,2,3,4,5,6,7", "1,2,1e9"})
    EXPECT_THROW((void)parse_setup(bad), UsageError) << bad;
  const WorkSetup setup = parse_setup("1, -2.5, 3, 10, 20, 30");
  const Pose pose{Vec3(1, 2, 3), Vec3(0.6, 0, 0.8)};
  const Pose back = setup.to_part(setup.to_work(pose));
  EXPECT_LT((back.tip - pose.tip).norm() + (back.axis - pose.axis).norm(), 1e-13);
}

TEST(Post, TwoHundredThousandPosesTakeSeconds) {
  const Path path = paths::twisted(200000);
  const Machine machine = read_machine("fanuc-ac");
  PostOptions options = options_at(Vec3(0, 0, 60));
  options.deviation = 1e-3;
  // Of the processor: other work does not count.
  const auto now = [] { return std::clock(); };
  const auto seconds = [](auto a, auto b) { return static_cast<double>(b - a) / CLOCKS_PER_SEC; };
  const auto start = now();
  const Post told = post(machine, path, kTool, options);
  const auto posted = now();
  // A program of all of them.
  const Kinematics kinematics(machine, machine.tool_length);
  NcProgram program = told.program;
  program.moves.assign(1, told.program.moves.front());
  RotaryValues at = {0.0, 0.0};
  for (const Pose& p : path.strips[0].poses) {
    const Pose work = options.setup.to_work(p);
    at = nearest_rotary(kinematics, work.axis, at);
    NcMove move = told.program.moves.back();
    move.position = work.tip - options.setup.translation;
    for (std::size_t k = 0; k < 2; ++k)
      move.orientation(static_cast<int>(k)) = kinematics.joints(work.tip, at)[machine.rotary[k]] * 57.29577951308232;
    program.moves.push_back(move);
  }
  const auto made = now();
  const Backplot plot = backplot(machine, program, "p", backplot_options(machine, options));
  RecordProperty("post_s", std::to_string(seconds(start, posted)));
  RecordProperty("backplot_s", std::to_string(seconds(made, now())));
  EXPECT_GT(plot.path.pose_count(), 200000u);
  EXPECT_LT(seconds(start, now()), 20.0);  // a figure for people: the two are measured in docs/algorithms/machine.md
}

}  // namespace
}  // namespace flank::internal
