// What is sloppy is read, what is wrong is refused with its line.
#include "flank/io/text/step_syntax.h"

#include <gtest/gtest.h>

#include "flank/error.h"

namespace flank::internal {
namespace {

std::string verdict(const std::string& data) {
  try {
    (void)plain_step("p.step", "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n" + data + "\nENDSEC;\nEND-ISO-10303-21;\n");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(StepSyntax, AcceptsWhatProgramsWrite) {
  for (const char* data : {
           "#1=CARTESIAN_POINT('',(0.,-1.5E-3,.5));",
           "#1 = CARTESIAN_POINT ( '' , ( +0. , 1e5,\n 2.5D+2 ) ) ;  /* a comment; with ' and ( */ "
           "#2=DIRECTION('',(0,0,1));",
           "#12=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));",
           "#1=PRODUCT('it''s (a), \"part\"; #5','','',(#2,$,*));",
           "#1=MEASURE(LENGTH_MEASURE(1.E-07),#2,'',\"0FF\");",
           "#1=A(());#2=B();#3=!OWN(.T.,.U.);",
           "#1=A(1.E-400);",
       })
    EXPECT_EQ(verdict(data), "accepted") << data;
}

/// The plain form of the data between DATA; and ENDSEC;.
std::string plain(const std::string& data) {
  const std::string begin = "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n", end = "\nENDSEC;\nEND-ISO-10303-21;\n";
  const std::string text = plain_step("p.step", begin + data + end);
  EXPECT_EQ(text.substr(0, begin.size()), begin);
  EXPECT_EQ(text.substr(text.size() - end.size()), end);
  return text.substr(begin.size(), text.size() - begin.size() - end.size());
}

TEST(StepSyntax, EveryWayToWriteANumberBecomesOne) {
  for (const auto& [written, becomes] : std::vector<std::pair<std::string, std::string>>{{"-4.002E0", "-4.002E0"},
                                                                                         {"-4.002e0", "-4.002E0"},
                                                                                         {"-4.002D0", "-4.002E0"},
                                                                                         {"-4.002d+00", "-4.002E+00"},
                                                                                         {"1e5", "1.E5"},
                                                                                         {"1E5", "1.E5"},
                                                                                         {"12D-3", "12.E-3"},
                                                                                         {"+.5e1", "+.5E1"},
                                                                                         {"5", "5"},
                                                                                         {"-7.", "-7."},
                                                                                         {".25", ".25"},
                                                                                         {"0.5E-05", "0.5E-05"}})
    EXPECT_EQ(plain("#1=A('e',(" + written + ",2.),.T.);"), "#1=A('e',(" + becomes + ",2.),.T.);");
}

TEST(StepSyntax, WordsAreInCapitalsAndCommentsGo) {
  EXPECT_EQ(plain("#1 = plane('it''s e1 /* */',#2,.t.);"), "#1= PLANE('it''s e1 /* */',#2,.T.);");
  EXPECT_EQ(plain("#1\n/* d */ =(length_unit()si_unit(.milli.,.Metre.));"),
            "#1=(LENGTH_UNIT()SI_UNIT(.MILLI.,.METRE.));");
  EXPECT_EQ(plain("#1=A('a'\t,1.)/* '); */;"), "#1=A('a' ,1.) ;");
}

TEST(StepSyntax, AnApostropheBeforeACommaEndsNoText) {
  EXPECT_EQ(plain("#1=A('12'', long',2.);"), "#1=A('12\\X\\27, long',2.);");
  EXPECT_EQ(plain("#1=A('(12'' )',2.);"), "#1=A('(12\\X\\27 )',2.);");
  EXPECT_EQ(plain("#1=A('''inch''',2.);"), "#1=A('''inch''',2.);");
}

TEST(StepSyntax, AByteOrderMarkGoes) {
  EXPECT_EQ(plain_step("p", "\xEF\xBB\xBFISO;DATA;\n#1=A(1e0);\nENDSEC;"), "ISO;DATA;\n#1=A(1.E0);\nENDSEC;");
  EXPECT_EQ(plain_step("p", "ISO;data;\n#1=a(1e0);\nendsec;"), "ISO;DATA;\n#1=A(1.E0);\nendsec;");
}

TEST(StepSyntax, RefusesPointsOfMoreThanThreeCoordinates) {
  for (const char* word : {"CARTESIAN_POINT", "DIRECTION"}) {
    const std::string name = std::string("#1=") + word;
    EXPECT_EQ(verdict(name + "('',(1.,2.,3.));#2=A((1.,2.,3.,4.));"), "accepted");
    EXPECT_NE(verdict(name + "('',(1.,2.,3.,4.));").find("more than 3 coordinates"), std::string::npos) << word;
  }
}

TEST(StepSyntax, RefusesWhatIsDefinedTwice) {
  const std::string message = verdict("#1=A(1.);\n#2=B(#1);\n#1=A(2.);");
  EXPECT_NE(message.find("line 7: #1 is defined a second time"), std::string::npos) << message;
}

TEST(StepSyntax, RefusesNumbersThatWouldBeReadInPart) {
  for (const char* number : {"0x1p5", "--3.", "1.2.3", "1e", "nan", "INF", "1.E400", "-", "+-1.", "1.5x"}) {
    const std::string data = "#1=A(0.);\n#2=B(" + std::string(number) + ",2.);";
    EXPECT_NE(verdict(data).find("p.step, line 6: "), std::string::npos) << number << ": " << verdict(data);
  }
}

TEST(StepSyntax, RefusesWhatLacksAPart) {
  for (const char* data : {"#1=A(1.,,2.);", "#1=A(,1.);", "#1=A(1.,);", "#1=A(1. 2.);", "#1=A('open);", "#1=A(1.;",
                           "#1=A 1.;", "#=A(1.);", "1=A(1.);", "#1=A(B);", "#1=A(.T);", "/* open", "#1=A(1.)"})
    EXPECT_NE(verdict(data), "accepted") << data;
}

TEST(StepSyntax, AFileWithoutDataIsForOthersToRefuse) {
  EXPECT_NO_THROW((void)plain_step("p", ""));
  EXPECT_THROW((void)plain_step("p", "DATA;"), InputError);
  EXPECT_NO_THROW((void)plain_step("p", "HEADER;\nFILE_NAME('all of the DATA; of it');\nENDSEC;\n"));
}

}  // namespace
}  // namespace flank::internal
