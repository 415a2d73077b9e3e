// What is refused, and with which line.
#include <gtest/gtest.h>

#include "flank/error.h"
#include "flank/machine/nc/dialects/languages.h"
#include "flank/machine/nc/dialects/read_nc.h"
#include "flank/machine/nc/dialects/write_nc.h"
#include "machine/nc/sample_programs.h"

namespace flank::internal {
namespace {

const NcCase& named(const std::string& name) {
  static const std::vector<NcCase> kCases = nc_cases();
  for (const NcCase& c : kCases)
    if (c.name == name) return c;
  throw std::logic_error(name);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error(from + " is not in\n" + text);
  return text.replace(at, from.size(), to);
}

std::string sample(const std::string& name) { return write_nc(sample_program(named(name)), named(name).dialect); }

/// The message with which the text is refused as a program of that case; empty if it is read.
std::string refusal(const std::string& text, const std::string& name) {
  try {
    (void)read_nc(text, "part.nc", named(name).dialect);
    return {};
  } catch (const InputError& e) {
    return e.what();
  }
}

struct Damage {
  std::string dialect, from, to, says;
};

class Refused : public ::testing::TestWithParam<Damage> {};

TEST_P(Refused, WithItsLine) {
  const Damage& d = GetParam();
  const std::string message = refusal(replaced(sample(d.dialect), d.from, d.to), d.dialect);
  EXPECT_NE(message.find("part.nc"), std::string::npos) << message;
  EXPECT_NE(message.find(d.says), std::string::npos) << d.from << " -> " << d.to << ": " << message;
}

INSTANTIATE_TEST_SUITE_P(LinuxCnc, Refused,
                         ::testing::Values(Damage{"linuxcnc_tcp", "G21", "G18", "line 7: \"G18\""},
                                           Damage{"linuxcnc_tcp", "G61", "G41.1 D3", "line 8: \"G41.1\""},
                                           Damage{"linuxcnc_tcp", "G43 H3\n", "", "without the tool's length"},
                                           Damage{"linuxcnc_tcp", "G1 X10.0", "G2 X10.0", "\"G2\""},
                                           Damage{"linuxcnc_tcp", "G53 G0 Z0.0", "X1.0", "before any G0 or G1"},
                                           Damage{"fanuc_g434", " F3200.0", "", "before any F"},
                                           Damage{"linuxcnc_tcp", " F800.0", " F0", "more than 0"},
                                           Damage{"linuxcnc_tcp", "G1 X10.0", "G1 X1e1", "\"e1\" is not"},
                                           Damage{"linuxcnc_tcp", "G1 X10.0", "G1 X10.0 X10.0", "states X twice"},
                                           Damage{"linuxcnc_tcp", "G1 X10.0", "G1 B1.0 X10.0", "no axis B"},
                                           Damage{"linuxcnc_tcp", "G1 X10.0", "G1 X#1", "letter and a number"},
                                           Damage{"linuxcnc_tcp", "G1 X10.0", "G1 X2000000.0", "beyond 1000000"},
                                           Damage{"linuxcnc_tcp", "G1 X10.0", "G91 G1 X10.0", "incremental"},
                                           Damage{"linuxcnc_tcp", "(STRIP 1 flank F1)", "(STRIP 1", "not closed"},
                                           Damage{"linuxcnc_tcp", "M2\n%", "M5", "no end"},
                                           Damage{"linuxcnc_tcp", "M2\n%", "M2\nX1.0", "after the end"},
                                           Damage{"linuxcnc_tcp", "M5\n", "G28 Z0\n", "goes by way of a point"},
                                           Damage{"linuxcnc_switched", "M428", "M428 X1.0", "a block of its own"},
                                           Damage{"linuxcnc_switched", "M428\n", "", "under length compensation"},
                                           Damage{"linuxcnc_switched", " F18.75", "", "inverse time without F"},
                                           Damage{"linuxcnc_joint", "S5000 M3", "G43 H3",
                                                  "under length compensation"}));

INSTANTIATE_TEST_SUITE_P(Fanuc, Refused,
                         ::testing::Values(Damage{"fanuc_g434", "G1 X10.0", "G1 X10", "decimal point"},
                                           Damage{"fanuc_g434", "G43.4 H3", "G43 H3", "\"G43\""},
                                           Damage{"fanuc_g434", "G1 X10.0", "G1 I0.0 X10.0", "\"I0.0\""},
                                           Damage{"fanuc_g434", "G5.1 Q1", "G68.2", "\"G68.2\""},
                                           Damage{"fanuc_g435", "I0.6 J0.0 K0.8", "I0.6 K0.8", "three components"},
                                           Damage{"fanuc_g435", "I0.6 J0.0 K0.8", "I0.0 J0.0 K0.0", "no length"},
                                           Damage{"fanuc_g435", "I0.6 J0.0 K0.8 F", "A1.0 C2.0 F", "rotary axes and"},
                                           Damage{"fanuc_g435", "I0.6 J0.0 K0.8 F", "I0.6 J0.0 K0.8 A1.0 F",
                                                  "rotary axes and"},
                                           Damage{"fanuc_g435", "M30", "M98 P1000", "\"M98\""}));

INSTANTIATE_TEST_SUITE_P(Siemens, Refused,
                         ::testing::Values(Damage{"siemens_oriaxes", "G1 X10.0", "G1 X=R1", "a word and a number"},
                                           Damage{"siemens_oriaxes", "G1 X10.0", "G1 X10.0 A2=3", "\"A2=3\""},
                                           Damage{"siemens_oriaxes", "ORIWKS", "ORIMKS", "\"ORIMKS\""},
                                           Damage{"siemens_oriaxes", "TRAORI\n", "TRAORI(2)\n", "\"TRAORI(2)\""},
                                           Damage{"siemens_oriaxes", " D1", " D0", "without the tool's length"},
                                           Damage{"siemens_oriaxes", "FGROUP(X,Y,Z)", "FGROUP(X,Y", "not closed"},
                                           Damage{"siemens_orivect", "A3=0.6 B3=0.0", "A3=0.6", "three components"},
                                           Damage{"siemens_orivect", "ORIWKS ORIVECT", "ORIWKS SPLINE", "\"SPLINE\""},
                                           Damage{"siemens_oriaxes", "X12.0625", "ORIVECT X12.0625",
                                                  "on a great circle) changes between feed moves"}));

INSTANTIATE_TEST_SUITE_P(
    Heidenhain, Refused,
    ::testing::Values(Damage{"heidenhain_m128", "L X+10,0 Y-20,0 Z+12,5", "L IX+10,0 Y-20,0 Z+12,5", "\"IX+10,0\""},
                      Damage{"heidenhain_m128", "R0 FMAX", "RL FMAX", "\"RL\""},
                      Damage{"heidenhain_m128", "M126", "M116", "\"M116\""},
                      Damage{"heidenhain_m128", "15 M128\n", "", "without tool-centre control"},
                      Damage{"heidenhain_m128", "Z S5000", "Z S5000 DR+0,1", "oversize"},
                      Damage{"heidenhain_m128", "CYCL DEF 247", "CYCL DEF 7.0", "\"7.0\""},
                      Damage{"heidenhain_m128", "BEGIN PGM BLADE MM", "BEGIN PGM BLADE", "MM or INCH"},
                      Damage{"heidenhain_tcpm", "AXIS POS", "AXIS SPAT", "spatial angle"},
                      Damage{"heidenhain_tcpm", "F TCP", "F CONT", "is accepted as"},
                      Damage{"heidenhain_ln", "TX+0.6 TY+0.0 TZ+0.8", "TX+0.6", "three components"},
                      Damage{"heidenhain_ln", "M30", "CALL LBL 1", "\"CALL\""}));

INSTANTIATE_TEST_SUITE_P(Apt, Refused,
                         ::testing::Values(Damage{"apt", "RAPID", "CYCLE/DRILL", "\"CYCLE\""},
                                           Damage{"apt", "RAPID", "TRACUT/ON", "\"TRACUT\""},
                                           Damage{"apt", "60.0,0.6,0.0,0.8", "60.0,0.6", "three coordinates"},
                                           Damage{"apt", "60.0,0.6,0.0,0.8", "60.0,0.6,nan,0.8", "\"NAN\""},
                                           Damage{"apt", "MMPM", "IPM", "different units"},
                                           Damage{"apt", "FINI", "", "no end"},
                                           Damage{"apt", "FINI", "GOTO/1,2,3 $", "goes on"}));

TEST(Refusals, AProgramOfAnotherDialectIsNamed) {
  for (const NcCase& of : nc_cases())
    for (const NcCase& as : nc_cases()) {
      if (of.dialect.language == as.dialect.language) continue;
      const std::string message = refusal(sample(of.name), as.name);
      EXPECT_NE(message.find("part.nc, line "), std::string::npos) << of.name << " as " << as.name << ": " << message;
      EXPECT_NE(message.find(std::string(nc_language_name(of.dialect.language)) + " program"), std::string::npos)
          << of.name << " as " << as.name << ": " << message;
    }
}

TEST(Refusals, NoProgramAtAll) {
  for (const NcCase& c : nc_cases())
    for (const std::string text : {"", "\n\n", "hello\n", "solid cube\nfacet normal 0 0 1\n", "%\n%\n"})
      EXPECT_NE(refusal(text, c.name).find("part.nc"), std::string::npos) << c.name << ": " << text;
}

TEST(Refusals, WhatADialectCannotSay) {
  const auto refuses = [](const NcProgram& p, const NcDialect& d) { EXPECT_THROW((void)write_nc(p, d), UsageError); };
  NcProgram circle = sample_program(named("linuxcnc_tcp"));
  circle.join = NcJoin::kGreatCircle;
  refuses(circle, named("linuxcnc_tcp").dialect);
  refuses(sample_program(named("fanuc_g435")), named("linuxcnc_tcp").dialect);
  refuses(sample_program(named("fanuc_g434")), named("apt").dialect);
  refuses(sample_program(named("fanuc_joint")), named("heidenhain_m128").dialect);
  refuses(sample_program(named("linuxcnc_switched")), named("heidenhain_m128").dialect);
  NcProgram pieces = sample_program(named("linuxcnc_tcp"));
  pieces.moves[3].joined = false;
  refuses(pieces, named("linuxcnc_tcp").dialect);
  NcProgram far = sample_program(named("apt"));
  far.moves[2].position.x() = 2e6;
  refuses(far, named("apt").dialect);
  NcProgram slow = sample_program(named("apt"));
  slow.moves[2].feed = 0.0;
  refuses(slow, named("apt").dialect);
  NcProgram nowhere = sample_program(named("apt"));
  nowhere.moves[2].position.x() = std::nan("");
  EXPECT_THROW((void)write_nc(nowhere, named("apt").dialect), InternalError);
}

TEST(Refusals, NamesThatWouldEndAComment) {
  for (const NcCase& c : nc_cases()) {
    NcProgram p = sample_program(c);
    p.header.part = "blade) G0 Z-99 (x;y\nG0 Z-99~$\x01%.step";
    p.header.tool.name = "a\"b)c";
    p.strips[0].face = "F1)\nM3";
    const NcProgram read = read_nc(write_nc(p, c.dialect), "f", c.dialect);
    EXPECT_EQ(read.moves.size(), p.moves.size()) << c.name;
    EXPECT_EQ(read.header.part.find_first_of("();%~$\n"), std::string::npos) << read.header.part;
  }
}

}  // namespace
}  // namespace flank::internal
