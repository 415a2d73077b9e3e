// The tolerance of a request that gives none.
#include "flank/setup/default_tolerance.h"

#include <gtest/gtest.h>

#include <limits>

namespace flank::internal {
namespace {

TEST(DefaultTolerance, IsAThousandthRoundedDownToOneTwoOrFive) {
  EXPECT_EQ(default_tolerance(99.9), 0.05);
  EXPECT_EQ(default_tolerance(100.0), 0.1);
  EXPECT_EQ(default_tolerance(100.0 * (1.0 - 1e-12)), 0.1) << "the last digits are the computer's";
  EXPECT_EQ(default_tolerance(19.0), 0.01);
  EXPECT_EQ(default_tolerance(450.0), 0.2);
}

TEST(DefaultTolerance, HasBounds) {
  EXPECT_EQ(default_tolerance(0.0), 0.005);
  EXPECT_EQ(default_tolerance(3.0), 0.005);
  EXPECT_EQ(default_tolerance(1e9), 0.5);
  EXPECT_EQ(default_tolerance(std::numeric_limits<double>::quiet_NaN()), 0.005);
}

}  // namespace
}  // namespace flank::internal
