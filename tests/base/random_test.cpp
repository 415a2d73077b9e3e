#include "flank/base/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace flank::internal {
namespace {

// The reference implementation of SplitMix64 with seed 1234567.
TEST(Random, FollowsTheReferenceSequence) {
  Random random(1234567);
  EXPECT_EQ(random.next(), 6457827717110365317ULL);
  EXPECT_EQ(random.next(), 3203168211198807973ULL);
  EXPECT_EQ(random.next(), 9817491932198370423ULL);
  EXPECT_EQ(random.next(), 4593380528125082431ULL);
  EXPECT_EQ(random.next(), 16408922859458223821ULL);
}

TEST(Random, SameSeedSameSequence) {
  Random a(42), b(42), c(43);
  int different = 0;
  for (int i = 0; i < 100; ++i) {
    const double x = a.normal();
    EXPECT_EQ(x, b.normal());
    if (x != c.normal()) ++different;
  }
  EXPECT_EQ(different, 100);
}

TEST(Random, UniformStaysInItsRangeAndFillsIt) {
  Random random(7);
  constexpr int kCount = 100000;
  double sum = 0.0, sum_squares = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.uniform(-2.0, 3.0);
    ASSERT_GE(x, -2.0);
    ASSERT_LT(x, 3.0);
    sum += x;
    sum_squares += x * x;
  }
  const double mean = sum / kCount;
  // Five standard errors of the mean of a uniform variable of width 5.
  EXPECT_NEAR(mean, 0.5, 5.0 * 5.0 / std::sqrt(12.0 * kCount));
  EXPECT_NEAR(sum_squares / kCount - mean * mean, 25.0 / 12.0, 0.03);
}

TEST(Random, NormalHasMeanZeroAndVarianceOne) {
  Random random(11);
  constexpr int kCount = 100000;
  double sum = 0.0, sum_squares = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.normal();
    ASSERT_TRUE(std::isfinite(x));
    sum += x;
    sum_squares += x * x;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 5.0 / std::sqrt(kCount));
  EXPECT_NEAR(sum_squares / kCount, 1.0, 5.0 * std::sqrt(2.0 / kCount));
}

}  // namespace
}  // namespace flank::internal
