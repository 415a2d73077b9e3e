// What is sloppy is read, what is wrong is refused with its line.
#include "flank/io/text/step_syntax.h"

#include <gtest/gtest.h>

#include "flank/error.h"

namespace flank::internal {
namespace {

std::string verdict(const std::string& data) {
  try {
    check_step_syntax("p.step", "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n" + data + "\nENDSEC;\nEND-ISO-10303-21;\n");
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
  EXPECT_NO_THROW(check_step_syntax("p", ""));
  EXPECT_THROW(check_step_syntax("p", "DATA;"), InputError);
  EXPECT_NO_THROW(check_step_syntax("p", "HEADER;\nFILE_NAME('all of the DATA; of it');\nENDSEC;\n"));
}

}  // namespace
}  // namespace flank::internal
