// Programs of others within the documented subset; the same files begin the fuzzers' corpus.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "flank/machine/nc/dialects/read_nc.h"

namespace flank::internal {
namespace {

NcProgram read_text(const std::string& text, NcLanguage language, const std::string& rotary = "AC",
                    const std::string& name = "f") {
  NcDialect dialect;
  dialect.language = language;
  dialect.rotary = rotary;
  return read_nc(text, name, dialect);
}

NcProgram read_corpus(const std::string& name, NcLanguage language, const std::string& rotary = "AC") {
  std::ifstream in(std::filesystem::path(FLANK_SOURCE_DIR) / "tests/fuzz/corpus" / name, std::ios::binary);
  return read_text({std::istreambuf_iterator<char>(in), {}}, language, rotary, name);
}

void expect_move(const NcMove& m, NcKind kind, const Vec3& position, const Vec3& orientation, double feed) {
  EXPECT_EQ(m.kind, kind);
  EXPECT_LE((m.position - position).norm(), 1e-12) << m.position.transpose();
  EXPECT_LE((m.orientation - orientation).norm(), 1e-12) << m.orientation.transpose();
  EXPECT_NEAR(m.feed, feed, 1e-9);
}

TEST(ReadNc, LinuxCncInInchesAndSmallLetters) {
  const NcProgram p = read_corpus("nc_linuxcnc/other.ngc", NcLanguage::kLinuxCnc);
  EXPECT_EQ(p.positions, NcPositions::kTipRotary);
  EXPECT_EQ(p.header.tool.number, 2);
  ASSERT_EQ(p.moves.size(), 3u);
  expect_move(p.moves[0], NcKind::kRapid, {0, 0, 50.8}, {0, 0, 0}, 0);
  expect_move(p.moves[1], NcKind::kFeed, {0, 0, 12.7}, {0, 0, 0}, 508);
  expect_move(p.moves[2], NcKind::kFeed, {38.1, 0, 12.7}, {0, 10, 0}, 508);
  EXPECT_EQ(p.moves[2].line, 6);
}

TEST(ReadNc, FanucWithOtherAxesAndAnExtendedOffset) {
  const NcProgram p = read_corpus("nc_fanuc/other.nc", NcLanguage::kFanuc, "BC");
  EXPECT_EQ(p.header.number, 1234);
  EXPECT_EQ(p.header.program, "SIDE 2");
  EXPECT_EQ(p.header.work_offset, 9);
  ASSERT_TRUE(p.start_rotary);
  EXPECT_EQ(*p.start_rotary, Vec2(0, 90));
  ASSERT_EQ(p.moves.size(), 3u);
  expect_move(p.moves[0], NcKind::kRapid, {25.4, -12.7, 76.2}, {0, 90, 0}, 0);
  expect_move(p.moves[2], NcKind::kFeed, {38.1, -12.7, 6.35}, {0, 91.25, 0}, 1016);
}

// G70 and G71 are about coordinates; the feed stays in the control's own unit unless G700 or G710 says otherwise.
TEST(ReadNc, SiemensInchesAndTheirFeeds) {
  const auto read = [](const std::string& unit) {
    const std::string text =
        "G0 G17 G40 G90 G94 " + unit + "\nT=\"C\" D1\nTRAORI\nG54\nORIWKS ORIAXES\nG0 X0 Y0 Z2 A0 C0\nG1 Z1 F20\nM30\n";
    const NcProgram p = read_nc(text, "p.mpf", NcDialect{.language = NcLanguage::kSiemens});
    return std::pair(p.moves.back().position.z(), p.moves.back().feed);
  };
  EXPECT_EQ(read("G70"), std::pair(25.4, 20.0));
  EXPECT_EQ(read("G700"), std::pair(25.4, 508.0));
  EXPECT_EQ(read("G71"), std::pair(1.0, 20.0));
  EXPECT_EQ(read("G710"), std::pair(1.0, 20.0));
}

// Such a comment was taken for our own, and the program that was written with it could not be read.
TEST(ReadNc, ACommentWithANumberThatNoToolHasIsAComment) {
  for (const auto& [number, read] : {std::pair("1000000", 1000000), std::pair("1000001", NcTool().number)}) {
    const std::string text =
        std::string("; TOOL ") + number + " mill\nTRAORI\nG54\nORIWKS ORIAXES\nG0 X0 Y0 Z2 A0 C0\nG1 Z1 F20\nM30\n";
    EXPECT_EQ(read_text(text, NcLanguage::kSiemens).header.tool.number, read) << number;
  }
}

TEST(ReadNc, SiemensWithVectorsOfAnyLength) {
  const NcProgram p = read_corpus("nc_siemens/other.mpf", NcLanguage::kSiemens);
  EXPECT_EQ(p.positions, NcPositions::kTipVector);
  EXPECT_EQ(p.join, NcJoin::kAxes);
  EXPECT_EQ(p.header.tool.name, "CUTTER");
  EXPECT_EQ(p.header.spindle_rpm, 8000.0);
  ASSERT_EQ(p.moves.size(), 3u);
  expect_move(p.moves[0], NcKind::kRapid, {10, 0, 50}, {0, 0, 1}, 0);
  expect_move(p.moves[2], NcKind::kFeed, {20, 0, 0.5}, Vec3(0, 0.1, 1).normalized(), 400);
}

TEST(ReadNc, HeidenhainOfAnOperator) {
  const NcProgram p = read_corpus("nc_heidenhain/other.h", NcLanguage::kHeidenhain);
  EXPECT_EQ(p.join, NcJoin::kGreatCircle);
  EXPECT_EQ(p.header.program, "4711");
  EXPECT_EQ(p.header.tool.name, "BALL 8");
  EXPECT_EQ(p.header.work_offset, 2);
  ASSERT_EQ(p.moves.size(), 3u);
  expect_move(p.moves[0], NcKind::kRapid, {0, 0, 50}, {0, 12.5, 0}, 0);
  expect_move(p.moves[1], NcKind::kFeed, {0, 0, 0.5}, {0, 12.5, 0}, 300);
  expect_move(p.moves[2], NcKind::kFeed, {10, 0, 0.5}, {0, 20, 0}, 300);
}

// M129 acts at the end of its block: the axes beside it still move the tool's centre.
TEST(ReadNc, HeidenhainSwitchesOffBesideTheLastMove) {
  const std::string text =
      "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1\n2 L A+0 C+0 R0 FMAX\n3 M128\n4 L X+0 Y+0 Z+99 A+0 C+0 FMAX\n"
      "5 L X+0 Y+0 Z+1 A+0 C+0 F100\n6 L X+5 Y+0 Z+100 A+0 C+0 R0 FMAX M129\n7 M30\n8 END PGM A MM\n";
  const NcProgram p = read_text(text, NcLanguage::kHeidenhain);
  ASSERT_EQ(p.moves.size(), 3u);
  expect_move(p.moves[2], NcKind::kRapid, {5, 0, 100}, {0, 0, 0}, 0);
}

TEST(ReadNc, AptInInchesWithContinuedStatements) {
  const NcProgram p = read_corpus("nc_apt/other.cls", NcLanguage::kApt);
  EXPECT_EQ(p.header.part, "SIDE 2");
  EXPECT_EQ(p.join, NcJoin::kGreatCircle);
  ASSERT_EQ(p.moves.size(), 4u);
  expect_move(p.moves[0], NcKind::kRapid, {0, 0, 101.6}, {0, 0, 1}, 0);
  expect_move(p.moves[2], NcKind::kFeed, {0, 0, 6.35}, {0, 0, 1}, 508);
  expect_move(p.moves[3], NcKind::kFeed, {25.4, 0, 6.35}, Vec3(0.1, 0, 0.9949874).normalized(), 508);
}

TEST(ReadNc, AProgramInPiecesIsNotJoinedAcrossItsReference) {
  const std::string text =
      "O1\nG21 G90\nG0 A0. C0.\nG43.4 H1\nG0 X0. Y0. Z9.\nG1 Z1. F100.\nG49\nG91 G28 Z0.\nG90\nG0 C90.\n"
      "G43.4 H1\nX5. Y0. Z9.\nG1 Z2.\nG49\nM30\n";
  const NcProgram p = read_text(text, NcLanguage::kFanuc);
  ASSERT_EQ(p.moves.size(), 4u);
  EXPECT_FALSE(p.moves[0].joined);
  EXPECT_TRUE(p.moves[1].joined);
  EXPECT_FALSE(p.moves[2].joined);
  EXPECT_EQ(p.moves[2].orientation.y(), 90.0);
}

TEST(ReadNc, TheApproachBeforeToolVectorsIsNoMove) {
  const std::string text =
      "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1\n2 L A+10 C+5 R0 FMAX\n3 M128\n4 L X+0 Y+0 Z+99 FMAX\n"
      "5 LN X+0 Y+0 Z+9 TX+0 TY+0 TZ+1 FMAX\n6 LN X+0 Y+0 Z+1 TX+0 TY+0 TZ+1 F100\n7 M129\n8 M30\n9 END PGM A MM\n";
  const NcProgram p = read_text(text, NcLanguage::kHeidenhain);
  EXPECT_EQ(p.positions, NcPositions::kTipVector);
  ASSERT_EQ(p.moves.size(), 2u);
  ASSERT_TRUE(p.start_rotary);
  EXPECT_EQ(*p.start_rotary, Vec2(10, 5));
}

}  // namespace
}  // namespace flank::internal
