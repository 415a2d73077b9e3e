#include "flank/correct/measure/error_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

constexpr double kNoise = 0.002;

/// Two passes, side by side along u, that overlap in the middle: how much more each of them leaves there than the other one.
std::vector<double> higher(double u, double v) {
  const double second = 0.1 * (0.5 - u) + 0.01 * std::sin(9.0 * v);
  return {std::max(0.0, -second), std::max(0.0, second)};
}

/// What the machine adds to each: the second one cuts deeper, as on a machine that has grown warm.
double error_of(std::size_t pass, double u, double v) {
  return pass == 0 ? 0.02 + 0.01 * v : -0.015 * std::cos(2.0 * u) * v;
}

double left(double u, double v) {
  const std::vector<double> more = higher(u, v);
  return std::min(more[0] + error_of(0, u, v), more[1] + error_of(1, u, v));
}

std::vector<MeasuredPoint> measured(int count, double noise) {
  Random random(5);
  std::vector<MeasuredPoint> points;
  for (int k = 0; k < count; ++k) {
    const double u = random.uniform(0.0, 1.0), v = random.uniform(0.0, 1.0);
    points.push_back({k, Vec3(u, v, 0.0), u, v, left(u, v) + noise * random.normal(), higher(u, v)});
  }
  return points;
}

/// Where two passes meet, the error has a kink, and a step where one of them is moved: one smooth field is off there by several um.
TEST(ErrorField, HasKinksWherePassesMeet) {
  const SmoothedError error = smoothed_error(measured(2000, kNoise));
  EXPECT_TRUE(error.outliers.empty());
  EXPECT_NEAR(error.field.noise_mm, kNoise, 0.1 * kNoise);
  double squares = 0.0, worst = 0.0;
  for (int i = 0; i <= 60; ++i)
    for (int j = 0; j <= 60; ++j) {
      const double u = i / 60.0, v = j / 60.0, off = error.field.at(u, v, higher(u, v)) - left(u, v);
      squares += off * off / (61.0 * 61.0);
      worst = std::max(worst, std::abs(off));
    }
  EXPECT_LT(std::sqrt(squares), 0.3 * kNoise);
  EXPECT_LT(worst, 1.5 * kNoise);
}

TEST(ErrorField, OfEachPassIsItsOwn) {
  const SmoothedError error = smoothed_error(measured(2000, kNoise));
  for (const double v : {0.1, 0.5, 0.9}) {
    EXPECT_NEAR(error.field.of_pass(0, 0.1, v), error_of(0, 0.1, v), kNoise);
    EXPECT_NEAR(error.field.of_pass(1, 0.8, v), error_of(1, 0.8, v), kNoise);
  }
}

/// A pass that hardly a point lies on has no field of its own.
TEST(ErrorField, IsOneForAllPassesWhereOneHasTooFewPoints) {
  std::vector<MeasuredPoint> points = measured(400, 0.0);
  for (MeasuredPoint& point : points) {
    point.higher_mm = {0.0, 1.0};
    point.error_mm = 0.01 * point.u;
  }
  const ErrorField field = smoothed_error(points).field;
  ASSERT_EQ(field.passes.size(), 2u);
  EXPECT_NEAR(field.of_pass(1, 0.5, 0.5), 0.005, 1e-4);
  EXPECT_NEAR(field.at(0.5, 0.5, {0.0, 1.0}), 0.005, 1e-4);
}

TEST(ErrorField, NamesPointsThatAreFarOff) {
  std::vector<MeasuredPoint> points = measured(1000, kNoise);
  points[17].error_mm += 0.1;
  points[500].error_mm -= 0.1;
  EXPECT_EQ(smoothed_error(points).outliers, (std::vector<int>{17, 500}));
}

}  // namespace
}  // namespace flank::internal
