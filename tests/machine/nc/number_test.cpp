#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "flank/error.h"
#include "flank/machine/nc/nc_number.h"

namespace flank::internal {
namespace {

std::string decimal(double value, int decimals, NcNumberStyle style = {}) {
  std::string text;
  append_decimal(text, value, decimals, style);
  return text;
}

TEST(NcNumber, DecimalsWithoutExponents) {
  EXPECT_EQ(decimal(12.5, 4), "12.5");
  EXPECT_EQ(decimal(70.0, 4), "70.0");
  EXPECT_EQ(decimal(-0.25, 4), "-0.25");
  EXPECT_EQ(decimal(-0.00004, 4), "0.0");
  EXPECT_EQ(decimal(1e-9, 9), "0.000000001");
  EXPECT_EQ(decimal(1e6, 9), "1000000.0");
  EXPECT_EQ(decimal(0.99996, 4), "1.0");
  EXPECT_EQ(decimal(3.0, 0), "3.0");
  EXPECT_EQ(decimal(10.5, 4, {',', true}), "+10,5");
  EXPECT_EQ(decimal(0.0, 4, {',', true}), "+0,0");
  std::string whole;
  append_short_decimal(whole, 1000.0, 3);
  EXPECT_EQ(whole, "1000");
  EXPECT_THROW((void)decimal(std::nan(""), 4), InternalError);
  EXPECT_THROW((void)decimal(std::numeric_limits<double>::infinity(), 4), InternalError);
  EXPECT_THROW((void)decimal(1.1e6, 4), UsageError);
}

TEST(NcNumber, SignificantDigitsOfSmallFeeds) {
  EXPECT_EQ(decimals_of(1000.0, 3, 4), 3);
  EXPECT_EQ(decimals_of(0.012, 3, 4), 5);
  EXPECT_EQ(decimals_of(12.5, 1, 8), 6);
  EXPECT_EQ(decimals_of(1e-8, 1, 8), kMostNcDecimals);
}

TEST(NcNumber, LeadingNumbers) {
  const auto value = [](std::string_view text, bool comma = false) {
    const auto n = leading_number(text, comma);
    return n ? n->value : std::nan("");
  };
  EXPECT_EQ(value("12.5Y3"), 12.5);
  EXPECT_EQ(value("+.5"), 0.5);
  EXPECT_EQ(value("-7."), -7.0);
  EXPECT_EQ(value("1,5", true), 1.5);
  EXPECT_EQ(leading_number("1,5")->length, 1u);
  EXPECT_FALSE(std::signbit(value("-0")));
  for (const char* bad : {"", "-", ".", "+-1", "nan", "inf", "e5", "99999999999", "--1"})
    EXPECT_FALSE(leading_number(bad)) << bad;
  EXPECT_FALSE(leading_number(std::string(60, '1')));
  EXPECT_TRUE(leading_number("7")->point == false && leading_number("7.")->point);
}

}  // namespace
}  // namespace flank::internal
