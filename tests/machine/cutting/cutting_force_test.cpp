// Forces against closed forms: slot and half immersion, helix 0 and 30 degrees, ball and cone; power against helix; materials.
#include "flank/machine/cutting/cutting_force.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/error.h"
#include "flank/machine/cutting/materials.h"

namespace flank::internal {
namespace {

constexpr double kPi = std::numbers::pi, kRight = kPi / 2.0;
constexpr ForceCoefficients kAll{.tangential = 800.0,
                                 .tangential_edge = 25.0,
                                 .normal = 170.0,
                                 .normal_edge = 30.0,
                                 .binormal = 90.0,
                                 .binormal_edge = 2.0};
constexpr double kRadius = 5.0, kDepth = 4.0, kChip = 0.05, kTurns = 100.0;

/// A cylinder in `rings` rings, cut between two azimuths of which 0 is the direction of the feed.
RotatingCutter cylinder(double entry, double exit, int teeth, double helix, int rings = 1) {
  RotatingCutter cutter{{}, teeth, helix, kTurns};
  for (int k = 0; k < rings; ++k)
    cutter.rings.push_back({{kDepth * k / rings, kRadius}, {kDepth * (k + 1) / rings, kRadius}, entry, exit});
  return cutter;
}
CutterMotion along_x(const RotatingCutter& cutter) {
  return {{kChip * cutter.teeth * cutter.turns_per_second, 0, 0}, Vec3::Zero()};
}

void expect_near(const Vec3& found, const Vec3& wanted, double share) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], wanted[k], share * wanted.norm()) << k;
}

TEST(CuttingForce, MeanOfASlotAndOfHalfImmersionForAnyHelix) {
  for (const double helix : {0.0, 30.0 * kPi / 180.0})
    for (const int rings : {1, 7}) {
      const int teeth = 3;
      const double share = teeth * kDepth / (2.0 * kPi);
      const RotatingCutter slot = cylinder(-kRight, kRight, teeth, helix, rings);
      const CuttingLoad mean = mean_load(slot, along_x(slot), kAll);
      const double t = kAll.tangential * kChip, n = kAll.normal * kChip, b = kAll.binormal * kChip;
      expect_near(mean.force,
                  share * Vec3(-n * kRight - 2.0 * kAll.normal_edge, -t * kRight - 2.0 * kAll.tangential_edge,
                               2.0 * b + kPi * kAll.binormal_edge),
                  1e-6);
      EXPECT_NEAR(mean_power_w(slot, mean),
                  1e-3 * share * (2.0 * t + kPi * kAll.tangential_edge) * 2.0 * kPi * kRadius * kTurns, 1e-3);
      const RotatingCutter half = cylinder(0.0, kRight, teeth, helix, rings);
      const Vec3 of_half(t / 2.0 + kAll.tangential_edge - n * kPi / 4.0 - kAll.normal_edge,
                         -t * kPi / 4.0 - kAll.tangential_edge - n / 2.0 - kAll.normal_edge,
                         b + kRight * kAll.binormal_edge);
      expect_near(mean_load(half, along_x(half), kAll).force, share * of_half, 1e-6);
    }
}

TEST(CuttingForce, OfOneStraightEdgeAtOneInstant) {
  const RotatingCutter slot = cylinder(-kRight, kRight, 1, 0.0);
  for (const double azimuth : {-1.2, 0.0, 0.7}) {
    const double h = kChip * std::cos(azimuth), t = kDepth * (kAll.tangential * h + kAll.tangential_edge),
                 n = kDepth * (kAll.normal * h + kAll.normal_edge);
    const CuttingLoad load = load_at(slot, along_x(slot), kAll, azimuth);
    expect_near(load.force,
                {t * std::sin(azimuth) - n * std::cos(azimuth), -t * std::cos(azimuth) - n * std::sin(azimuth),
                 kDepth * (kAll.binormal * h + kAll.binormal_edge)},
                1e-9);
    EXPECT_NEAR(load.torque_nmm, t * kRadius, 1e-6);
  }
  EXPECT_EQ(load_at(slot, along_x(slot), kAll, 2.0).force.norm(), 0.0);  // behind the cutter nothing is engaged
}

/// The helical edge from azimuth a down to b: integrals of sines and cosines in closed form.
TEST(CuttingForce, OfOneHelicalEdgeAtOneInstant) {
  const double helix = 30.0 * kPi / 180.0, lag = std::tan(helix) / kRadius;
  for (const int rings : {1, 5}) {
    const RotatingCutter slot = cylinder(-kRight, kRight, 1, helix, rings);
    for (const double phase : {-1.3, -0.4, 0.5, 1.2, 1.9}) {
      // Engaged from the tip back, but for what is before entry or behind exit.
      const double high = std::min(phase, kRight), low = std::max(phase - lag * kDepth, -kRight);
      const auto primitive = [&](double x) -> Vec3 {
        const double c = kChip, cc = x / 2.0 + std::sin(2.0 * x) / 4.0, sc = std::sin(x) * std::sin(x) / 2.0;
        return {kAll.tangential * c * sc - kAll.tangential_edge * std::cos(x) - kAll.normal * c * cc -
                    kAll.normal_edge * std::sin(x),
                -kAll.tangential * c * cc - kAll.tangential_edge * std::sin(x) - kAll.normal * c * sc +
                    kAll.normal_edge * std::cos(x),
                kAll.binormal * c * std::sin(x) + kAll.binormal_edge * x};
      };
      expect_near(load_at(slot, along_x(slot), kAll, phase).force, (primitive(high) - primitive(low)) / lag, 1e-6);
    }
  }
}

TEST(CuttingForce, MeanOverTheInstantsIsTheMeanForAnyHelix) {
  double first = 0.0;
  for (const double helix : {0.0, 15.0 * kPi / 180.0, 30.0 * kPi / 180.0, 45.0 * kPi / 180.0}) {
    const RotatingCutter half = cylinder(0.0, kRight, 2, helix, 3);
    double torque = 0.0;
    constexpr int kPhases = 2000;
    for (int k = 0; k < kPhases; ++k)
      torque += load_at(half, along_x(half), kAll, kPi * (k + 0.5) / kPhases).torque_nmm / kPhases;
    if (helix == 0.0) first = torque;
    EXPECT_NEAR(torque, first, 1e-3 * first);
    EXPECT_NEAR(torque, mean_load(half, along_x(half), kAll).torque_nmm, 1e-3 * first);
  }
}

/// Without edge forces the power is what is cut in a second times the coefficient: for any meridian.
TEST(CuttingForce, PowerOfABallAndOfAConeIsThatOfTheirVolume) {
  const ForceCoefficients shear{.tangential = 800.0};
  RotatingCutter ball{{}, 2, 30.0 * kPi / 180.0, kTurns}, cone{{}, 4, 0.0, kTurns};
  constexpr int kRings = 400;
  const auto on_ball = [](int k) {
    const double a = kRight * k / kRings;
    return Vec2(kRadius * (1.0 - std::cos(a)), kRadius * std::sin(a));
  };
  for (int k = 0; k < kRings; ++k) ball.rings.push_back({on_ball(k), on_ball(k + 1), -kRight, kRight});
  cone.rings.push_back({{0.0, 2.0}, {10.0, 4.0}, -kRight, kRight});
  const double ball_area = kPi * kRadius * kRadius / 2.0, cone_area = 10.0 * 6.0;
  for (const auto& [cutter, area] : {std::pair(ball, ball_area), std::pair(cone, cone_area)}) {
    const double volume = area * kChip * cutter.teeth * cutter.turns_per_second;  // mm^3/s
    const double power = mean_power_w(cutter, mean_load(cutter, along_x(cutter), shear));
    EXPECT_NEAR(power, 1e-3 * shear.tangential * volume, 1e-3 * power);
  }
}

TEST(CuttingForce, ATurningAxisCutsByWhatItMovesAtEachHeight) {
  RotatingCutter slot = cylinder(-kRight, kRight, 2, 0.0, 2);
  CutterMotion tilt{Vec3::Zero(), Vec3(2.0, 0.0, 0.0)};  // about z = 0
  EXPECT_NEAR(chip_thickness(slot, tilt, slot.rings[1], 3.0, 0.0), 6.0 / (2 * kTurns), 1e-12);
  EXPECT_EQ(chip_thickness(slot, tilt, slot.rings[1], 3.0, kPi), 0.0);
  // The mean of z over the depth is half of it: that of the whole is that of the middle.
  const CuttingLoad turning = mean_load(slot, tilt, {.tangential = 800.0});
  const CuttingLoad even = mean_load(slot, {Vec3(kDepth, 0.0, 0.0), Vec3::Zero()}, {.tangential = 800.0});
  EXPECT_NEAR(turning.torque_nmm, even.torque_nmm, 1e-9);
  const PeakLoad peak = peak_load(slot, along_x(slot), kAll);
  EXPECT_NEAR(peak.chip_mm, kChip, 1e-12);
  EXPECT_GE(peak.force_n, load_at(slot, along_x(slot), kAll, 0.0).force.norm());
  slot.rings.clear();
  EXPECT_EQ(peak_load(slot, along_x(slot), kAll).force_n, 0.0);
}

TEST(Materials, TheFileThatComesWithTheProgram) {
  const std::vector<Material> all = read_materials();
  ASSERT_GE(all.size(), 5u);
  for (const Material& m : all) EXPECT_GT(m.source.size(), 20u) << m.name;
  const Material titanium = find_material("titanium");
  const CuttingData data = cutting_data(titanium, 10.0, 4, 0.0);
  EXPECT_NEAR(data.spindle_rpm, 75000.0 / (10.0 * kPi), 1e-9);
  EXPECT_NEAR(data.feed_mm_min, 0.02 * 4 * data.spindle_rpm, 1e-9);
  const CuttingData slow = cutting_data(titanium, 10.0, 4, 1000.0);
  EXPECT_TRUE(slow.limited);
  EXPECT_NEAR(slow.feed_mm_min, 80.0, 1e-9);
  EXPECT_THROW((void)find_material("cheese"), UsageError);
}

TEST(Materials, CoefficientsAreTheTangentOfThePowerLaw) {
  const Material m = find_material("steel-c45");
  const ForceCoefficients k = force_coefficients(m, 0.05);
  const auto law = [&](double h) { return m.kc1 * std::pow(h, 1.0 - m.mc); };
  EXPECT_NEAR(k.tangential * 0.05 + k.tangential_edge, law(0.05), 1e-9);
  EXPECT_NEAR(k.tangential, (law(0.05 + 1e-6) - law(0.05 - 1e-6)) / 2e-6, 1e-3);
}

TEST(Materials, BadRowsAreRefused) {
  const std::string head =
      "schema = \"openflank/materials/1\"\n[[material]]\nname = \"x\"\ndescription = \"d\"\ngroup = 1\n";
  const std::string good =
      "speed_m_min = [1, 2]\nchip_per_diameter = [0.001, 0.002]\nkc1_n_mm2 = 500\nmc = 0.2\nsource = \"s\"\n";
  EXPECT_EQ(materials_from_toml(head + good, "m.toml").size(), 1u);
  for (const char* bad :
       {"speed_m_min = [2, 1]\nchip_per_diameter = [0.001, 0.002]\nkc1_n_mm2 = 500\nmc = 0.2\nsource = \"s\"\n",
        "speed_m_min = [1, 2]\nchip_per_diameter = [0.001, 0.002]\nkc1_n_mm2 = 500\nmc = 0.2\n",
        "speed_m_min = [1, 2]\nchip_per_diameter = [0.001, 0.002]\nkc1_n_mm2 = -5\nmc = 0.2\nsource = \"s\"\n"})
    EXPECT_THROW((void)materials_from_toml(head + bad, "m.toml"), InputError) << bad;
  EXPECT_THROW((void)materials_from_toml("schema = \"openflank/materials/1\"\n", "m.toml"), InputError);
}

}  // namespace
}  // namespace flank::internal
