// How programs begin and end, on every machine that is shipped: the tool out of the way before anything turns, no rapid that turns
// an axis under tool-centre control, a spindle that runs before anything is cut, upright at both ends; and blocks that no
// control runs faster than they say.
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <sstream>

#include "flank/error.h"
#include "flank/machine/backplot.h"
#include "flank/machine/links.h"
#include "flank/machine/model/machine_file.h"
#include "flank/machine/nc/dialects/read_nc.h"
#include "flank/machine/nc/dialects/write_nc.h"
#include "flank/machine/nc/write/timed_blocks.h"
#include "flank/machine/post.h"
#include "machine/machine_paths.h"

namespace flank::internal {
namespace {

const PostTool kTool{.name = "cone", .axis_length = 40.0, .tip_radius = 3.0, .largest_radius = 5.0};

/// Two strips, linked, begun and ended upright, as post_folder does it.
Path linked(const Machine& machine, const WorkSetup& setup) {
  Path path = paths::twisted(40);
  path.strips.push_back(path.strips[0]);
  path.strips[1].id = 2;
  for (Pose& p : path.strips[1].poses) p.tip += Vec3(0, 15, 0);
  LinkOptions options;
  for (const Strip& s : path.strips)
    for (const Pose& p : s.poses) options.keep_out.add(p.tip);
  options.tool_radius = kTool.largest_radius;
  options.lead_at_start = options.lead_at_end = {Lead{}, Lead{}};
  const Vec3 up = setup.rotation().transpose() * Kinematics(machine, machine.tool_length).direction({0.0, 0.0});
  return upright(with_links(path, options), options, up);
}

NcProgram program_for(const Machine& machine, double spindle) {
  PostOptions options;
  options.setup.translation = Vec3(5, -8, 60);
  options.setup.angles_deg = {10.0, -5.0, 30.0};
  options.deviation = 1e-3;
  options.feed = 20.0;
  Post posted = post(machine, linked(machine, options.setup), kTool, options);
  EXPECT_FALSE(posted.unreachable) << machine.name << ": " << posted.unreachable->reason;
  posted.program.header.spindle_rpm = spindle;
  posted.program.header.dry_run = spindle == 0.0;
  return std::move(posted.program);
}

/// The blocks without numbers and comments.
std::vector<std::string> blocks_of(const std::string& text) {
  std::vector<std::string> blocks;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line = std::regex_replace(line, std::regex(R"(\([^)]*\)|;.*|^N?\d+ )"), "");
    line = std::regex_replace(line, std::regex(R"(^ +| +$)"), "");
    if (!line.empty()) blocks.push_back(line);
  }
  return blocks;
}

bool says(const std::string& block, const char* pattern) { return std::regex_search(block, std::regex(pattern)); }

/// A block that moves an axis, and one that names a rotary axis; A3= is a component of a vector.
bool moves(const std::string& block) { return says(block, R"((^| )([XYZABC][-+]?\d|M140))"); }
bool turns(const std::string& block) { return says(block, R"((^| )[ABC][-+]?\d+([.,]|\s|$))"); }
bool retracts(const std::string& block) { return says(block, "^(G91 G28 Z|G53 G0 Z|SUPA G0 Z)|M140 MB MAX|M91"); }
bool switches_on(const std::string& block) { return says(block, "G43|M428|TRAORI|M128|^FUNCTION TCPM"); }
bool switches_off(const std::string& block) { return says(block, "G49|M429|TRAFOOF|M129|RESET TCPM"); }

/// A text with what holds in it, block by block.
template <class Visit>
void follow(const std::string& text, const Visit& visit) {
  bool rapid = true, centre = false;
  for (const std::string& block : blocks_of(text)) {
    if (switches_on(block)) centre = true;
    if (switches_off(block)) centre = false;
    if (says(block, "(^| )G0( |$)")) rapid = true;
    if (says(block, "(^| )G1( |$)")) rapid = false;
    const bool heidenhain = says(block, "^LN? ");
    visit(block, heidenhain ? says(block, "FMAX") : rapid, centre);
  }
}

class ProgramShape : public ::testing::TestWithParam<std::string> {
 protected:
  Machine machine_ = read_machine(GetParam());
};

TEST_P(ProgramShape, BeginsAndEndsOutOfTheWay) {
  const std::vector<std::string> blocks = blocks_of(write_nc(program_for(machine_, 8000.0), machine_.dialect));
  const auto first = std::find_if(blocks.begin(), blocks.end(), moves);
  ASSERT_NE(first, blocks.end());
  EXPECT_TRUE(retracts(*first)) << *first;
  // What moves last is out of the way, too; then the rotary axes alone.
  auto last = std::find_if(blocks.rbegin(), blocks.rend(), moves);
  EXPECT_TRUE(turns(*last) && !says(*last, R"([XYZ][-+]?\d)")) << *last;
  last = std::find_if(last + 1, blocks.rend(), moves);
  EXPECT_TRUE(retracts(*last)) << *last;
}

TEST_P(ProgramShape, NoRapidTurnsAnAxisUnderToolCentreControl) {
  follow(write_nc(program_for(machine_, 8000.0), machine_.dialect),
         [&](const std::string& block, bool rapid, bool centre) {
           EXPECT_FALSE(rapid && centre && turns(block)) << block;
         });
  // Nor is one written that somebody else has made.
  if (machine_.positions == NcPositions::kJoint) return;
  NcProgram program = program_for(machine_, 8000.0);
  program.moves[program.moves.size() / 2].kind = NcKind::kRapid;
  EXPECT_THROW((void)write_nc(program, machine_.dialect), UsageError);
}

TEST_P(ProgramShape, TheSpindleRunsBeforeItCutsOrTheHeaderSaysThatItStands) {
  bool runs = false, cut = false;
  follow(write_nc(program_for(machine_, 8000.0), machine_.dialect), [&](const std::string& block, bool rapid, bool) {
    runs = runs || says(block, "(^| )M3( |$)");
    if (!rapid && moves(block) && !retracts(block)) {
      EXPECT_TRUE(runs) << block;
      cut = true;
    }
  });
  EXPECT_TRUE(runs && cut);
  const std::string dry = write_nc(program_for(machine_, 0.0), machine_.dialect);
  EXPECT_NE(dry.find("DRY RUN: THE SPINDLE STANDS STILL"), std::string::npos);
  EXPECT_FALSE(says(dry, "(^|\n|\\s)M3\\b"));
}

TEST_P(ProgramShape, StandsUprightWhereToolCentreControlIsSwitched) {
  const NcProgram program = read_nc(write_nc(program_for(machine_, 8000.0), machine_.dialect), "p", machine_.dialect);
  const Kinematics kinematics(machine_, machine_.tool_length);
  const Vec3 up = kinematics.direction({0.0, 0.0});
  const BackplotOptions options{{}, machine_.tool_length, tip_offset(machine_, kTool), kTool.axis_length, 1e-4};
  const Backplot plot = backplot(machine_, program, "p", options);
  ASSERT_FALSE(plot.joints.empty());
  for (const JointValues& q : {plot.joints.front(), plot.joints.back()})
    EXPECT_LT((kinematics.direction(kinematics.rotary_of(q)) - up).norm(), 1e-6);
  const NcProgram made = program_for(machine_, 8000.0);
  ASSERT_TRUE(made.end_rotary);
  const Vec2 from = Vec2(plot.joints.back()[machine_.rotary[0]], plot.joints.back()[machine_.rotary[1]]) * 180.0 / M_PI;
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(std::remainder((*made.end_rotary)(k), 360.0), 0.0);
    EXPECT_LE(std::abs((*made.end_rotary)(k)-from(k)), 180.0 + 1e-6) << "by the nearest way";
  }
}

// Whatever the machine's file says of digits, what they move the tool by is told.
TEST_P(ProgramShape, WhatItsDigitsAddIsTold) {
  PostOptions options;
  options.setup.translation = Vec3(5, -8, 60);
  options.feed = 20.0;
  for (const int decimals : {0, 2, machine_.dialect.length_decimals}) {
    machine_.dialect.length_decimals = decimals;
    const Post told = post(machine_, linked(machine_, options.setup), kTool, options);
    ASSERT_FALSE(told.unreachable);
    EXPECT_GE(told.rounding_mm, std::sqrt(3.0) * 0.5 * std::pow(10.0, -decimals));
    EXPECT_LE(told.rounding_mm, std::pow(10.0, -decimals) + 0.01);
  }
}

// LinuxCNC: in inverse time its feed is length times F, and never less than 0.1 mm/min.
TEST_P(ProgramShape, NoBlockIsRunFasterThanItSays) {
  const NcProgram program = read_nc(write_nc(program_for(machine_, 8000.0), machine_.dialect), "p", machine_.dialect);
  if (slowest_turning_feed(program, machine_.dialect) == 0.0) return;
  for (std::size_t i = 1; i < program.moves.size(); ++i) {
    const NcMove &a = program.moves[i - 1], &b = program.moves[i];
    const double way = (b.position - a.position).norm();
    if (way > 0.0 && b.orientation != a.orientation) {
      EXPECT_GE(way * b.feed, 0.1) << "line " << b.line;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Machines, ProgramShape, ::testing::ValuesIn(machine_names()),
                         [](const auto& test) { return std::regex_replace(test.param, std::regex("[^a-z]"), "_"); });

// A point that creeps while the axes turn: held, and made good in blocks of its own, in the same time.
TEST(TimedBlocks, ACreepingPointWaitsWhileTheAxesTurn) {
  for (const double creep : {2e-5, 2e-4, 0.05}) {
    NcProgram program;
    program.feed_mode = NcFeedMode::kInverseTime;
    const NcDialect dialect{.language = NcLanguage::kLinuxCnc, .length_decimals = 5, .angle_decimals = 6};
    std::vector<BlockTime> times(1);
    double seconds = 0.0;
    program.moves.push_back({.kind = NcKind::kRapid, .joined = false});
    for (int k = 1; k <= 4; ++k) {
      NcMove move;
      move.position = Vec3(creep * k, 0, 0);
      move.orientation = Vec3(0, 178.0 * k, 0);
      program.moves.push_back(move);
      times.push_back({60.0, 178.0});
      seconds += 60.0;
    }
    const NcProgram planned = program;
    const double held = state_feeds(program, times, dialect, 0.001);
    EXPECT_LE(held, 0.001 + 1e-9);
    double told = 0.0;
    for (std::size_t i = 1; i < program.moves.size(); ++i) {
      const NcMove &a = program.moves[i - 1], &b = program.moves[i];
      const double way = (b.position - a.position).norm();
      EXPECT_TRUE(way == 0.0 || b.orientation == a.orientation || way * b.feed >= 0.1) << creep << ", block " << i;
      told += 60.0 / b.feed;
    }
    EXPECT_NEAR(told, seconds, 0.01 * seconds) << creep;
    EXPECT_LE((program.moves.back().position - planned.moves.back().position).norm(), 0.001 + 1e-5);
    EXPECT_EQ(program.moves.back().orientation, planned.moves.back().orientation);
    // Another control has no such limit: nothing is changed there.
    NcProgram other = planned;
    (void)state_feeds(other, times, {.language = NcLanguage::kFanuc, .length_decimals = 5}, 0.001);
    EXPECT_EQ(other.moves.size(), planned.moves.size());
  }
}

}  // namespace
}  // namespace flank::internal
