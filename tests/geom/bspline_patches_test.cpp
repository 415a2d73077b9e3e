#include "flank/geom/bspline_patches.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

BSplineSurface random_surface(std::uint64_t seed, int p, int q, int nu, int nv, bool rational) {
  Random random(seed);
  BSplineSurface s{p, q, uniform_knots(p, nu, -1.0, 4.0), uniform_knots(q, nv, 10.0, 10.5), nu, nv, {}, {}};
  for (int k = 0; k < nu * nv; ++k) {
    s.poles.emplace_back(random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-50, 50));
    if (rational) s.weights.push_back(random.uniform(0.5, 2));
  }
  return s;
}

TEST(BSplinePatches, AgreeWithTheSurfaceForAllDegrees) {
  Random random(1);
  for (int p : {1, 2, 3, 4, 5, 8, 15})
    for (int q : {1, 2, 3, 6})
      for (bool rational : {false, true}) {
        const BSplineSurface s = random_surface(7, p, q, p + 5, q + 3, rational);
        const BSplinePatches patches(s);
        const double scale = p == 15 ? 1e-8 : 1e-10;
        for (int k = 0; k < 50; ++k) {
          const double u = random.uniform(-1, 4), v = random.uniform(10, 10.5);
          const SurfaceJet a = s.jet(u, v), b = patches.jet(u, v);
          EXPECT_LT((a.p - b.p).norm(), scale) << p << ' ' << q;
          EXPECT_LT((a.du - b.du).norm(), scale * 10 * p);
          EXPECT_LT((a.dv - b.dv).norm(), scale * 100 * q);
          EXPECT_LT((a.duu - b.duu).norm(), scale * 100 * p * p);
          EXPECT_LT((a.duv - b.duv).norm(), scale * 1000 * p * q);
          EXPECT_LT((a.dvv - b.dvv).norm(), scale * 10000 * q * q);
        }
      }
}

TEST(BSplinePatches, CellsAreThoseOfTheKnots) {
  BSplineSurface s = random_surface(3, 2, 1, 7, 4, false);
  s.knots_u = {0, 0, 0, 0.1, 0.7, 0.7, 0.9, 1, 1, 1};  // uneven, one full knot
  const BSplinePatches patches(s);
  EXPECT_EQ(patches.cells_u(), 4);
  EXPECT_EQ(patches.cells_v(), 3);
  const std::vector<double>& breaks = patches.breaks_u();
  for (double u = -0.5; u < 1.5; u += 0.01) {
    const auto k = static_cast<std::size_t>(patches.cell_u(u));
    if (u >= 0 && u < 1) {
      EXPECT_LE(breaks[k], u);
      EXPECT_LT(u, breaks[k + 1]);
    }
  }
  EXPECT_EQ(patches.cell_u(-1), 0);
  EXPECT_EQ(patches.cell_u(1.0), 3);
  EXPECT_EQ(patches.cell_u(0.7), 2);
  EXPECT_EQ(patches.cell_u(std::nan("")), 0);
}

TEST(BSplinePatches, HullsHoldTheirPart) {
  for (bool rational : {false, true}) {
    const BSplineSurface s = random_surface(5, 3, 2, 6, 5, rational);
    const BSplinePatches patches(s);
    Random random(2);
    for (int i = 0; i < patches.cells_u(); ++i)
      for (int j = 0; j < patches.cells_v(); ++j) {
        const double a = patches.breaks_u()[static_cast<std::size_t>(i)],
                     b = patches.breaks_u()[static_cast<std::size_t>(i) + 1];
        const double c = patches.breaks_v()[static_cast<std::size_t>(j)],
                     d = patches.breaks_v()[static_cast<std::size_t>(j) + 1];
        const double u0 = a + 0.3 * (b - a), u1 = a + 0.8 * (b - a);
        const std::vector<Vec3> hull = patches.hull(i, j, u0, u1, c, d);
        ASSERT_EQ(hull.size(), 12u);
        EXPECT_LT((hull.front() - s.value(u0, c)).norm(), 1e-10);
        // Support functions: no point sticks out of the hull in any direction.
        for (int k = 0; k < 50; ++k) {
          const Vec3 n(random.normal(), random.normal(), random.normal());
          double most = -1e300;
          for (const Vec3& h : hull) most = std::max(most, n.dot(h));
          EXPECT_LE(n.dot(s.value(random.uniform(u0, u1), random.uniform(c, d))), most + 1e-9);
        }
      }
  }
}

}  // namespace
}  // namespace flank::internal
