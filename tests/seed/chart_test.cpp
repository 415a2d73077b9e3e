// The rectangle of points over a target, where it is known: planes, a cylinder, several faces, a mesh.
#include "flank/seed/chart.h"

#include <gtest/gtest.h>

#include <cmath>

#include "seed/sheet.h"

namespace flank::internal {
namespace {

using testing::rectangle;
using testing::sheet;

constexpr double kRadius = 30.0, kAngle = 1.0, kHeight = kRadius * kAngle;

/// A piece of the cylinder about the z axis, as wide as it is high; u goes round, v up, the normal is outwards.
Vec3 on_cylinder(double u, double v) {
  return {kRadius * std::cos(kAngle * u), kRadius * std::sin(kAngle * u), kHeight * v};
}

/// Distance of the rectangle's corner nearest to x.
double off_corner(const Vec3& x, double width, double depth) {
  double least = 1e300;
  for (const double a : {0.0, width})
    for (const double b : {0.0, depth}) least = std::min(least, (x - Vec3(a, b, 0.0)).norm());
  return least;
}

TEST(Chart, OfASquareIsTheSquare) {
  const Chart chart(*make_target({rectangle(5.0, -7.0, 40.0, 40.0)}));
  for (const double a : {0.0, 0.13, 0.5, 0.77, 1.0}) {
    for (const double b : {0.0, 0.31, 0.5, 0.99, 1.0}) {
      const ChartPoint at = chart.at(a, b);
      EXPECT_NEAR((at.point - Vec3(5.0 + 40.0 * a, -7.0 + 40.0 * b, 0.0)).norm(), 0.0, 1e-4) << a << " " << b;
      EXPECT_NEAR((at.normal - Vec3::UnitZ()).norm(), 0.0, 1e-9);
    }
  }
  EXPECT_NEAR(chart.length_a(), 40.0, 1e-4);
  EXPECT_NEAR(chart.length_b(), 40.0, 1e-4);
}

TEST(Chart, OfARectangleIsTheRectangleToACell) {
  const Chart chart(*make_target({rectangle(0.0, 0.0, 80.0, 20.0)}));
  for (const double a : {0.0, 0.5, 1.0})
    for (const double b : {0.0, 0.5, 1.0}) {
      EXPECT_NEAR((chart.at(a, b).point - Vec3(80.0 * a, 20.0 * b, 0.0)).norm(), 0.0, 1.0) << a << " " << b;
    }
  EXPECT_NEAR(chart.length_a(), 80.0, 1.6);
  EXPECT_NEAR(chart.length_b(), 20.0, 1.1) << "a cell is a millimetre; each end is off by half of it";
}

TEST(Chart, GoesOnPastTheBorder) {
  const Chart chart(*make_target({rectangle(0.0, 0.0, 40.0, 40.0)}));
  for (const double a : {-0.3, -0.05, 1.04, 1.5}) {
    EXPECT_NEAR((chart.at(a, 0.5).point - Vec3(40.0 * a, 20.0, 0.0)).norm(), 0.0, 1e-3) << a;
    EXPECT_NEAR((chart.at(0.25, a).point - Vec3(10.0, 40.0 * a, 0.0)).norm(), 0.0, 1e-3) << a;
    EXPECT_NEAR(chart.at(a, a).normal.norm(), 1.0, 1e-12);
  }
}

TEST(Chart, FollowsACylinder) {
  const Chart chart(*make_target({sheet(on_cylinder)}));
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j <= 20; ++j) {
      const ChartPoint at = chart.at(i / 20.0, j / 20.0);
      // Between the nodes it is a chord of a 36th of the arc: 30 (1/36)^2 / 8 = 0.003 mm.
      EXPECT_NEAR(at.point.head<2>().norm(), kRadius, 5e-3);
      EXPECT_NEAR((at.point - on_cylinder(i / 20.0, j / 20.0)).norm(), 0.0, 0.05);
      const Vec3 outwards(at.point.x() / kRadius, at.point.y() / kRadius, 0.0);
      EXPECT_NEAR((at.normal - outwards).norm(), 0.0, 2e-3);
      EXPECT_NEAR(at.normal.norm(), 1.0, 1e-12);
    }
  }
  EXPECT_NEAR(chart.length_a(), kRadius * kAngle, 0.05);
  EXPECT_NEAR(chart.length_b(), kHeight, 0.05);
}

TEST(Chart, TheNormalIsThatOfTheMachiningSide) {
  const Chart outside(*make_target({sheet(on_cylinder)}, +1)), inside(*make_target({sheet(on_cylinder)}, -1));
  for (const double a : {0.1, 0.6}) {
    EXPECT_NEAR((outside.at(a, 0.4).normal + inside.at(a, 0.4).normal).norm(), 0.0, 1e-9);
    EXPECT_NEAR((outside.at(a, 0.4).point - inside.at(a, 0.4).point).norm(), 0.0, 1e-9);
  }
}

TEST(Chart, OfSeveralFacesRunsAlongTheirLongDirection) {
  // Two squares side by side make a rectangle of 80 x 40.
  const Chart chart(*make_target({rectangle(0.0, 0.0, 40.0, 40.0), rectangle(40.0, 0.0, 40.0, 40.0)}));
  EXPECT_NEAR(chart.length_a(), 80.0, 2.0);
  EXPECT_NEAR(chart.length_b(), 40.0, 2.0);
  for (const double a : {0.0, 1.0})
    for (const double b : {0.0, 1.0}) EXPECT_LT(off_corner(chart.at(a, b).point, 80.0, 40.0), 1.5) << a << " " << b;
  const Vec3 along = (chart.at(1.0, 0.5).point - chart.at(0.0, 0.5).point).normalized();
  EXPECT_NEAR(std::abs(along.x()), 1.0, 1e-3);
  EXPECT_NEAR((chart.at(0.5, 0.5).point - Vec3(40.0, 20.0, 0.0)).norm(), 0.0, 0.5);
}

TEST(Chart, OfAMeshRunsAlongItsLongDirection) {
  TriangleMesh mesh;
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j <= 10; ++j) mesh.vertices.emplace_back(3.0 * j, 4.0 * i, 0.0);
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 10; ++j) {
      const int k = 11 * i + j;
      mesh.triangles.push_back({k, k + 1, k + 12});
      mesh.triangles.push_back({k, k + 12, k + 11});
    }
  const Chart chart(*make_target(mesh));
  EXPECT_NEAR(chart.length_a(), 80.0, 2.5);
  EXPECT_NEAR(chart.length_b(), 30.0, 2.5);
  EXPECT_NEAR(std::abs(chart.at(0.3, 0.3).normal.z()), 1.0, 1e-6);
}

TEST(Chart, MovesWithItsTarget) {
  const Eigen::AngleAxisd turn(0.7, Vec3(0.3, -0.5, 0.8).normalized());
  const Vec3 shift(-40.0, 12.0, 55.0);
  const Face face = sheet(on_cylinder);
  const Chart here(*make_target({face})), there(*make_target({testing::moved(face, turn, shift)}));
  for (const double a : {-0.05, 0.2, 0.9})
    for (const double b : {0.1, 0.5, 1.05}) {
      const ChartPoint p = here.at(a, b), q = there.at(a, b);
      EXPECT_NEAR((turn * p.point + shift - q.point).norm(), 0.0, 1e-6);
      EXPECT_NEAR((turn * p.normal - q.normal).norm(), 0.0, 1e-6);
    }
}

}  // namespace
}  // namespace flank::internal
