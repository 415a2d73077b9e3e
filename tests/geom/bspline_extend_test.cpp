#include "flank/geom/bspline_extend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

/// z = quadratic in x and y over [0, 10] x [0, 4], as a bicubic surface with several cells.
BSplineSurface quadric() {
  std::vector<Vec3> points;
  std::vector<double> u, v;
  for (int i = 0; i < 33; ++i) u.push_back(i / 32.0);
  for (int j = 0; j < 7; ++j) v.push_back(j / 6.0);
  for (double a : u)
    for (double b : v) {
      const double x = 10 * a, y = 4 * b;
      points.emplace_back(x, y, 1 + 0.1 * x * x - 0.2 * x * y + 0.05 * y * y);
    }
  return interpolate_grid(points, u, v, 3);
}

TEST(BSplineExtend, KeepsTheSurfaceAndContinuesAQuadricExactly) {
  const BSplineSurface s = quadric(), wide = extend(s, {0.1, 0.2, 0.15, 0.05}, 0.18);
  EXPECT_DOUBLE_EQ(wide.u_first(), -0.1);
  EXPECT_DOUBLE_EQ(wide.u_last(), 1.2);
  EXPECT_DOUBLE_EQ(wide.v_first(), -0.15);
  EXPECT_DOUBLE_EQ(wide.v_last(), 1.05);
  EXPECT_EQ(wide.poles.size(), static_cast<std::size_t>(wide.count_u * wide.count_v));
  EXPECT_EQ(wide.knots_u.size(), static_cast<std::size_t>(wide.count_u + 4));
  Random random(1);
  for (int k = 0; k < 300; ++k) {
    const double u = random.uniform(-0.1, 1.2), v = random.uniform(-0.15, 1.05), x = 10 * u, y = 4 * v;
    EXPECT_LT((wide.value(u, v) - Vec3(x, y, 1 + 0.1 * x * x - 0.2 * x * y + 0.05 * y * y)).norm(), 1e-10);
  }
}

TEST(BSplineExtend, JoinsAtTheBorderAndDoesNotFollowARipple) {
  BSplineSurface s = quadric();
  for (int j = 0; j < s.count_v; ++j) s.pole(s.count_u - 2, j)[2] += 0.3;  // the last cell of each iso-line bends up
  const BSplineSurface wide = extend(s, {0, 0.1, 0, 0}, 0.18);
  for (double v = 0; v <= 1; v += 0.1) {
    EXPECT_LT((wide.value(1, v) - s.value(1, v)).norm(), 1e-12);
    EXPECT_LT((wide.value(0.97, v) - s.value(0.97, v)).norm(), 1e-12);
    const double x = 11, y = 4 * v, truth = 1 + 0.1 * x * x - 0.2 * x * y + 0.05 * y * y;
    const double error = std::abs(wide.value(1.1, v)[2] - truth);
    EXPECT_LT(error, 0.5 * std::abs(s.value(1.1, v)[2] - truth)) << "better than the last cell's polynomial";
  }
}

TEST(BSplineExtend, ContinuesACircularArcExactly) {
  const double h = std::numbers::sqrt2 / 2;  // quarter cylinder of radius 5 about z
  const BSplineSurface s{2,
                         1,
                         {0, 0, 0, 1, 1, 1},
                         {0, 0, 1, 1},
                         3,
                         2,
                         {{5, 0, 0}, {5, 0, 8}, {5, 5, 0}, {5, 5, 8}, {0, 5, 0}, {0, 5, 8}},
                         {1, 1, h, h, 1, 1}};
  const BSplineSurface wide = extend(s, {0.1, 0.1, 0.1, 0.1}, 0.18);
  EXPECT_GT(wide.count_u, s.count_u);
  for (double u = -0.1; u <= 1.1; u += 0.05)
    for (double v = -0.1; v <= 1.1; v += 0.1) {
      const Vec3 p = wide.value(u, v);
      EXPECT_NEAR(p.head<2>().norm(), 5, 1e-11);
      EXPECT_NEAR(p[2], 8 * v, 1e-11);
    }
  for (double w : wide.weights) EXPECT_GT(w, 0);
}

TEST(BSplineExtend, NothingToExtendChangesNothing) {
  const BSplineSurface s = quadric(), same = extend(s, {}, 0.18);
  EXPECT_EQ(same.knots_u, s.knots_u);
  EXPECT_EQ(same.count_v, s.count_v);
}

}  // namespace
}  // namespace flank::internal
