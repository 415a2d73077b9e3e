// What a bending tool leaves: a cylinder on a straight wall against the formula of the beam.
#include "flank/pipeline/load/bending.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

constexpr double kPi = std::numbers::pi, kRadius = 4.0, kLength = 30.0, kChip = 0.03;

/// Along x, the wall on the right at y = -4, from z = 0 up to a height: climb milling, which ends at the wall.
struct Wall {
  Tool tool{{ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius)}, "end mill", {}, {}};
  std::vector<double> heights;
  std::vector<EngagedArc> arcs;
  std::vector<Pose> poses;
  CuttingRequest cutting;

  Wall(int rings, int engaged, double helix) {
    for (int k = 0; k < rings; ++k) heights.push_back(kLength * k / (rings - 1));
    for (int k = 0; k < engaged; ++k) arcs.push_back({k, -0.5 * kPi, 0.3 - 0.5 * kPi});
    for (int k = 0; k < 5; ++k) poses.push_back({Vec3(k, 0, 0), Vec3::UnitZ()});
    cutting = usual_cutting(find_material("titanium"), 1, helix, 2.0 * kRadius);
    cutting.expected_chip_mm = kChip;
  }
  [[nodiscard]] double bent(double z) const {
    return bent_along(tool, cutting, heights, arcs, poses, {2.0, z, Vec3::UnitY()}, 10.0);
  }
  [[nodiscard]] ForceCoefficients coefficients() const { return force_coefficients(cutting.material, kChip); }
  [[nodiscard]] double stiffness() const { return kCarbideModulus * kPi * std::pow(kRadius, 4) / 4.0; }
};

/// Of a cantilever, x from its clamped end, under a load of w N/mm from there to a: as in the tables of beams.
double even_load(double w, double x, double length, double ei) {
  return w * x * x / (24.0 * ei) * (6.0 * length * length - 4.0 * length * x + x * x);
}

// A straight edge makes the whole wall at one instant, at which its chip has become nothing: what is left is the edge's own force, even along it.
TEST(Bending, AStraightEdgeOnAStraightWallIsTheBeamUnderAnEvenLoad) {
  const Wall wall(61, 61, 0.0);
  for (const double z : {0.0, 5.0, 12.5, 20.0, 28.0}) {
    const double closed = even_load(wall.coefficients().normal_edge, kLength - z, kLength, wall.stiffness());
    EXPECT_NEAR(wall.bent(z), closed, 0.01 * closed) << z;
  }
}

// A wall of a part of the height: the load from the tip to h, by the difference of two even loads from the tip and from h on.
TEST(Bending, ALowWallLoadsTheEndOfTheBeam) {
  const Wall wall(61, 21, 0.0);  // heights up to 10 mm; its ring ends at 10.25
  const double h = 10.25, w = wall.coefficients().normal_edge, ei = wall.stiffness();
  for (const double z : {0.0, 4.0, 9.0}) {
    // By the beam's equation: the integral of the bending moments of the load and of one newton at z.
    double closed = 0.0;
    constexpr int kSteps = 20000;
    for (int k = 0; k < kSteps; ++k) {
      const double s = z + (kLength - z) * (k + 0.5) / kSteps, loaded = std::min(s, h);
      const double moment = w * loaded * (s - 0.5 * loaded);
      closed += moment * (s - z) * (kLength - z) / kSteps / ei;
    }
    EXPECT_NEAR(wall.bent(z), closed, 0.01 * closed) << z;
  }
}

// With a helix the edge higher up still cuts while its lower end makes the wall: it pushes the tool off.
TEST(Bending, AHelixLeavesMoreWhereTheEdgeAboveStillCuts) {
  const Wall straight(61, 61, 0.0), helical(61, 61, 30.0 * kPi / 180.0);
  EXPECT_GT(straight.bent(2.0), 0.0);
  EXPECT_NE(helical.bent(2.0), straight.bent(2.0));
  EXPECT_GT(helical.bent(2.0), helical.bent(25.0));
}

TEST(Bending, IsNoneWhereNothingIsEngaged) {
  const Wall wall(61, 21, 0.0);
  EXPECT_EQ(wall.bent(20.0), 0.0);
}

}  // namespace
}  // namespace flank::internal
