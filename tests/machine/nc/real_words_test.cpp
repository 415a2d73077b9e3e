// What programs of shops hold beside motion: words that a machine's file calls without effect, blanks, blocks that may be skipped, and
// the words that say which frame, tool, length and spindle a move is made with.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "flank/error.h"
#include "flank/machine/model/machine_file.h"
#include "flank/machine/nc/dialects/languages.h"
#include "flank/machine/nc/dialects/read_nc.h"
#include "flank/machine/nc/without_effect.h"

namespace flank::internal {
namespace {

/// A short program of a language, with a place for a block before its first cut.
std::string program(NcLanguage language, const std::string& block) {
  switch (language) {
    case NcLanguage::kFanuc:
      return "O1\nG21 G90 G94\nT3 M6\nG55\nS900 M3\nG0 A0. C0.\n" + block +
             "\nG43.4 H3\nG0 X0. Y0. Z9.\nG1 Z1. F100.\nX -16.3\nG49\nM30\n";
    case NcLanguage::kSiemens:
      return "G0 G90 G710\nT=\"CUTTER\" D1\nM6\nG55\nS900 M3\nG0 A0 C0\n" + block +
             "\nTRAORI\nG55\nORIWKS ORIAXES\nG0 X0 Y0 Z9 A0 C0\nG1 Z1 F100\nX -16.3\nTRAFOOF\nM30\n";
    case NcLanguage::kHeidenhain:
      return "0 BEGIN PGM A MM\n1 TOOL CALL 3 Z S900\n2 CYCL DEF 247 Q339=2\n3 M3\n4 L A+0 C+0 R0 FMAX\n5 " + block +
             "\n6 M128\n7 L X+0 Y+0 Z+9 A+0 C+0 FMAX\n8 L Z+1 F100\n9 L X -16,3 Y +0\n10 M129\n11 M30\n12 END PGM A "
             "MM\n";
    default:
      return "G21 G90 G94\nT3 M6\nG43 H3\nG55\nS900 M3\nG0 A0 C0\n" + block +
             "\nM428\nG0 X0 Y0 Z9\nG1 Z1 F100\nX -16.3\nM429\nM2\n";
  }
}

NcDialect dialect_of(NcLanguage language, std::vector<std::string> without_effect = {}) {
  NcDialect dialect{.language = language, .rotary = "AC"};
  dialect.without_effect = std::move(without_effect);
  if (language == NcLanguage::kLinuxCnc) dialect.tcp_on = "M428", dialect.tcp_off = "M429";
  return dialect;
}

std::string refusal(const std::string& text, const NcDialect& dialect) {
  try {
    (void)read_nc(text, "p.nc", dialect);
    return {};
  } catch (const InputError& e) {
    return e.what();
  }
}

constexpr std::array<NcLanguage, 4> kLanguages = {NcLanguage::kFanuc, NcLanguage::kSiemens, NcLanguage::kHeidenhain,
                                                  NcLanguage::kLinuxCnc};

TEST(WithoutEffect, AWordIsReadWhereTheMachineNamesItAndRefusedByItselfWhereNot) {
  for (const NcLanguage language : kLanguages)
    for (const char* word : {"M10", "M011", "M88"}) {
      const std::string text = program(language, word);
      const std::string why = refusal(text, dialect_of(language));
      EXPECT_NE(why.find('"' + std::string(word) + '"'), std::string::npos) << why;
      EXPECT_NE(why.find(language == NcLanguage::kHeidenhain ? "line 6" : "line 7"), std::string::npos) << why;
      EXPECT_EQ(refusal(text, dialect_of(language, {"M10", "M11", "M88"})), "") << word;
      EXPECT_NE(refusal(text, dialect_of(language, {"M12"})), "") << word;
    }
}

TEST(WithoutEffect, NamesAndParameters) {
  const NcDialect siemens = dialect_of(NcLanguage::kSiemens, {"CYCLE800()", "G601"});
  EXPECT_EQ(refusal(program(NcLanguage::kSiemens, "CYCLE800()"), siemens), "");
  EXPECT_EQ(refusal(program(NcLanguage::kSiemens, "CYCLE800( )"), siemens), "");
  EXPECT_NE(refusal(program(NcLanguage::kSiemens, "CYCLE800(1,\"TC1\",0)"), siemens).find("CYCLE800"),
            std::string::npos);
  EXPECT_NE(refusal(program(NcLanguage::kSiemens, "CYCLE800()"), dialect_of(NcLanguage::kSiemens)), "");
  EXPECT_EQ(refusal(program(NcLanguage::kFanuc, "G187 P1 E0.01"), dialect_of(NcLanguage::kFanuc, {"G187"})), "");
  EXPECT_NE(refusal(program(NcLanguage::kFanuc, "G187 P1"), dialect_of(NcLanguage::kFanuc)).find("\"G187\""),
            std::string::npos);
  EXPECT_EQ(refusal(program(NcLanguage::kHeidenhain, "PLANE RESET STAY"),
                    dialect_of(NcLanguage::kHeidenhain, {"PLANE RESET STAY"})),
            "");
  EXPECT_NE(refusal(program(NcLanguage::kHeidenhain, "PLANE SPATIAL SPA+0 SPB+0 SPC+0 STAY"),
                    dialect_of(NcLanguage::kHeidenhain, {"PLANE RESET STAY"})),
            "");
}

TEST(WithoutEffect, WhatHasOneIsNotCalledSo) {
  for (const char* word : {"G0",  "G1",   "G2",    "G41",  "G43.4", "G54",    "G54.1",   "G68.2",    "G91",
                           "G92", "M6",   "M3",    "M128", "M98",   "TRAORI", "ORIAXES", "CYCLE800", "PLANE SPATIAL",
                           "X10", "F100", "S5000", "L",    "",      "!",      "M10;"})
    EXPECT_NE(why_not_without_effect(word), "") << word;
  for (const char* word : {"M10", "M11", "M46", "G187", "G5.1", "CYCLE800()", "CYCLE832", "PLANE RESET STAY", "SOFT"})
    EXPECT_EQ(why_not_without_effect(word), "") << word;
}

TEST(WithoutEffect, MachinesThatComeWithTheProgramReadTheirClamps) {
  for (const std::string& name : machine_names()) {
    const Machine machine = read_machine(name);
    if (machine.dialect.language == NcLanguage::kLinuxCnc) continue;
    EXPECT_TRUE(is_without_effect(machine.dialect, 'M', 10.0)) << name;
    for (const std::string& word : machine.dialect.without_effect) EXPECT_EQ(why_not_without_effect(word), "") << word;
  }
}

TEST(RealWords, BlanksBetweenALetterAndItsNumber) {
  for (const NcLanguage language : kLanguages) {
    const NcProgram p = read_nc(program(language, ""), "p", dialect_of(language));
    EXPECT_EQ(p.moves.back().position, Vec3(-16.3, 0, 1)) << nc_language_name(language);
  }
}

TEST(RealWords, ASkippedBlockIsReadWhereItIsTheSame) {
  for (const NcLanguage language : kLanguages) {
    const std::string move = language == NcLanguage::kHeidenhain ? "/ L X+5" : "/ X5.0";
    EXPECT_EQ(refusal(program(language, "/ M1"), dialect_of(language)), "") << nc_language_name(language);
    EXPECT_EQ(refusal(program(language, "/M10"), dialect_of(language, {"M10"})), "") << nc_language_name(language);
    const std::string why = refusal(program(language, move), dialect_of(language));
    EXPECT_NE(why.find("may be skipped"), std::string::npos) << why;
  }
  EXPECT_EQ(refusal(program(NcLanguage::kFanuc, "N20 /M1"), dialect_of(NcLanguage::kFanuc)), "");
}

TEST(RealWords, VectorsUnderG434AreNamed) {
  std::string text = program(NcLanguage::kFanuc, "");
  text.replace(text.find("X -16.3"), 7, "X5. I0. J0. K1.");
  const std::string why = refusal(text, dialect_of(NcLanguage::kFanuc));
  EXPECT_NE(why.find("tool vector under G43.4"), std::string::npos) << why;
  EXPECT_NE(why.find("G43.5"), std::string::npos) << why;
}

TEST(RealWords, KinematicsAreSwitchedByGWordsToo) {
  NcDialect dialect = dialect_of(NcLanguage::kLinuxCnc);
  dialect.tcp_on = "G12.1 P1";
  dialect.tcp_off = "G13.1";
  std::string text = program(NcLanguage::kLinuxCnc, "");
  text.replace(text.find("M428"), 4, "N70 G12.1 P1");
  text.replace(text.find("M429"), 4, "G13.1");
  const NcProgram p = read_nc(text, "p", dialect);
  EXPECT_EQ(p.positions, NcPositions::kTipRotary);
  ASSERT_EQ(p.moves.size(), 3u);
  EXPECT_NE(refusal(program(NcLanguage::kLinuxCnc, "G12.1 P2"), dialect).find("\"G12.1\""), std::string::npos);
}

TEST(RealWords, EveryMoveKnowsItsFrameToolLengthAndSpindle) {
  for (const NcLanguage language : kLanguages) {
    SCOPED_TRACE(nc_language_name(language));
    const NcProgram p = read_nc(program(language, ""), "p", dialect_of(language));
    const NcModes& modes = p.modes.at(static_cast<std::size_t>(p.moves.back().modes));
    EXPECT_EQ(modes.work_offset, 2);
    EXPECT_TRUE(modes.spindle);
    if (language == NcLanguage::kSiemens) {
      EXPECT_EQ(modes.tool_name, "CUTTER");
      EXPECT_EQ(modes.edge, 1);
    } else {
      EXPECT_EQ(modes.tool, 3);
      EXPECT_EQ(modes.length, language == NcLanguage::kHeidenhain ? std::nullopt : std::optional(3));
    }
  }
}

TEST(RealWords, AToolIsInTheSpindleWhenItWasChanged) {
  const auto modes = [](NcLanguage language, const std::string& block) {
    const NcProgram p = read_nc(program(language, block), "p", dialect_of(language));
    return p.modes.at(static_cast<std::size_t>(p.moves.back().modes));
  };
  EXPECT_EQ(modes(NcLanguage::kFanuc, "T4").tool, 3);
  EXPECT_EQ(modes(NcLanguage::kFanuc, "M6 T4").tool, 4);
  EXPECT_FALSE(modes(NcLanguage::kFanuc, "M6 T4").spindle);
  EXPECT_FALSE(modes(NcLanguage::kLinuxCnc, "M5").spindle);
  EXPECT_EQ(modes(NcLanguage::kLinuxCnc, "G43").length, 3);
  EXPECT_EQ(modes(NcLanguage::kLinuxCnc, "G43 H4").length, 4);
  EXPECT_EQ(modes(NcLanguage::kSiemens, "T=\"NEXT\"").tool_name, "CUTTER");
  EXPECT_EQ(modes(NcLanguage::kSiemens, "T=\"NEXT\" M6").tool_name, "NEXT");
  EXPECT_EQ(modes(NcLanguage::kHeidenhain, "TOOL CALL 4 Z").tool, 4);
  EXPECT_EQ(modes(NcLanguage::kHeidenhain, "TOOL CALL Z S100").tool, 3);
  std::string without = program(NcLanguage::kFanuc, "");
  without.replace(without.find(" H3"), 3, "");
  const NcProgram p = read_nc(without, "p", dialect_of(NcLanguage::kFanuc));
  EXPECT_EQ(p.modes.back().length, 0);
}

}  // namespace
}  // namespace flank::internal
