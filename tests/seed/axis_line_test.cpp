#include "flank/seed/axis_line.h"

#include <gtest/gtest.h>

#include "flank/error.h"

namespace flank::internal {
namespace {

TEST(AxisLine, ReadsCommasAndBlanks) {
  for (const char* text : {"0,0,5,0,0,45", " 0 0 5  0 0 45 ", "0, 0, 5.0,\t0,+0, 4.5e1"}) {
    const AxisLine line = parse_start_line(text);
    EXPECT_EQ(line.tip, Vec3(0, 0, 5)) << text;
    EXPECT_NEAR(line.length(), 40.0, 1e-12);
    EXPECT_LT((line.pose().axis - Vec3::UnitZ()).norm(), 1e-12);
  }
}

TEST(AxisLine, RefusesWhatIsNoLine) {
  for (const char* text : {"", "1,2,3", "1,2,3,4,5,6,7", "1,2,3,4,5,x", "1,2,3,4,5,nan", "1,2,3,4,5,inf", "1,2,3,1,2,3",
                           "1,2,3,4,5,6mm", "1,2,3,4,5,1e999"}) {
    EXPECT_THROW((void)parse_start_line(text), UsageError) << text;
  }
}

TEST(AxisLine, SaysWhatIsWrong) {
  try {
    (void)parse_start_line("1,2,3");
    FAIL();
  } catch (const UsageError& error) {
    const std::string what = error.what();
    EXPECT_EQ(error.field(), "start");
    EXPECT_EQ(what.find("start 1,2,3: "), 0u) << what;
    EXPECT_NE(what.find("six"), std::string::npos);
    EXPECT_NE(what.find("3 numbers"), std::string::npos);
  }
}

}  // namespace
}  // namespace flank::internal
