// Least-squares surfaces through scattered points, against the normal equations in full. mesh_spline_test.cpp has more.
#include "flank/surface/mesh/scattered_spline.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

struct Cloud {
  std::vector<Vec3> points;
  std::vector<Vec2> uv;
};

Cloud noisy_cloud(int count, std::uint64_t seed) {
  Random random(seed);
  Cloud c;
  for (int k = 0; k < count; ++k) {
    const double u = random.uniform(), v = random.uniform();
    c.uv.emplace_back(u, v);
    c.points.emplace_back(50 * u + 3 * std::sin(4 * v), 30 * v, 5 * std::cos(3 * u + v) + 0.1 * random.normal());
  }
  return c;
}

double squares(const BSplineSurface& s, const Cloud& c) {
  double sum = 0.0;
  for (std::size_t k = 0; k < c.points.size(); ++k)
    sum += (s.value(c.uv[k][0], c.uv[k][1]) - c.points[k]).squaredNorm();
  return sum;
}

/// The poles by dense linear algebra, without smoothing: enough points determine them.
std::vector<Vec3> dense_solution(const BSplineSurface& like, const Cloud& c) {
  const int size = like.count_u * like.count_v, p = like.degree_u;
  Eigen::MatrixXd design = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(c.points.size()), size);
  Eigen::MatrixX3d right(static_cast<Eigen::Index>(c.points.size()), 3);
  std::array<double, kMaxDegree + 1> bu, bv;
  for (Eigen::Index k = 0; k < right.rows(); ++k) {
    const Vec2& q = c.uv[static_cast<std::size_t>(k)];
    const int su = find_span(p, like.knots_u, q[0]), sv = find_span(p, like.knots_v, q[1]);
    basis_derivatives(p, like.knots_u, su, q[0], 0, bu.data());
    basis_derivatives(p, like.knots_v, sv, q[1], 0, bv.data());
    for (int a = 0; a <= p; ++a)
      for (int b = 0; b <= p; ++b)
        design(k, (su - p + a) * like.count_v + sv - p + b) =
            bu[static_cast<std::size_t>(a)] * bv[static_cast<std::size_t>(b)];
    right.row(k) = c.points[static_cast<std::size_t>(k)].transpose();
  }
  const Eigen::MatrixX3d x = (design.transpose() * design).ldlt().solve(design.transpose() * right);
  std::vector<Vec3> poles;
  for (int i = 0; i < size; ++i) poles.emplace_back(x.row(i).transpose());
  return poles;
}

TEST(ScatteredSpline, SolvesTheNormalEquations) {
  const Cloud c = noisy_cloud(1500, 1);
  for (const int degree : {1, 2, 3}) {
    const BSplineSurface s = fit_scattered(c.points, c.uv, {degree, 7, 9, 1e-13});
    EXPECT_EQ(s.count_u, 7);
    EXPECT_EQ(s.count_v, 9);
    EXPECT_EQ(s.degree_u, degree);
    const std::vector<Vec3> expected = dense_solution(s, c);
    for (std::size_t k = 0; k < s.poles.size(); ++k)
      EXPECT_LT((s.poles[k] - expected[k]).norm(), 1e-6) << "degree " << degree << ", pole " << k;
  }
}

TEST(ScatteredSpline, NoOtherSurfaceIsNearer) {
  const Cloud c = noisy_cloud(600, 2);
  const BSplineSurface best = fit_scattered(c.points, c.uv, {3, 6, 6, 1e-14});
  const double least = squares(best, c);
  for (std::size_t k = 0; k < best.poles.size(); k += 5)
    for (const double step : {0.01, -0.01}) {
      BSplineSurface other = best;
      other.poles[k][2] += step;
      EXPECT_GT(squares(other, c), least);
    }
}

TEST(ScatteredSpline, MovesWithItsPoints) {
  Cloud c = noisy_cloud(400, 3);
  const BSplineSurface a = fit_scattered(c.points, c.uv, {});
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.0, Vec3(1, -1, 2).normalized()).toRotationMatrix();
  const Vec3 shift(1e4, -2e4, 3e4);
  for (Vec3& p : c.points) p = turn * p + shift;
  const BSplineSurface b = fit_scattered(c.points, c.uv, {});
  for (std::size_t k = 0; k < a.poles.size(); ++k) EXPECT_LT((b.poles[k] - (turn * a.poles[k] + shift)).norm(), 1e-5);
}

TEST(ScatteredSpline, SwappingTheParametersSwapsTheSurface) {
  Cloud c = noisy_cloud(400, 4);
  const BSplineSurface a = fit_scattered(c.points, c.uv, {3, 6, 8, 1e-7});
  for (Vec2& q : c.uv) q = Vec2(q[1], q[0]);
  const BSplineSurface b = fit_scattered(c.points, c.uv, {3, 8, 6, 1e-7});
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 8; ++j) EXPECT_LT((a.pole(i, j) - b.pole(j, i)).norm(), 1e-8);
}

TEST(ScatteredSpline, ParametersOutsideTheSquareCountAsItsBorder) {
  Cloud inside = noisy_cloud(300, 5), outside = inside;
  inside.uv[7] = Vec2(1.0, 0.0);
  outside.uv[7] = Vec2(1.8, -3.0);
  const BSplineSurface a = fit_scattered(inside.points, inside.uv, {}),
                       b = fit_scattered(outside.points, outside.uv, {});
  for (std::size_t k = 0; k < a.poles.size(); ++k) EXPECT_EQ(a.poles[k], b.poles[k]);
}

/// What the smoothing likes best is a surface without second differences, whatever its weight.
TEST(ScatteredSpline, SmoothingLeavesPlanesAlone) {
  Cloud c = noisy_cloud(200, 6);
  for (std::size_t k = 0; k < c.points.size(); ++k) {
    const Vec2& q = c.uv[k];
    c.points[k] = Vec3(1, 2, 3) + q[0] * Vec3(4, 0, 1) + q[1] * Vec3(0, 5, -2);
  }
  for (const double smoothing : {1e-9, 1e-2}) {
    const BSplineSurface s = fit_scattered(c.points, c.uv, {1, 9, 9, smoothing});
    for (double u = 0.0; u <= 1.0; u += 0.125)
      for (double v = 0.0; v <= 1.0; v += 0.125)
        EXPECT_LT((s.value(u, v) - (Vec3(1, 2, 3) + u * Vec3(4, 0, 1) + v * Vec3(0, 5, -2))).norm(), 1e-5);
  }
}

TEST(ScatteredSpline, MoreSmoothingBendsLess) {
  const Cloud c = noisy_cloud(500, 7);
  const auto bends = [&](double smoothing) {
    const BSplineSurface s = fit_scattered(c.points, c.uv, {3, 14, 14, smoothing});
    double sum = 0.0;
    for (int i = 1; i + 1 < 14; ++i)
      for (int j = 0; j < 14; ++j) sum += (s.pole(i - 1, j) - 2.0 * s.pole(i, j) + s.pole(i + 1, j)).squaredNorm();
    return sum;
  };
  EXPECT_LT(bends(1e-1), bends(1e-3));
  EXPECT_LT(bends(1e1), 0.5 * bends(1e-1));
}

TEST(ScatteredSpline, TakesAtLeastAsManyControlPointsAsItsDegreeNeeds) {
  const Cloud c = noisy_cloud(50, 8);
  const BSplineSurface s = fit_scattered(c.points, c.uv, {3, 1, 2, 1e-7});
  EXPECT_EQ(s.count_u, 4);
  EXPECT_EQ(s.count_v, 4);
  const BSplineSurface one = fit_scattered(std::span(c.points).first(1), std::span(c.uv).first(1), {3, 5, 5, 1e-7});
  for (const Vec3& p : one.poles) EXPECT_LT((p - c.points[0]).norm(), 1e-6) << "a single point is all there is";
}

}  // namespace
}  // namespace flank::internal
