// Tensor-product surfaces: against the sum of basis functions, exact quadrics, differences, poles; interpolation.
#include "flank/bspline_surface.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "flank/base/random.h"
#include "surface/nurbs_fixtures.h"

namespace flank::internal {
namespace {

/// All basis functions of one direction at t, those that vanish too.
std::vector<double> all_basis(int degree, const std::vector<double>& knots, double t) {
  std::vector<double> all(knots.size() - static_cast<std::size_t>(degree) - 1, 0.0);
  std::array<double, kMaxDegree + 1> n;
  const int span = find_span(degree, knots, t);
  basis_derivatives(degree, knots, span, t, 0, n.data());
  for (int j = 0; j <= degree; ++j) all[static_cast<std::size_t>(span - degree + j)] = n[static_cast<std::size_t>(j)];
  return all;
}

Vec3 by_sum(const BSplineSurface& s, double u, double v) {
  const std::vector<double> bu = all_basis(s.degree_u, s.knots_u, u), bv = all_basis(s.degree_v, s.knots_v, v);
  Vec3 sum = Vec3::Zero();
  double weight = 0.0;
  for (int i = 0; i < s.count_u; ++i)
    for (int j = 0; j < s.count_v; ++j) {
      const double w = s.weights.empty() ? 1.0 : s.weights[static_cast<std::size_t>(i * s.count_v + j)];
      const double b = bu[static_cast<std::size_t>(i)] * bv[static_cast<std::size_t>(j)] * w;
      sum += b * s.pole(i, j);
      weight += b;
    }
  return sum / weight;
}

struct Shape {
  Vec3 normal;
  double mean, gauss;  ///< towards the normal
};

Shape shape(const SurfaceJet& s) {
  const Vec3 n = s.du.cross(s.dv).normalized();
  const double e = s.du.squaredNorm(), f = s.du.dot(s.dv), g = s.dv.squaredNorm(), det = e * g - f * f;
  const double l = s.duu.dot(n), m = s.duv.dot(n), k = s.dvv.dot(n);
  return {n, (e * k - 2 * f * m + g * l) / (2 * det), (l * k - m * m) / det};
}

TEST(BSplineSurface, IsTheSumOfItsControlPoints) {
  Random random(1);
  for (const bool rational : {false, true})
    for (const auto& [p, q] : {std::pair(1, 3), std::pair(2, 2), std::pair(3, 1), std::pair(5, 3)}) {
      const BSplineSurface s = test::wavy(3, p, q, 8, 7, rational, 12.0).surface;
      for (int k = 0; k < 60; ++k) {
        const double u = random.uniform(s.u_first(), s.u_last()), v = random.uniform(s.v_first(), s.v_last());
        EXPECT_LT((s.value(u, v) - by_sum(s, u, v)).norm(), 1e-11);
        EXPECT_LT((s.jet(u, v).p - s.value(u, v)).norm(), 1e-11);
      }
      EXPECT_LT((s.value(s.u_first(), s.v_last()) - s.pole(0, 6)).norm(), 1e-11);
      EXPECT_LT((s.value(s.u_last(), s.v_first()) - s.pole(7, 0)).norm(), 1e-11);
    }
}

TEST(BSplineSurface, DerivativesMatchCentralDifferences) {
  Random random(2);
  for (const bool rational : {false, true}) {
    const BSplineSurface s = test::wavy(4, 4, 3, 9, 8, rational, 12.0).surface;
    for (int k = 0; k < 60; ++k) {
      const double u = random.uniform(0.01, 0.99), v = random.uniform(-1.9, 4.9), h = 1e-5;
      const SurfaceJet j = s.jet(u, v), a = s.jet(u - h, v), b = s.jet(u + h, v), c = s.jet(u, v - h),
                       d = s.jet(u, v + h);
      EXPECT_LT((j.du - (b.p - a.p) / (2 * h)).norm(), 1e-5);
      EXPECT_LT((j.dv - (d.p - c.p) / (2 * h)).norm(), 1e-6);
      EXPECT_LT((j.duu - (b.du - a.du) / (2 * h)).norm(), 1e-3);
      EXPECT_LT((j.duv - (d.du - c.du) / (2 * h)).norm(), 1e-4);
      EXPECT_LT((j.duv - (b.dv - a.dv) / (2 * h)).norm(), 1e-4);
      EXPECT_LT((j.dvv - (d.dv - c.dv) / (2 * h)).norm(), 1e-4);
    }
  }
}

TEST(BSplineSurface, SphereCylinderAndTorusHaveTheirCurvatures) {
  Random random(3);
  const BSplineSurface sphere = test::sphere(7.0).surface, cylinder = test::cylinder(5.0, 9.0, 4).surface,
                       torus = test::torus(20.0, 6.0).surface;
  for (int k = 0; k < 100; ++k) {
    const double u = random.uniform(0.0, 4.0), v = random.uniform();
    const Shape ball = shape(sphere.jet(u, 0.05 + 1.9 * v));
    const Vec3 p = sphere.value(u, 0.05 + 1.9 * v);
    EXPECT_NEAR(p.norm(), 7.0, 1e-13);
    EXPECT_LT((ball.normal - p / 7.0).norm(), 1e-11) << "outwards";
    EXPECT_NEAR(ball.mean, -1.0 / 7.0, 1e-10) << "it bends away from its normal";
    EXPECT_NEAR(ball.gauss, 1.0 / 49.0, 1e-10);
    const Shape tube = shape(cylinder.jet(u, v));
    EXPECT_NEAR(tube.mean, -0.1, 1e-12);
    EXPECT_NEAR(tube.gauss, 0.0, 1e-12);
    const Vec3 q = torus.value(u, 4.0 * v);
    const double ring = std::hypot(q[0], q[1]), c = (ring - 20.0) / 6.0;
    EXPECT_NEAR(std::hypot(ring - 20.0, q[2]), 6.0, 1e-13);
    const Shape ringed = shape(torus.jet(u, 4.0 * v));
    const double sign = ringed.normal.dot(Vec3(q[0] / ring * c, q[1] / ring * c, q[2] / 6.0));
    EXPECT_NEAR(std::abs(sign), 1.0, 1e-11);
    EXPECT_NEAR(ringed.gauss, c / (6.0 * ring), 1e-11);
    EXPECT_NEAR(ringed.mean, -0.5 * sign * (1.0 / 6.0 + c / ring), 1e-11);
  }
}

TEST(BSplineSurface, AtAPoleOneDirectionStandsStill) {
  const BSplineSurface s = test::sphere(7.0).surface;
  for (double u = 0.0; u <= 4.0; u += 0.25) {
    const SurfaceJet jet = s.jet(u, 0.0);
    EXPECT_LT((jet.p - Vec3(0, 0, -7)).norm(), 1e-13);
    EXPECT_LT(jet.du.norm(), 1e-12);
    EXPECT_GT(jet.dv.norm(), 1.0);
    EXPECT_NEAR(jet.dv[2], 0.0, 1e-12);
  }
}

TEST(BSplineSurface, MovesWithItsControlPointsAndScalesWithItsKnots) {
  Random random(4);
  const BSplineSurface s = test::wavy(5, 3, 3, 7, 7, true, 10.0).surface;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.9, Vec3(1, -2, 3).normalized()).toRotationMatrix();
  BSplineSurface moved = s, slow = s;
  for (Vec3& p : moved.poles) p = turn * p + Vec3(1, 2, 3);
  for (double& k : slow.knots_u) k = 10.0 * k + 3.0;
  for (int k = 0; k < 40; ++k) {
    const double u = random.uniform(), v = random.uniform(-2.0, 5.0);
    const SurfaceJet a = s.jet(u, v), b = moved.jet(u, v), c = slow.jet(10.0 * u + 3.0, v);
    EXPECT_LT((b.p - (turn * a.p + Vec3(1, 2, 3))).norm(), 1e-11);
    EXPECT_LT((b.duv - turn * a.duv).norm(), 1e-9);
    EXPECT_LT((c.p - a.p).norm(), 1e-11);
    EXPECT_LT((10.0 * c.du - a.du).norm(), 1e-9);
    EXPECT_LT((100.0 * c.duu - a.duu).norm(), 1e-8);
    EXPECT_LT((10.0 * c.duv - a.duv).norm(), 1e-9);
    EXPECT_LT((c.dvv - a.dvv).norm(), 1e-10);
  }
}

TEST(BSplineSurface, OutsideItsDomainTheEndPolynomialsGoOn) {
  // One cubic cell: the polynomial itself, inside and outside.
  std::vector<Vec3> points;
  const std::vector<double> t{0.0, 0.3, 0.6, 1.0};
  const auto truth = [](double u, double v) { return Vec3(u + v, u * u * u - v, u * v * v - 2.0 * u * u); };
  for (const double u : t)
    for (const double v : t) points.push_back(truth(u, v));
  const BSplineSurface s = interpolate_grid(points, t, t, 3);
  for (double u = -0.5; u <= 1.5; u += 0.25)
    for (double v = -0.5; v <= 1.5; v += 0.25) {
      EXPECT_LT((s.value(u, v) - truth(u, v)).norm(), 1e-12);
      EXPECT_LT((s.jet(u, v).duu - Vec3(0.0, 6.0 * u, -4.0)).norm(), 1e-10);
      EXPECT_LT((s.jet(u, v).duv - Vec3(0.0, 0.0, 2.0 * v)).norm(), 1e-10);
    }
}

TEST(InterpolateGrid, PassesThroughItsPointsInTheirOrder) {
  Random random(6);
  std::vector<double> u{0.0}, v{0.0};
  for (int i = 1; i < 9; ++i) u.push_back(u.back() + random.uniform(0.5, 2.0));
  for (int j = 1; j < 6; ++j) v.push_back(v.back() + random.uniform(0.5, 2.0));
  for (std::vector<double>* t : {&u, &v}) {
    const double last = t->back();
    for (double& x : *t) x /= last;
  }
  std::vector<Vec3> points;
  for (const double a : u)
    for (const double b : v) points.emplace_back(10 * a, 5 * b, random.uniform(-1, 1));
  for (const int degree : {1, 2, 3, 5}) {
    const BSplineSurface s = interpolate_grid(points, u, v, degree);
    EXPECT_EQ(s.count_u, 9);
    EXPECT_EQ(s.count_v, 6);
    for (std::size_t i = 0; i < u.size(); ++i)
      for (std::size_t j = 0; j < v.size(); ++j)
        EXPECT_LT((s.value(u[i], v[j]) - points[i * v.size() + j]).norm(), 1e-11) << "degree " << degree;
  }
}

TEST(InterpolateGrid, ReproducesPolynomialsOfItsDegree) {
  std::vector<double> u, v;
  for (int i = 0; i <= 10; ++i) u.push_back(i / 10.0);
  for (int j = 0; j <= 7; ++j) v.push_back(j * j / 49.0);
  const auto truth = [](double a, double b) { return Vec3(a * a * a, a * b * b * b - b, 2 * a * a * b + 1); };
  std::vector<Vec3> points;
  for (const double a : u)
    for (const double b : v) points.push_back(truth(a, b));
  const BSplineSurface s = interpolate_grid(points, u, v, 3);
  Random random(7);
  for (int k = 0; k < 100; ++k) {
    const double a = random.uniform(), b = random.uniform();
    EXPECT_LT((s.value(a, b) - truth(a, b)).norm(), 1e-12);
  }
}

TEST(InterpolateGrid, WithDoubleKnotsGivesBackASurfaceWithACrease) {
  BSplineSurface truth = test::wavy(8, 2, 3, 7, 6, false, 10.0).surface;
  truth.knots_u = {0, 0, 0, 0.25, 0.5, 0.5, 0.75, 1, 1, 1};  // C0 at 0.5
  const std::vector<double> u = greville_sites(truth.knots_u, 2), v = greville_sites(truth.knots_v, 3);
  std::vector<Vec3> points;
  for (const double a : u)
    for (const double b : v) points.push_back(truth.value(a, b));
  const BSplineSurface s = interpolate_grid(points, truth.knots_u, truth.knots_v, 2, 3);
  for (std::size_t k = 0; k < s.poles.size(); ++k) EXPECT_LT((s.poles[k] - truth.poles[k]).norm(), 1e-10);
}

TEST(GrevilleSites, AreWhereTheIdentityHasItsControlPoints) {
  const std::vector<double> knots{0, 0, 0, 0, 0.2, 0.5, 0.5, 0.9, 1, 1, 1, 1};
  const std::vector<double> sites = greville_sites(knots, 3);
  ASSERT_EQ(sites.size(), 8u);
  EXPECT_EQ(sites.front(), 0.0);
  EXPECT_EQ(sites.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(sites.begin(), sites.end()));
  for (double t = 0.0; t <= 1.0; t += 0.05) {
    const std::vector<double> n = all_basis(3, knots, t);
    double sum = 0.0;
    for (std::size_t k = 0; k < n.size(); ++k) sum += n[k] * sites[k];
    EXPECT_NEAR(sum, t, 1e-14);
  }
}

}  // namespace
}  // namespace flank::internal
