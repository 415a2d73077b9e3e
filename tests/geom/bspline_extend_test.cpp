#include "flank/geom/bspline_extend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/base/random.h"
#include "surface/nurbs_fixtures.h"

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

/// A surface that is quadratic in its last cells goes on as that quadratic: value and derivatives meet at the join.
TEST(BSplineExtend, JoinsWithBothDerivativesWhereTheEndIsQuadratic) {
  const BSplineSurface s = quadric(), wide = extend(s, {0.1, 0.1, 0.1, 0.1}, 0.18);
  const auto join = [&](double u, double v, double du, double dv) {
    const SurfaceJet in = wide.jet(u - 1e-9 * du, v - 1e-9 * dv), out = wide.jet(u + 1e-9 * du, v + 1e-9 * dv);
    EXPECT_LT((in.p - out.p).norm(), 1e-7);
    EXPECT_LT((in.du - out.du).norm(), 1e-6);
    EXPECT_LT((in.dv - out.dv).norm(), 1e-6);
    EXPECT_LT((in.duu - out.duu).norm(), 1e-4);
    EXPECT_LT((in.duv - out.duv).norm(), 1e-4);
    EXPECT_LT((in.dvv - out.dvv).norm(), 1e-4);
  };
  for (double t = 0.05; t < 1.0; t += 0.1) {
    join(0.0, t, -1, 0);
    join(1.0, t, 1, 0);
    join(t, 0.0, 0, -1);
    join(t, 1.0, 0, 1);
  }
}

TEST(BSplineExtend, JoinsWithoutAGapWhateverTheSurface) {
  const BSplineSurface s = test::wavy(3, 4, 3, 8, 7, true, 20).surface;
  const BSplineSurface wide = extend(s, {0.05, 0.1, 0.2, 0.3}, 0.18);
  for (double t = 0.0; t <= 1.0; t += 0.05) {
    const double v = -2.0 + 7.0 * t;
    EXPECT_LT((wide.value(1.0 + 1e-12, v) - s.value(1.0, v)).norm(), 1e-8);
    EXPECT_LT((wide.value(-1e-12, v) - s.value(0.0, v)).norm(), 1e-8);
    EXPECT_LT((wide.value(t, 5.0 + 1e-12) - s.value(t, 5.0)).norm(), 1e-8);
    EXPECT_LT((wide.value(t, -2.0 - 1e-12) - s.value(t, -2.0)).norm(), 1e-8);
    EXPECT_LT((wide.value(t, v) - s.value(t, v)).norm(), 1e-10) << "inside it is the surface itself";
  }
}

/// The extension of a curve is the least-squares parabola through the border: no other one is nearer to the outer part.
TEST(BSplineExtend, IsTheBestParabolaOverTheOuterShare) {
  BSplineSurface s = quadric();
  Random random(4);
  for (Vec3& p : s.poles) p[2] += random.uniform(-0.3, 0.3);
  constexpr double kShare = 0.25;
  const BSplineSurface wide = extend(s, {0.0, 0.2, 0.0, 0.0}, kShare);
  const double v = 0.0;  // an iso-line of control points, so that it is a curve of its own
  const Vec3 end = s.value(1.0, v);
  const auto parabola = [&](double x, double a, double b) {
    const Vec3 p1 = wide.value(1.1, v) - end, p2 = wide.value(1.2, v) - end;
    const Vec3 c2 = (p2 - 2.0 * p1) / 0.02, c1 = (p1 - 0.01 * c2) / 0.1;
    return Vec3(end + (c1 + Vec3(0, 0, a)) * x + (c2 + Vec3(0, 0, b)) * x * x);
  };
  const auto squares = [&](double a, double b) {
    double sum = 0.0;
    for (int k = 1; k <= 32; ++k) {
      const double x = -kShare * k / 32.0;
      sum += (parabola(x, a, b) - s.value(1.0 + x, v)).squaredNorm();
    }
    return sum;
  };
  const double least = squares(0.0, 0.0);
  for (const double step : {0.05, -0.05}) {
    EXPECT_GT(squares(step, 0.0), least);
    EXPECT_GT(squares(0.0, step), least);
  }
}

TEST(BSplineExtend, MovesWithTheSurfaceAndTurnsWithItsParameters) {
  const BSplineSurface s = test::wavy(5, 3, 3, 8, 7, true, 20).surface;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.2, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  BSplineSurface moved = s, mirrored = s;
  for (Vec3& p : moved.poles) p = turn * p + Vec3(3, 4, 5);
  for (int i = 0; i < s.count_u; ++i)
    for (int j = 0; j < s.count_v; ++j) {
      mirrored.pole(i, j) = s.pole(s.count_u - 1 - i, j);
      mirrored.weights[static_cast<std::size_t>(i * s.count_v + j)] =
          s.weights[static_cast<std::size_t>((s.count_u - 1 - i) * s.count_v + j)];
    }
  const BSplineSurface a = extend(s, {0.1, 0.05, 0.3, 0.2}, 0.2), b = extend(moved, {0.1, 0.05, 0.3, 0.2}, 0.2),
                       c = extend(mirrored, {0.05, 0.1, 0.3, 0.2}, 0.2);
  for (double u = -0.1; u <= 1.05; u += 0.05)
    for (double v = -2.3; v <= 5.2; v += 0.5) {
      EXPECT_LT((b.value(u, v) - (turn * a.value(u, v) + Vec3(3, 4, 5))).norm(), 1e-9);
      EXPECT_LT((c.value(1.0 - u, v) - a.value(u, v)).norm(), 1e-9);
    }
}

TEST(BSplineExtend, LinesGoStraightOn) {
  const BSplineSurface s = test::bilinear({0, 0, 0}, {0, 8, 1}, {10, 0, 2}, {10, 8, 7}).surface;
  const BSplineSurface wide = extend(s, {0.5, 0.5, 0.5, 0.5}, 0.3);
  EXPECT_EQ(wide.degree_u, 1);
  for (double u = -0.5; u <= 1.5; u += 0.1)
    for (double v = -0.5; v <= 1.5; v += 0.1) EXPECT_LT((wide.value(u, v) - s.jet(u, v).p).norm(), 1e-12);
}

TEST(BSplineExtend, ASideWhoseWeightsWouldVanishIsLeftAsItIs) {
  BSplineSurface s = test::plane(10).surface;
  s.weights = {10, 10, 1, 1};  // the weight falls by 9 over the surface: by 0.9 per tenth
  const BSplineSurface wide = extend(s, {0.2, 0.2, 0.0, 0.0}, 0.3);
  EXPECT_EQ(wide.u_last(), 1.0) << "beyond, a weight below a tenth of the border's would be reached";
  EXPECT_EQ(wide.u_first(), -0.2);
  for (const double w : wide.weights) EXPECT_GT(w, 0.0);
}

}  // namespace
}  // namespace flank::internal
