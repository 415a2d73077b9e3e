// What a cutter feels at any feed against what it feels at that one, and feeds that keep limits to the last digit.
#include "flank/machine/cutting/feed_load.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

constexpr double kPi = std::numbers::pi, kDegree = kPi / 180.0;
constexpr ForceCoefficients kAll{.tangential = 800.0,
                                 .tangential_edge = 25.0,
                                 .normal = 170.0,
                                 .normal_edge = 30.0,
                                 .binormal = 90.0,
                                 .binormal_edge = 2.0};
constexpr double kRadius = 5.0, kHeight = 12.0;

/// A cone in rings, cut between two azimuths, of which 0 is where it goes.
RotatingCutter cutter(double entry, double exit, double helix) {
  RotatingCutter out{{}, 3, helix, 100.0};
  for (int k = 0; k < 6; ++k)
    out.rings.push_back(
        {{kHeight * k / 6, kRadius + 0.1 * k}, {kHeight * (k + 1) / 6, kRadius + 0.1 * (k + 1)}, entry, exit});
  return out;
}
const CutterMotion kPerMm{{1.0, 0.0, 0.0}, {-0.02, 0.01, 0.0}};
CutterMotion at_feed(double feed) { return {feed * kPerMm.velocity, feed * kPerMm.velocity_by_z}; }

std::vector<double> even(const RotatingCutter& of, double compliance) {
  return std::vector<double>(of.rings.size(), compliance);
}

TEST(FeedLoad, IsThatOfTheMotionAtThisFeed) {
  const RotatingCutter here = cutter(40.0 * kDegree, 95.0 * kDegree, 30.0 * kDegree);
  const FeedLoad load(here, kPerMm, kAll, even(here, 2e-5), 50);
  for (const double feed : {0.5, 8.0, 60.0}) {
    const CutterLoad found = load.at(feed);
    const PeakLoad wanted = peak_load(here, at_feed(feed), kAll, 50);
    EXPECT_NEAR(found.force_n, wanted.force_n, 1e-9 * wanted.force_n) << feed;
    EXPECT_NEAR(found.chip_mm, wanted.chip_mm, 1e-12) << feed;
    const double power = mean_power_w(here, mean_load(here, at_feed(feed), kAll));
    EXPECT_NEAR(found.power_w, power, 1e-9 * power) << feed;
    double across = 0.0;
    for (const double phase : peak_phases(here, at_feed(feed), 50))
      across = std::max(across, load_at(here, at_feed(feed), kAll, phase).force.head<2>().norm());
    EXPECT_NEAR(found.deflection_mm, 2e-5 * across, 1e-12) << feed;
  }
}

TEST(FeedLoad, TheFastestFeedReachesTheFirstLimitAndNoOther) {
  const RotatingCutter here = cutter(30.0 * kDegree, 90.0 * kDegree, 20.0 * kDegree);
  const FeedLoad load(here, kPerMm, kAll, even(here, 3e-5));
  const CutterLoad at = load.at(20.0);
  const auto feed_for = [&](const LoadLimits& limits, LoadKind by) {
    const FeedBound bound = load.fastest(limits, 1000.0);
    EXPECT_EQ(bound.by, by);
    return bound.feed;
  };
  EXPECT_NEAR(feed_for({.chip_mm = at.chip_mm}, LoadKind::kChip), 20.0, 1e-9);
  EXPECT_NEAR(feed_for({.force_n = at.force_n}, LoadKind::kForce), 20.0, 1e-7);
  EXPECT_NEAR(feed_for({.power_w = at.power_w}, LoadKind::kPower), 20.0, 1e-7);
  EXPECT_NEAR(feed_for({.deflection_mm = at.deflection_mm}, LoadKind::kDeflection), 20.0, 1e-7);
  const LoadLimits all{at.chip_mm, 0.9 * at.force_n, at.power_w, at.deflection_mm};
  EXPECT_LT(feed_for(all, LoadKind::kForce), 20.0);
  EXPECT_EQ(load.fastest({}, 33.0).feed, 33.0);
  EXPECT_EQ(load.fastest({}, 33.0).by, LoadKind::kNone);
}

TEST(FeedLoad, SaysWhereTheEdgesAloneAreTooMuch) {
  const RotatingCutter here = cutter(30.0 * kDegree, 90.0 * kDegree, 0.0);
  const FeedLoad load(here, kPerMm, kAll, even(here, 3e-5));
  EXPECT_EQ(load.fastest({.force_n = 0.5 * load.at(0.0).force_n}, 10.0).feed, 0.0);
  EXPECT_EQ(load.fastest({.force_n = 0.5 * load.at(0.0).force_n}, 10.0).by, LoadKind::kForce);
}

TEST(CuttingForce, TheThickestChipOfAnArcIsThatOfManyLooks) {
  for (const double entry : {-170.0, -60.0, 10.0, 120.0, 300.0})
    for (const double arc : {5.0, 60.0, 170.0}) {
      const RotatingCutter here = cutter(entry * kDegree, (entry + arc) * kDegree, 0.0);
      double looked = 0.0;
      for (int k = 0; k <= 5000; ++k)
        looked = std::max(looked, chip_thickness(here, at_feed(30.0), here.rings[2], kHeight * 2.5 / 6,
                                                 (entry + arc * k / 5000) * kDegree));
      EXPECT_NEAR(thickest_chip(here, at_feed(30.0), here.rings[2]), looked, 1e-8) << entry << " " << arc;
    }
}

TEST(CuttingForce, TwoArcsOfOneRingAreTheSumOfBoth) {
  const double helix = 30.0 * kDegree;
  RotatingCutter one = cutter(-80.0 * kDegree, -50.0 * kDegree, helix),
                 other = cutter(45.0 * kDegree, 85.0 * kDegree, helix), both;
  both = one;
  both.rings.clear();
  for (std::size_t k = 0; k < one.rings.size(); ++k)
    both.rings.push_back(one.rings[k]), both.rings.push_back(other.rings[k]);
  for (const double phase : {0.0, 0.4, 1.3, 1.9}) {
    const CuttingLoad sum = load_at(both, at_feed(9.0), kAll, phase), a = load_at(one, at_feed(9.0), kAll, phase),
                      b = load_at(other, at_feed(9.0), kAll, phase);
    EXPECT_NEAR((sum.force - a.force - b.force).norm(), 0.0, 1e-9) << phase;
    EXPECT_NEAR(sum.torque_nmm, a.torque_nmm + b.torque_nmm, 1e-9) << phase;
  }
}

}  // namespace
}  // namespace flank::internal
