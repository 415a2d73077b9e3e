// Interpolated distances against exact ones: between two blades of a wheel over its hub, where several faces, their edges
// and the middle between them meet; and the interpolation itself against functions that it must reproduce.
#include "flank/obstacle/distance_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "flank/base/random.h"
#include "flank/obstacle_field.h"
#include "flank/part.h"
#include "rotor37_file.h"

namespace flank::internal {
namespace {

/// One "face" whose distance is a quadratic function: third-order interpolation reproduces it.
class Quadratic final : public ExactDistances {
 public:
  [[nodiscard]] static FaceDistance value(const Vec3& p) {
    return {2.0 + p.x() - 0.1 * p.x() * p.y() + 0.2 * p.z() * p.z() - 0.05 * p.y() * p.y(),
            {1.0 - 0.1 * p.y(), -0.1 * p.x() - 0.1 * p.y(), 0.4 * p.z()}};
  }
  [[nodiscard]] FaceDistance of(std::size_t, const Vec3& place, double) const override {
    ++asked;
    return value(place);
  }
  [[nodiscard]] std::span<const std::size_t> near(std::ptrdiff_t) const override { return faces; }
  std::vector<std::size_t> faces{0};
  mutable int asked = 0;
};

TEST(DistanceCells, ReproduceQuadraticFunctionsAndTheirGradients) {
  const Quadratic exact;
  DistanceCells cells(1, Vec3::Zero(), 4.0, 1e-3);
  Random random(5);
  for (int k = 0; k < 200; ++k) {
    const Vec3 p(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0));
    const CellDistance found = cells.at(p, {0, {0, 0, 0}, 2.0}, exact);
    ASSERT_EQ(found.face, 0);
    EXPECT_NEAR(found.distance.mm, Quadratic::value(p).mm, 1e-12);
    EXPECT_LT((found.distance.gradient - Quadratic::value(p).gradient).norm(), 1e-12);
  }
}

TEST(DistanceCells, WhatIsKnownIsNotAskedAgain) {
  const Quadratic exact;
  DistanceCells cells(1, Vec3::Zero(), 4.0, 1e-3);
  const DistanceCells::Node node{0, {0, 0, 0}, 2.0};
  (void)cells.at(Vec3(0.1, 0.2, 0.3), node, exact);
  const int once = exact.asked;
  (void)cells.at(Vec3(0.1, 0.2, 0.3), node, exact);
  EXPECT_EQ(exact.asked, once);
}

TEST(DistanceCells, WithoutAnAllowanceNothingIsInterpolated) {
  const Quadratic exact;
  DistanceCells cells(1, Vec3::Zero(), 4.0, 0.0);
  EXPECT_EQ(cells.at(Vec3::Zero(), {0, {0, 0, 0}, 2.0}, exact).face, -1);
}

/// The pressure side of one blade of the sector, and everything else as obstacles.
struct Channel {
  std::unique_ptr<Target> target;
  std::unique_ptr<ObstacleField> field;
};

Channel channel(double allowance_mm) {
  const Part part = read_part(test::rotor37_file("rotor37-blisk"));
  Channel scene;
  Obstacles obstacles;
  for (const Face& face : part.faces) {
    if (face.id == "F9")
      scene.target = make_target({face});
    else
      obstacles.faces.push_back({std::shared_ptr<Target>(make_target({face})), true});
  }
  scene.field = std::make_unique<ObstacleField>(obstacles, *scene.target, 1.0, allowance_mm);
  return scene;
}

/// Balls' centres as a fit asks for them: some millimetres above the target.
std::vector<Vec3> centres(const Target& target, int count) {
  Random random(11);
  const std::vector<SurfaceSample> samples = target.samples(std::sqrt(target.area() / count));
  std::vector<Vec3> points;
  for (const SurfaceSample& sample : samples) points.push_back(sample.point + random.uniform(3.0, 9.0) * sample.normal);
  return points;
}

constexpr double kHorizonMm = 12.0;

TEST(DistanceCells, BetweenBladesAreWithinATenthOfTheAllowance) {
  constexpr double kAllowanceMm = 0.08;
  const Channel scene = channel(kAllowanceMm);
  std::size_t asked = 0, off = 0;
  double worst = 0.0;
  for (const Vec3& p : centres(*scene.target, 3000)) {
    const ObstacleDistance known = scene.field->at(p, kHorizonMm), found = scene.field->interpolated(p, kHorizonMm);
    if (known.face < 0) continue;
    ++asked;
    const double error = std::abs(found.distance_mm - known.distance_mm);
    worst = std::max(worst, error);
    if (error > 0.1 * kAllowanceMm) ++off;
  }
  EXPECT_GT(asked, 500U);
  EXPECT_LT(static_cast<double>(off), 0.01 * static_cast<double>(asked));
  EXPECT_LT(worst, kAllowanceMm);
}

TEST(DistanceCells, DoNotDependOnWhoAskedFirst) {
  const Channel one = channel(0.08), other = channel(0.08);
  const std::vector<Vec3> points = centres(*one.target, 400);
  std::vector<double> forward, backward;
  for (const Vec3& p : points) forward.push_back(one.field->interpolated(p, kHorizonMm).distance_mm);
  for (auto p = points.rbegin(); p != points.rend(); ++p)
    backward.push_back(other.field->interpolated(*p, kHorizonMm).distance_mm);
  for (std::size_t k = 0; k < points.size(); ++k) EXPECT_EQ(forward[k], backward[points.size() - 1 - k]);
}

}  // namespace
}  // namespace flank::internal
