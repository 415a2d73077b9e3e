#include "flank/correct/measure/ground_tool.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/base/random.h"
#include "flank/error.h"

namespace flank::internal {
namespace {

constexpr double kLength = 30.0;

RadialFunction nominal() { return {ToolFamily::kBarrel, kLength, Eigen::Vector3d(120.0, 6.0, 12.0)}; }

/// The nominal tool with an error that a wheel leaves: a wave, a taper, another diameter.
RadialFunction as_ground() {
  std::vector<Vec2> samples;
  for (int k = 0; k <= 600; ++k) {
    const double s = kLength * k / 600;
    const double error = 0.006 * std::sin(2.0 * std::numbers::pi * s / 20.0) + 0.0002 * s - 0.004;
    samples.emplace_back(s, nominal().at(s).r + error);
  }
  return RadialFunction::spline_through(kLength, samples, 64);
}

std::vector<Vec2> profile(const RadialFunction& tool, int count, double noise, std::uint64_t seed, double from = 0.0,
                          double to = kLength) {
  Random random(seed);
  std::vector<Vec2> points;
  for (int k = 0; k < count; ++k) {
    const double s = from + (to - from) * (k + 0.5) / count;
    const RadialJet r = tool.at(s);
    const double q = std::sqrt(1.0 - r.d1 * r.d1), off = r.r + noise * random.normal();
    points.emplace_back(s - off * r.d1, off * q);
  }
  return points;
}

double largest_difference(const RadialFunction& a, const RadialFunction& b) {
  double most = 0.0;
  for (int k = 0; k <= 200; ++k) most = std::max(most, std::abs(a.at(kLength * k / 200).r - b.at(kLength * k / 200).r));
  return most;
}

TEST(GroundTool, OfExactPointsIsTheToolThatTheyAreOf) {
  const GroundTool ground = fit_ground(nominal(), profile(as_ground(), 400, 0.0, 1), "ground.csv");
  EXPECT_LT(largest_difference(ground.radial, as_ground()), 1e-4);
  EXPECT_GT(largest_difference(ground.radial, nominal()), 5e-3);
  EXPECT_NEAR(ground.largest_mm, largest_difference(as_ground(), nominal()), 2e-4);
}

TEST(GroundTool, OfNoisyPointsIsNearerThanTheNoise) {
  for (const int count : {100, 400, 3000}) {
    const GroundTool ground = fit_ground(nominal(), profile(as_ground(), count, 0.002, 2), "ground.csv");
    EXPECT_NEAR(ground.noise_mm, 0.002, 0.0006) << count;
    EXPECT_LT(largest_difference(ground.radial, as_ground()), 0.003) << count;
  }
}

TEST(GroundTool, LeavesOutPointsThatAreFarOffAndNamesThem) {
  std::vector<Vec2> points = profile(as_ground(), 400, 0.001, 3);
  points[50].y() += 0.08;
  points[222].y() -= 0.05;
  const GroundTool ground = fit_ground(nominal(), points, "ground.csv");
  EXPECT_EQ(ground.outliers, (std::vector<int>{50, 222}));
  EXPECT_LT(largest_difference(ground.radial, as_ground()), 0.002);
}

TEST(GroundTool, TakesBothHalvesOfAProfile) {
  std::vector<Vec2> points = profile(as_ground(), 400, 0.0, 1);
  for (std::size_t k = 0; k < points.size(); k += 2) points[k].y() *= -1.0;
  EXPECT_LT(largest_difference(fit_ground(nominal(), points, "ground.csv").radial, as_ground()), 1e-4);
}

std::string refusal(const std::vector<Vec2>& points) {
  try {
    (void)fit_ground(nominal(), points, "ground.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(GroundTool, RefusesWhatIsNoProfileOfTheTool) {
  EXPECT_NE(refusal(profile(as_ground(), 10, 0.0, 1)).find("at least 20 points"), std::string::npos);
  EXPECT_NE(refusal(profile(as_ground(), 400, 0.0, 1, 0.0, 15.0)).find("no point from"), std::string::npos);
  std::vector<Vec2> thicker = profile(as_ground(), 400, 0.0, 1);
  for (Vec2& point : thicker) point.y() += 3.0;
  EXPECT_NE(refusal(thicker).find("another tool"), std::string::npos);
}

}  // namespace
}  // namespace flank::internal
