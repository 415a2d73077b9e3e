// FLANK_ASSERT: stops a wrong program if assertions are on, and does nothing at all if they are off.
#include "flank/base/assert.h"

#include <gtest/gtest.h>

#include <array>

namespace flank::internal {
namespace {

int evaluations = 0;

bool evaluated(bool value) {
  ++evaluations;
  return value;
}

/// As a function of the library would use it, in an expression's place and with commas in the condition.
int checked_sum(int a, int b) {
  FLANK_ASSERT(evaluated(a <= b) && std::array<int, 2>{a, b}.size() == 2);
  return FLANK_ASSERT(a >= 0), a + b;
}

TEST(Assert, ATrueConditionLetsTheProgramGoOn) {
  FLANK_ASSERT(1 + 1 == 2);
  EXPECT_EQ(checked_sum(1, 2), 3);
}

TEST(Assert, EvaluatesItsConditionOnceOrInReleaseBuildsNever) {
  evaluations = 0;
  FLANK_ASSERT(evaluated(true));
  EXPECT_EQ(evaluations, FLANK_ASSERTIONS ? 1 : 0);
}

TEST(Assert, IsOnInEveryBuildThatLooksForBugs) {
#if !defined(NDEBUG) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  EXPECT_EQ(FLANK_ASSERTIONS, 1);
#else
  EXPECT_EQ(FLANK_ASSERTIONS, 0);
#endif
}

#if FLANK_ASSERTIONS
using AssertDeathTest = ::testing::Test;

TEST_F(AssertDeathTest, AFalseConditionIsNamedWithItsPlace) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(FLANK_ASSERT(2 + 2 == 5), "assert_test.cpp:[0-9]+: in TestBody: the assertion failed: 2 \\+ 2 == 5");
  EXPECT_DEATH((void)checked_sum(-1, 2), "in checked_sum: the assertion failed: a >= 0");
}
#else
TEST(Assert, AFalseConditionCostsNothingInAReleaseBuild) {
  evaluations = 0;
  FLANK_ASSERT(evaluated(false));
  EXPECT_EQ(checked_sum(-1, 2), 1);
  EXPECT_EQ(evaluations, 0);
}
#endif

}  // namespace
}  // namespace flank::internal
