// The load along a path: a cylinder beside a plane wall, for which all of it is known in closed form.
#include "flank/pipeline/load/path_loads.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/tool/compliance.h"

namespace flank::internal {
namespace {

constexpr double kPi = std::numbers::pi, kRadius = 5.0, kLength = 20.0, kChip = 0.04, kDepth = 0.3;

Tool end_mill() {
  return {{ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius)}, "end mill", {}, {}};
}

/// Along x, leaning, with the wall on the left. Half of the poses take less of it.
struct Scene {
  Path path;
  PathArcs arcs;
};
Scene beside_a_wall() {
  Scene scene;
  Strip strip;
  for (int k = 0; k <= 40; ++k) strip.poses.push_back({Vec3(0.5 * k, 0.0, 0.0), Vec3(0.0, 0.6, 0.8)});
  scene.path.strips.push_back(strip);
  for (int ring = 0; ring < 9; ++ring) scene.arcs.heights.push_back(kLength * ring / 8.0);
  std::vector<std::vector<EngagedArc>> poses;
  for (int k = 0; k <= 40; ++k) {
    const double angle = std::acos(1.0 - (k < 20 ? kDepth : 0.1) / kRadius);
    std::vector<EngagedArc>& arcs = poses.emplace_back();
    for (int ring = 0; ring < 9; ++ring) arcs.push_back({ring, 0.5 * kPi - angle, 0.5 * kPi});
  }
  scene.arcs.strips.push_back(poses);
  return scene;
}

CuttingRequest request() {
  CuttingRequest out{.material = find_material("aluminium"), .flutes = 1, .helix_rad = 0.0, .spindle_rpm = 12000.0};
  out.expected_chip_mm = kChip;
  out.limits.chip_mm = kChip;
  out.feed = kChip * 200.0, out.most_feed = 1e4;
  return out;
}

double thickest(double depth) { return std::sin(std::acos(1.0 - depth / kRadius)); }

TEST(PathLoads, TheChipIsWhatIsAskedForAtEveryPose) {
  const Scene scene = beside_a_wall();
  const PathLoads loads = path_loads(end_mill(), scene.path, scene.arcs, request());
  EXPECT_EQ(loads.engaged, 41u);
  for (std::size_t k = 1; k < 40; ++k)
    EXPECT_NEAR(1.0 / loads.slowness[0][k], kChip * 200.0 / thickest(k < 20 ? kDepth : 0.1), 1e-6) << k;
  EXPECT_NEAR(loads.chip_mm.peak, kChip, 1e-12);
  EXPECT_NEAR(loads.chip_mm.p95, kChip, 1e-12);
  EXPECT_EQ(loads.slowest.by, LoadKind::kChip);
  EXPECT_LT(loads.share_of_constant, 0.9);
}

TEST(PathLoads, ForceAndDeflectionOfAStraightEdgeAreTheClosedForm) {
  const Scene scene = beside_a_wall();
  CuttingRequest asked = request();
  const PathLoads loads = path_loads(end_mill(), scene.path, scene.arcs, asked);
  // The edge meets the whole length at once, where its chip is thickest.
  const ForceCoefficients k = force_coefficients(asked.material, kChip);
  const double t = k.tangential * kChip + k.tangential_edge, n = k.normal * kChip + k.normal_edge;
  EXPECT_NEAR(loads.force_n.peak, kLength * std::hypot(t, n), 0.05 * loads.force_n.peak);
  EXPECT_LE(loads.force_n.peak, kLength * std::hypot(t, n) * (1.0 + 1e-9));
  // Under an even load the tip moves by w L^4 / (8 E I).
  const double inertia = kPi * std::pow(kRadius, 4) / 4.0,
               even = std::pow(kLength, 4) / (8.0 * kCarbideModulus * inertia) / kLength;
  EXPECT_NEAR(loads.deflection_mm.peak, loads.force_n.peak * even, 0.01 * loads.deflection_mm.peak);
  asked.limits.force_n = 0.7 * loads.force_n.peak;
  const PathLoads bounded = path_loads(end_mill(), scene.path, scene.arcs, asked);
  EXPECT_NEAR(bounded.force_n.peak, asked.limits.force_n, 1e-6);
  EXPECT_EQ(bounded.slowest.by, LoadKind::kForce);
  EXPECT_LT(bounded.slowest_at.pose, 20u);
}

TEST(PathLoads, APlaceThatMustBeSlowedIsNamed) {
  const Scene scene = beside_a_wall();
  CuttingRequest asked = request();
  const std::vector<std::string> notes =
      load_notes(path_loads(end_mill(), scene.path, scene.arcs, asked), scene.path, asked);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_NE(notes[1].find("pass 1, CL point 1: "), std::string::npos) << notes[1];
  EXPECT_NE(notes[1].find("limited by the chip"), std::string::npos) << notes[1];
  asked.limits.deflection_mm = 1e-9;
  const std::vector<std::string> crawling =
      load_notes(path_loads(end_mill(), scene.path, scene.arcs, asked), scene.path, asked);
  EXPECT_NE(crawling[1].find("the deflection exceeds its limit at any feed"), std::string::npos) << crawling[1];
}

}  // namespace
}  // namespace flank::internal
