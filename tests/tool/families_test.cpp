// The closed forms of the families: the profile that each one is named after, how families run into each other, and
// derivatives far from the middle of their range.
#include "flank/tool/families.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "flank/base/random.h"
#include "flank/tool.h"

namespace flank::internal {
namespace {

constexpr double kLength = 30.0;

RadialJet jet(ToolFamily family, const std::vector<double>& p, double s) {
  return row_of(family).jet(kLength, p.data(), s);
}

/// Random parameters that describe a tool or something close to one.
std::vector<double> random_parameters(ToolFamily family, Random& random) {
  const double radius = random.uniform(2.0, 8.0), arc = random.uniform(40.0, 400.0);
  switch (family) {
    case ToolFamily::kCylinder:
      return {radius};
    case ToolFamily::kCone:
      return {radius, random.uniform(-0.3, 0.3)};
    case ToolFamily::kBarrel:
      return {random.uniform() < 0.5 ? arc : -arc, radius, random.uniform(-10.0, 40.0)};
    case ToolFamily::kLens:
      return {radius, radius + random.uniform(-2.0, 2.0)};
    case ToolFamily::kTaperedBarrel:
      return {random.uniform() < 0.5 ? arc : -arc, radius, random.uniform(-0.4, 0.4)};
    case ToolFamily::kHyperbolic:
      return {radius, random.uniform(-0.2, 0.2), random.uniform(-0.01, 0.01)};
    case ToolFamily::kPower:
      return {random.uniform(5.0, 9.0), random.uniform(-0.1, 1.0), random.uniform(0.5, 2.0), random.uniform(0.7, 3.0)};
    case ToolFamily::kSpline:
      break;
  }
  return {};
}

constexpr std::array<ToolFamily, 7> kClosedForms = {
    ToolFamily::kCylinder,      ToolFamily::kCone,       ToolFamily::kBarrel, ToolFamily::kLens,
    ToolFamily::kTaperedBarrel, ToolFamily::kHyperbolic, ToolFamily::kPower};

TEST(Families, DerivativesMatchFiniteDifferencesForRandomParameters) {
  Random random(11);
  for (const ToolFamily family : kClosedForms)
    for (int k = 0; k < 40; ++k) {
      const std::vector<double> p = random_parameters(family, random);
      const double s = random.uniform(0.0, kLength), h = 1e-4;
      const RadialJet a = jet(family, p, s - h), b = jet(family, p, s), c = jet(family, p, s + h);
      EXPECT_NEAR(b.d1, (c.r - a.r) / (2.0 * h), 1e-9) << family_name(family) << " s = " << s;
      EXPECT_NEAR(b.d2, (c.d1 - a.d1) / (2.0 * h), 1e-9) << family_name(family) << " s = " << s;
    }
}

TEST(Families, GradientsMatchFiniteDifferencesForRandomParameters) {
  Random random(12);
  for (const ToolFamily family : kClosedForms)
    for (int k = 0; k < 40; ++k) {
      const std::vector<double> p = random_parameters(family, random);
      const double s = random.uniform(0.0, kLength);
      std::array<double, 4> gradient{};
      row_of(family).gradient(kLength, p.data(), s, gradient.data());
      for (std::size_t i = 0; i < p.size(); ++i) {
        const double h = 1e-5 * std::max(1.0, std::abs(p[i]));
        std::vector<double> up = p, down = p;
        up[i] += h;
        down[i] -= h;
        const double difference = (jet(family, up, s).r - jet(family, down, s).r) / (2.0 * h);
        EXPECT_NEAR(gradient[i], difference, 1e-7 * (1.0 + std::abs(difference))) << family_name(family) << " " << i;
      }
    }
}

/// The same sphere radii seen from the holder: s -> L - s turns r' round and keeps r and r''.
TEST(Families, TurningTheAxisRoundTurnsTheSlopeRound) {
  const auto expect_mirrored = [](ToolFamily family, const std::vector<double>& p,
                                  const std::vector<double>& mirrored) {
    for (double s = 0.0; s <= kLength; s += 1.7) {
      const RadialJet a = jet(family, p, s), b = jet(family, mirrored, kLength - s);
      EXPECT_NEAR(a.r, b.r, 1e-12) << family_name(family);
      EXPECT_NEAR(a.d1, -b.d1, 1e-13) << family_name(family);
      EXPECT_NEAR(a.d2, b.d2, 1e-13) << family_name(family);
    }
  };
  const double slope = std::sin(0.1);
  expect_mirrored(ToolFamily::kCone, {4.0, 0.1}, {4.0 + slope * kLength, -0.1});
  expect_mirrored(ToolFamily::kBarrel, {85.0, 5.0, 8.0}, {85.0, 5.0, kLength - 8.0});
  expect_mirrored(ToolFamily::kLens, {5.0, 4.0}, {5.0, 4.0});
  expect_mirrored(ToolFamily::kTaperedBarrel, {250.0, 5.0, 0.2}, {250.0, 5.0, -0.2});
  expect_mirrored(ToolFamily::kHyperbolic, {3.0, 0.05, 0.004}, {3.0, -0.05, 0.004});
  expect_mirrored(ToolFamily::kPower, {8.0, 0.5, 1.2, 2.3}, {8.0 + 0.5 * kLength, -0.5, 1.2, 2.3});
}

TEST(Families, ScalingEveryLengthScalesTheRadius) {
  constexpr double scale = 2.5;
  const auto expect_scaled = [](ToolFamily family, std::vector<double> p, const std::vector<double>& powers) {
    std::vector<double> big = p;
    for (std::size_t i = 0; i < p.size(); ++i) big[i] *= std::pow(scale, powers[i]);
    for (double s = 0.0; s <= kLength; s += 2.3) {
      const RadialJet a = row_of(family).jet(kLength, p.data(), s);
      const RadialJet b = row_of(family).jet(scale * kLength, big.data(), scale * s);
      EXPECT_NEAR(b.r, scale * a.r, 1e-11) << family_name(family);
      EXPECT_NEAR(b.d1, a.d1, 1e-13) << family_name(family);
      EXPECT_NEAR(b.d2, a.d2 / scale, 1e-13) << family_name(family);
    }
  };
  expect_scaled(ToolFamily::kCylinder, {4.0}, {1});
  expect_scaled(ToolFamily::kCone, {4.0, 0.1}, {1, 0});
  expect_scaled(ToolFamily::kBarrel, {85.0, 5.0, 8.0}, {1, 1, 1});
  expect_scaled(ToolFamily::kLens, {5.0, 4.0}, {1, 1});
  expect_scaled(ToolFamily::kTaperedBarrel, {-250.0, 5.0, 0.2}, {1, 1, 0});
  expect_scaled(ToolFamily::kHyperbolic, {3.0, 0.05, 0.004}, {1, 0, -1});
}

TEST(Families, AVeryLargeArcIsACone) {
  for (const double arc : {1e9, -1e9})
    for (double s = 0.0; s <= kLength; s += 3.0) {
      const RadialJet barrel = jet(ToolFamily::kTaperedBarrel, {arc, 5.0, 0.2}, s);
      EXPECT_NEAR(barrel.r, 5.0 + std::sin(0.2) * (s - 0.5 * kLength), 1e-6);
      EXPECT_NEAR(barrel.d1, std::sin(0.2), 1e-7);
      const RadialJet straight = jet(ToolFamily::kBarrel, {arc, 5.0, 8.0}, s);
      EXPECT_NEAR(straight.r, 5.0, 1e-6);
      EXPECT_NEAR(straight.d2, 0.0, 1e-8);
    }
}

/// A lens is the barrel through the same three points; a tapered barrel without taper is a barrel at mid-length.
TEST(Families, LensAndTaperedBarrelAreBarrelsInOtherParameters) {
  const double half = 0.5 * kLength, radius = 5.0, end = 3.5, drop = radius - end;
  const double arc = radius + (half * half - drop * drop) / (2.0 * drop);
  for (double s = 0.0; s <= kLength; s += 1.3) {
    const RadialJet barrel = jet(ToolFamily::kBarrel, {arc, radius, half}, s);
    for (const RadialJet& other :
         {jet(ToolFamily::kLens, {radius, end}, s), jet(ToolFamily::kTaperedBarrel, {arc, radius, 0.0}, s)}) {
      EXPECT_NEAR(other.r, barrel.r, 1e-12);
      EXPECT_NEAR(other.d1, barrel.d1, 1e-13);
      EXPECT_NEAR(other.d2, barrel.d2, 1e-13);
    }
  }
}

TEST(Families, ALensWithoutDropIsACylinderWithAGradient) {
  std::array<double, 2> gradient{};
  const std::array<double, 2> p{4.0, 4.0};
  for (double s = 0.0; s <= kLength; s += 5.0) {
    const RadialJet flat = row_of(ToolFamily::kLens).jet(kLength, p.data(), s);
    EXPECT_EQ(flat.r, 4.0);
    EXPECT_EQ(flat.d1, 0.0);
    row_of(ToolFamily::kLens).gradient(kLength, p.data(), s, gradient.data());
    // To first order the arc is the parabola between the two radii: shares (1 - q) and q with q = (x / half)^2.
    const double q = std::pow((s - 0.5 * kLength) / (0.5 * kLength), 2);
    EXPECT_NEAR(gradient[0], 1.0 - q, 1e-13);
    EXPECT_NEAR(gradient[1], q, 1e-13);
  }
}

TEST(Families, PowerOfOneIsACone) {
  for (double s = 0.0; s <= kLength; s += 2.0) {
    const RadialJet f = jet(ToolFamily::kPower, {8.0, 0.4, 2.0, 1.0}, s);
    EXPECT_NEAR(f.r, (8.0 + 0.4 * s) / 2.0, 1e-14);
    EXPECT_NEAR(f.d1, 0.2, 1e-15);
    EXPECT_EQ(f.d2, 0.0);
  }
}

TEST(Families, TurningPointIsWhereTheSlopeChangesItsSign) {
  Random random(13);
  int turns = 0;
  for (const ToolFamily family : kClosedForms)
    for (int k = 0; k < 30; ++k) {
      const std::vector<double> p = random_parameters(family, random);
      const auto turning_point = row_of(family).turning_point;
      const double turn = turning_point != nullptr ? turning_point(kLength, p.data()) : std::nan("");
      if (std::isnan(turn)) {
        const double first = jet(family, p, 0.0).d1;
        for (double s = 0.0; s <= kLength; s += 1.0)
          EXPECT_GE(jet(family, p, s).d1 * first, 0.0) << family_name(family);
        continue;
      }
      ++turns;
      EXPECT_NEAR(jet(family, p, turn).d1, 0.0, 1e-13) << family_name(family);
      EXPECT_LT(jet(family, p, turn - 1.0).d1 * jet(family, p, turn + 1.0).d1, 0.0) << family_name(family);
    }
  EXPECT_EQ(turns, 4 * 30) << "barrel, lens, tapered barrel and hyperbolic turn";
}

}  // namespace
}  // namespace flank::internal
