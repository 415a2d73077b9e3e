#include <gtest/gtest.h>

#include <chrono>

#include "flank/machine/nc/dialects/read_nc.h"
#include "flank/machine/nc/dialects/write_nc.h"
#include "machine/nc/sample_programs.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

// Reading divides by a power of ten and normalises a vector; both round once.
constexpr double kTolerance = 4e-12;

void expect_same_header(const NcHeader& a, const NcHeader& b, NcLanguage language) {
  const bool upper = language == NcLanguage::kFanuc;
  EXPECT_EQ(a.program, b.program);
  EXPECT_EQ(a.number, b.number);
  EXPECT_EQ(a.part, upper ? "BLADE.STEP" : b.part);
  EXPECT_EQ(a.machine, upper ? "SAMPLE" : b.machine);
  EXPECT_EQ(a.tool.number, b.tool.number);
  EXPECT_EQ(a.tool.name, b.tool.name);
  EXPECT_EQ(a.tool.diameter, b.tool.diameter);
  EXPECT_EQ(a.tool.length, b.tool.length);
  EXPECT_EQ(a.tool.tip_offset, b.tool.tip_offset);
  EXPECT_EQ(a.spindle_rpm, b.spindle_rpm);
  EXPECT_EQ(a.work_offset, b.work_offset);
}

void expect_same_strip(const NcProgram& a, const NcMove& ma, const NcProgram& b, const NcMove& mb) {
  ASSERT_EQ(ma.strip < 0, mb.strip < 0);
  if (ma.strip < 0) return;
  const NcStrip &sa = a.strips.at(static_cast<std::size_t>(ma.strip)),
                &sb = b.strips.at(static_cast<std::size_t>(mb.strip));
  ASSERT_EQ(sa.id, sb.id);
  ASSERT_EQ(sa.kind, sb.kind);
  ASSERT_EQ(sa.face, sb.face);
}

void expect_same(const NcProgram& read, const NcProgram& want, NcLanguage language) {
  expect_same_header(read.header, want.header, language);
  EXPECT_EQ(read.positions, want.positions);
  EXPECT_EQ(read.join, want.join);
  EXPECT_EQ(read.feed_mode, want.feed_mode);
  EXPECT_EQ(read.rotary, want.rotary);
  ASSERT_EQ(read.start_rotary.has_value(), want.start_rotary.has_value());
  if (want.start_rotary) {
    EXPECT_LE((*read.start_rotary - *want.start_rotary).norm(), kTolerance * 4e4);
  }
  ASSERT_EQ(read.moves.size(), want.moves.size());
  for (std::size_t i = 0; i < want.moves.size(); ++i) {
    const NcMove &a = read.moves[i], &b = want.moves[i];
    ASSERT_EQ(a.kind, b.kind) << i;
    ASSERT_EQ(a.joined, b.joined) << i;
    ASSERT_GT(a.line, i > 0 ? read.moves[i - 1].line : 0);
    ASSERT_LE((a.position - b.position).norm(), kTolerance * (1.0 + b.position.norm())) << i;
    ASSERT_LE((a.orientation - b.orientation).norm(), kTolerance * (1.0 + b.orientation.norm())) << i;
    ASSERT_NEAR(a.feed, b.feed, kTolerance * b.feed) << i;
    expect_same_strip(read, a, want, b);
  }
}

class RoundTrip : public ::testing::TestWithParam<NcCase> {};

TEST_P(RoundTrip, TheSampleReadsBack) {
  const NcCase& c = GetParam();
  const NcProgram program = sample_program(c);
  expect_same(read_nc(write_nc(program, c.dialect), "f", c.dialect), printed(program, c.dialect), c.dialect.language);
}

TEST_P(RoundTrip, RandomProgramsReadBackAsTheirDecimals) {
  const NcCase& c = GetParam();
  Random random(11);
  for (int k = 0; k < 40 && !HasFatalFailure(); ++k) {
    NcDialect d = c.dialect;
    d.length_decimals = static_cast<int>(random.uniform(2, 7.99));
    d.angle_decimals = static_cast<int>(random.uniform(2, 7.99));
    d.vector_decimals = static_cast<int>(random.uniform(5, 9.99));
    d.line_numbers = random.uniform() < 0.5;
    d.decimal_comma = random.uniform() < 0.5;
    const NcProgram program = random_program(random, c, 60);
    const std::string text = write_nc(program, d);
    SCOPED_TRACE(text);
    expect_same(read_nc(text, "f", d), printed(program, d), d.language);
  }
}

TEST_P(RoundTrip, WhatWasReadIsWrittenToTheSameBytes) {
  const NcCase& c = GetParam();
  Random random(12);
  const std::string text = write_nc(random_program(random, c, 100), c.dialect);
  EXPECT_EQ(write_nc(read_nc(text, "f", c.dialect), c.dialect), text);
}

TEST_P(RoundTrip, LineEndsOfAnotherSystemAreRead) {
  const NcCase& c = GetParam();
  const NcProgram program = sample_program(c);
  std::string text;
  for (const char ch : write_nc(program, c.dialect)) (ch == '\n' ? text += '\r' : text) += ch;
  expect_same(read_nc(text, "f", c.dialect), printed(program, c.dialect), c.dialect.language);
}

TEST_P(RoundTrip, TwoHundredThousandMovesInSeconds) {
  const NcCase& c = GetParam();
  Random random(13);
  const NcProgram program = random_program(random, c, 200000);
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  const auto begin = Clock::now();
  const std::string text = write_nc(program, c.dialect);
  const auto written = Clock::now();
  const NcProgram read = read_nc(text, "f", c.dialect);
  const auto done = Clock::now();
  RecordProperty("write_seconds", std::to_string(seconds(written - begin)));
  RecordProperty("read_seconds", std::to_string(seconds(done - written)));
  EXPECT_EQ(read.moves.size(), program.moves.size());
  if (kSanitized) return;
  EXPECT_LT(seconds(written - begin), 2.0);
  EXPECT_LT(seconds(done - written), 2.0);
}

INSTANTIATE_TEST_SUITE_P(Dialects, RoundTrip, ::testing::ValuesIn(nc_cases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace flank::internal
