#include "flank/io/text/read_unit.h"

#include <gtest/gtest.h>

#include "flank/error.h"

namespace flank::internal {
namespace {

TEST(ReadUnit, TheUnitsThatMayBeAskedForAndNoOthers) {
  EXPECT_EQ(millimetres_per("mm"), 1.0);
  EXPECT_EQ(millimetres_per("cm"), 10.0);
  EXPECT_EQ(millimetres_per("m"), 1000.0);
  EXPECT_EQ(millimetres_per("in"), 25.4);
  for (const char* unit : {"", "MM", "mm ", "ft", "um", "inch", "25.4"}) {
    try {
      (void)millimetres_per(unit);
      ADD_FAILURE() << unit;
    } catch (const UsageError& e) {
      EXPECT_NE(std::string(e.what()).find("expected mm, cm, m or in"), std::string::npos) << e.what();
    }
  }
}

TEST(ReadUnit, NamesAreTheInverse) {
  for (const char* unit : {"mm", "cm", "m", "in"}) EXPECT_EQ(unit_of(millimetres_per(unit)), unit);
  EXPECT_EQ(unit_of(304.8), "ft");
  EXPECT_EQ(unit_of(0.0254), "mil");
  EXPECT_EQ(unit_of(1e-3), "um");
  EXPECT_EQ(unit_of(1e6), "km");
  EXPECT_EQ(unit_of(25.4 * (1.0 + 1e-8)), "in") << "files have rounded factors";
  EXPECT_EQ(unit_of(25.5), "25.5 mm");
}

}  // namespace
}  // namespace flank::internal
