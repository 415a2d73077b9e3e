// The spline basis without a knot vector: what every clamped cubic basis has, and its formulas on a single span.
#include "flank/tool/uniform_cubic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

constexpr double kLength = 12.0;

template <std::size_t N>
double sum(const std::array<double, N>& a) {
  return std::accumulate(a.begin(), a.end(), 0.0);
}

TEST(UniformCubic, SumsToOneInEveryDegreeAndIsNowhereNegative) {
  Random random(1);
  for (const int count : {4, 5, 6, 7, 12, 60})
    for (int k = 0; k < 100; ++k) {
      const UniformCubic b = UniformCubic::at(kLength, count, random.uniform(0.0, kLength));
      EXPECT_NEAR(sum(b.n1), 1.0, 1e-13);
      EXPECT_NEAR(sum(b.n2), 1.0, 1e-13);
      EXPECT_NEAR(sum(b.n3), 1.0, 1e-13);
      for (const double n : b.n3) EXPECT_GE(n, -1e-15);
      EXPECT_GE(b.first, 0);
      EXPECT_LE(b.first + 3, count - 1);
    }
}

TEST(UniformCubic, OnOneSpanIsTheBernsteinBasis) {
  for (int k = 0; k <= 10; ++k) {
    const double t = k / 10.0, m = 1.0 - t;
    const UniformCubic b = UniformCubic::at(kLength, 4, t * kLength);
    EXPECT_EQ(b.first, 0);
    EXPECT_NEAR(b.n3[0], m * m * m, 1e-14);
    EXPECT_NEAR(b.n3[1], 3.0 * t * m * m, 1e-14);
    EXPECT_NEAR(b.n3[2], 3.0 * t * t * m, 1e-14);
    EXPECT_NEAR(b.n3[3], t * t * t, 1e-14);
  }
}

TEST(UniformCubic, FarFromBothEndsIsTheCardinalSpline) {
  for (int k = 0; k < 10; ++k) {
    const double t = k / 10.0;
    const UniformCubic b = UniformCubic::at(kLength, 15, kLength * (5.0 + t) / 12.0);
    EXPECT_EQ(b.first, 5);
    EXPECT_NEAR(b.n3[0], std::pow(1.0 - t, 3) / 6.0, 1e-12);
    EXPECT_NEAR(b.n3[1], (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0, 1e-12);
    EXPECT_NEAR(b.n3[2], (-3.0 * t * t * t + 3.0 * t * t + 3.0 * t + 1.0) / 6.0, 1e-12);
    EXPECT_NEAR(b.n3[3], t * t * t / 6.0, 1e-12);
  }
}

TEST(UniformCubic, EndsBelongToTheirOuterSpansAndTakeTheOuterCoefficientAlone) {
  for (const int count : {4, 5, 9, 40}) {
    const UniformCubic low = UniformCubic::at(kLength, count, 0.0), high = UniformCubic::at(kLength, count, kLength);
    EXPECT_EQ(low.first, 0);
    EXPECT_EQ(high.first, count - 4);
    EXPECT_NEAR(low.n3[0], 1.0, 1e-14);
    EXPECT_NEAR(high.n3[3], 1.0, 1e-12);
    EXPECT_EQ(UniformCubic::at(kLength, count, -1.0).first, 0) << "below, the first span goes on";
    EXPECT_EQ(UniformCubic::at(kLength, count, kLength + 1.0).first, count - 4);
  }
}

/// Greville's identity: with the means of three inner knots as coefficients the spline is s itself.
TEST(UniformCubic, ReproducesTheIdentityFromTheGrevilleSites) {
  for (const int count : {4, 5, 6, 8, 30})
    for (int k = -2; k <= 42; ++k) {
      const double s = kLength * k / 40.0;
      const UniformCubic b = UniformCubic::at(kLength, count, s);
      double value = 0.0;
      for (int j = 0; j < 4; ++j) {
        double site = 0.0;
        for (int i = b.first + j - 2; i <= b.first + j; ++i) site += std::clamp(i, 0, count - 3) / 3.0;
        value += b.n3[static_cast<std::size_t>(j)] * site * kLength / (count - 3);
      }
      EXPECT_NEAR(value, s, 1e-11) << count;
    }
}

TEST(UniformCubic, MirroredParametersMirrorTheBasis) {
  Random random(2);
  for (const int count : {4, 5, 7, 20})
    for (int k = 0; k < 30; ++k) {
      const double s = random.uniform(0.0, kLength);
      const UniformCubic a = UniformCubic::at(kLength, count, s), b = UniformCubic::at(kLength, count, kLength - s);
      EXPECT_EQ(a.first + b.first, count - 4);
      for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(a.n3[j], b.n3[3 - j], 1e-11);
    }
}

}  // namespace
}  // namespace flank::internal
