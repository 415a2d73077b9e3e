// Lines through the solid against a dense walk along them that asks for the radius at every height.
#include "flank/verify/stock/tool_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace flank::internal::verify {
namespace {

constexpr double kChord = 1e-4;

/// Radius of the solid at a height, between its nodes; 0 beyond its ends.
double radius_at(const ToolSolid& tool, double z) {
  const std::vector<Vec2>& nodes = tool.nodes();
  if (z <= tool.low() || z >= tool.high()) return 0.0;
  std::size_t k = 1;
  while (k + 1 < nodes.size() && nodes[k].x() < z) ++k;
  return std::lerp(nodes[k - 1].y(), nodes[k].y(), (z - nodes[k - 1].x()) / (nodes[k].x() - nodes[k - 1].x()));
}

bool is_inside(const ToolSolid& tool, const ToolLine& line, double k) {
  const double radius = radius_at(tool, line.z0 + k * line.dz);
  return (line.a * k + 2.0 * line.b) * k + line.c < radius * radius;
}

/// Lines at all angles to the axis, those along it among them, that pass near to the tool.
std::vector<ToolLine> lines_beside(const ToolSolid& tool, int count) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> height(tool.low(), tool.high()),
      off(-1.1 * tool.largest(), 1.1 * tool.largest());
  std::vector<ToolLine> out;
  for (int k = 0; k < count; ++k) {
    Vec3 direction(normal(random), normal(random), normal(random));
    if (k % 3 == 0) direction = Vec3(0.02 * direction.x(), 0.02 * direction.y(), k % 2 == 0 ? 1.0 : -1.0);
    if (k % 17 == 0) direction = Vec3::UnitX();
    out.push_back(ToolSolid::line({Vec3::Zero(), Vec3::UnitZ()}, {off(random), off(random), height(random)},
                                  direction.normalized()));
  }
  return out;
}

void expect_cuts_as_walked(const ToolSolid& tool) {
  constexpr int kLines = 600, kSteps = 4000;
  double most_off = 0.0;
  int met = 0;
  for (const ToolLine& line : lines_beside(tool, kLines)) {
    LineCut within;
    if (!tool.reach(line, tool.largest(), within)) continue;
    const LineCuts cuts = tool.cut(line, within);
    const double step = (within.high - within.low) / kSteps;
    double walked = 0.0, cut = 0.0;
    for (int k = 0; k < kSteps; ++k) walked += is_inside(tool, line, within.low + (k + 0.5) * step) ? step : 0.0;
    for (int n = 0; n < cuts.count; ++n) {
      const LineCut& c = cuts.cuts[static_cast<std::size_t>(n)];
      cut += c.high - c.low;
      EXPECT_LT(c.low, c.high);
      EXPECT_TRUE(is_inside(tool, line, 0.5 * (c.low + c.high)));
      EXPECT_FALSE(is_inside(tool, line, c.low - 1e-7 * tool.high()) && c.low > within.low + 1e-6);
      EXPECT_FALSE(is_inside(tool, line, c.high + 1e-7 * tool.high()) && c.high < within.high - 1e-6);
    }
    met += cuts.count > 0 ? 1 : 0;
    most_off = std::max(most_off, std::abs(walked - cut) / (4.0 * step));
  }
  EXPECT_GT(met, 200);
  EXPECT_LT(most_off, 1.0) << "in steps of the walk, four of them";
}

TEST(ToolSolid, CutsLinesAsAWalkAlongThem) {
  expect_cuts_as_walked({{ToolFamily::kBarrel, 40.0, Eigen::Vector3d(60.0, 6.0, 18.0)}, kChord});
  expect_cuts_as_walked({{ToolFamily::kCone, 25.0, Eigen::Vector2d(2.0, 0.12)}, kChord});
}

/// A waist: lines beside it are in the tool twice.
TEST(ToolSolid, WhatPassesByIsNotReached) {
  const ToolSolid tool({ToolFamily::kCylinder, 12.0, Eigen::VectorXd::Constant(1, 3.0)}, kChord);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-8.0, 8.0);
  int passed = 0, missed = 0;
  for (const ToolLine& line : lines_beside(tool, 4000)) {
    const double low = place(random), high = low + std::abs(place(random));
    LineCut within;
    const bool meets = tool.reach(line, tool.largest(), within) && within.low < high && within.high > low;
    const bool passes = ToolSolid::passes_by(line, tool.largest() * tool.largest(), low, high);
    EXPECT_FALSE(meets && passes);
    // The cylinder has no ends there.
    const bool outside = line.a > 0.0 && (within.high <= low || within.low >= high);
    passed += passes ? 1 : 0;
    missed += outside && !passes ? 1 : 0;
  }
  EXPECT_GT(passed, 1000);
  EXPECT_LT(missed, passed);
}

/// Stretches that a quick look leaves out hold nothing of the tool; it leaves out most of those that do not.
void expect_misses_what_is_not_cut(const ToolSolid& tool) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1.5 * tool.largest(), 1.5 * tool.largest());
  int missed = 0, outside = 0;
  for (const ToolLine& line : lines_beside(tool, 6000)) {
    const double low = place(random), high = low + std::abs(place(random));
    LineCut within;
    double cut = 0.0;
    if (tool.reach(line, tool.largest(), within)) {
      const LineCuts cuts = tool.cut(line, within);
      for (int n = 0; n < cuts.count; ++n) {
        const LineCut& c = cuts.cuts[static_cast<std::size_t>(n)];
        cut = std::max(cut, std::min(c.high, high) - std::max(c.low, low));
      }
    }
    const bool misses = tool.misses(line, low, high);
    EXPECT_FALSE(misses && cut > 0.0) << cut;
    missed += misses ? 1 : 0;
    outside += cut > 0.0 ? 0 : 1;
  }
  EXPECT_GT(missed, 1000);
  EXPECT_GT(missed, 0.8 * outside);
}

TEST(ToolSolid, WhatItMissesIsNotCut) {
  expect_misses_what_is_not_cut({{ToolFamily::kBarrel, 40.0, Eigen::Vector3d(60.0, 6.0, 18.0)}, kChord});
  expect_misses_what_is_not_cut({{ToolFamily::kCone, 25.0, Eigen::Vector2d(2.0, 0.12)}, kChord});
  Eigen::VectorXd radii(6);
  radii << 6.0, 4.5, 3.0, 3.0, 4.5, 6.0;
  expect_misses_what_is_not_cut({RadialFunction::spline(40.0, radii), kChord});
}

TEST(ToolSolid, HoldsAPointAtOneOfManyPosesAsAtEachOfThem) {
  const ToolSolid tool({ToolFamily::kCone, 25.0, Eigen::Vector2d(2.0, 0.12)}, kChord);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-20.0, 20.0);
  std::normal_distribution<double> lean(0.0, 0.2);
  std::vector<Pose> poses;
  LatePoses lanes;
  for (int k = 0; k < 75; ++k) {
    poses.push_back(
        {{place(random), place(random), place(random)}, Vec3(lean(random), lean(random), 1.0).normalized()});
    lanes.add(poses.back());
  }
  int held = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 x(place(random), place(random), place(random));
    const bool one = std::any_of(poses.begin(), poses.end(), [&](const Pose& pose) { return tool.holds(pose, x); });
    EXPECT_EQ(tool.holds(lanes, x), one);
    held += one ? 1 : 0;
  }
  EXPECT_GT(held, 200);
  EXPECT_LT(held, 1800);
}

TEST(ToolSolid, CutsAWaistTwice) {
  Eigen::VectorXd radii(6);
  radii << 6.0, 4.5, 3.0, 3.0, 4.5, 6.0;
  const ToolSolid tool(RadialFunction::spline(40.0, radii), kChord);
  expect_cuts_as_walked(tool);
  const double beside = 0.5 * (radius_at(tool, 20.0) + std::min(radius_at(tool, 5.0), radius_at(tool, 35.0)));
  const ToolLine line = ToolSolid::line({Vec3::Zero(), Vec3::UnitZ()}, {beside, 0.0, 20.0}, Vec3::UnitZ());
  LineCut within;
  ASSERT_TRUE(tool.reach(line, tool.largest(), within));
  EXPECT_EQ(tool.cut(line, within).count, 2);
}

}  // namespace
}  // namespace flank::internal::verify
