// Bounds of pieces of surfaces against the surfaces, whatever was asked for before.
#include "flank/verify/proof/patch_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/base/random.h"
#include "flank/bspline_basis.h"

namespace flank::internal::verify {
namespace {

/// On [0, 1] x [0, 1] with random poles, inner knots where they are given, and weights if asked for.
BSplineSurface random_surface(int degree, const std::vector<double>& inner, bool rational, unsigned seed) {
  Random random(seed);
  BSplineSurface s;
  s.degree_u = s.degree_v = degree;
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, 0.0);
  knots.insert(knots.end(), inner.begin(), inner.end());
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, 1.0);
  s.knots_u = s.knots_v = knots;
  s.count_u = s.count_v = static_cast<int>(knots.size()) - degree - 1;
  for (int k = 0; k < s.count_u * s.count_v; ++k) {
    s.poles.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    if (rational) s.weights.push_back(random.uniform(0.5, 2.0));
  }
  return s;
}

/// No place of the patch is farther from its middle than is said, and none changes faster.
void expect_held(const BSplineSurface& s, const Rectangle& where) {
  const PatchBounds bounds = patch_bounds(s, where);
  const Vec2 size = where.high - where.low;
  double reach = 0.0, du = 0.0, dvv = 0.0;
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 8; ++j) {
      const SurfaceJet jet = s.jet(where.low.x() + size.x() * i / 8.0, where.low.y() + size.y() * j / 8.0);
      reach = std::max(reach, (jet.p - bounds.middle).norm());
      du = std::max(du, size.x() * jet.du.norm());
      dvv = std::max(dvv, size.y() * size.y() * jet.dvv.norm());
    }
  constexpr double kRounding = 1.0 + 1e-9;
  EXPECT_LE(reach, kRounding * bounds.reach);
  EXPECT_LE(du, kRounding * bounds.du);
  EXPECT_LE(dvv, kRounding * bounds.dvv + 1e-12);
  // And not by far: the control points of a small piece lie close to it.
  EXPECT_LE(bounds.reach, 3.0 * reach);
}

TEST(PatchBounds, HoldTheSurface) {
  Random random(3);
  for (const int degree : {1, 2, 3, 5, 8})
    for (const bool rational : {false, true}) {
      const BSplineSurface s = random_surface(degree, {0.25, 0.5}, rational, 17U + static_cast<unsigned>(degree));
      for (int k = 0; k < 20; ++k) {
        const double u = random.uniform(0.5, 0.9), v = random.uniform(0.25, 0.45);
        expect_held(s, {Vec2(u, v), Vec2(u + 0.05, v + 0.05)});
      }
    }
}

// What is kept from one question to the next is what a stretch of a span is made of, not where it lies alone.
TEST(PatchBounds, TheSameStretchOfOtherSurfacesIsNotTheSame) {
  const Rectangle where{Vec2(0.5, 0.5), Vec2(0.625, 0.5625)};
  const std::vector<std::vector<double>> inner{{0.5}, {0.25, 0.5}, {0.5, 0.75}, {0.375, 0.5}};
  for (int turn = 0; turn < 3; ++turn)
    for (const int degree : {2, 3, 4})
      for (std::size_t k = 0; k < inner.size(); ++k)
        expect_held(random_surface(degree, inner[k], turn == 1, 5U + static_cast<unsigned>(k)), where);
}

TEST(PatchBounds, ControlPointsOverAStretchMeetItsCorners) {
  const BSplineSurface s = random_surface(3, {0.5}, true, 9);
  for (const double low : {0.5, 0.75, 0.5}) {
    std::vector<Vec3> points;
    ASSERT_TRUE(add_control_points(s, {Vec2(low, 0.0), Vec2(low + 0.25, 0.5)}, points));
    ASSERT_EQ(points.size(), 16U);
    EXPECT_LT((points.front() - s.value(low, 0.0)).norm(), 1e-12);
    EXPECT_LT((points.back() - s.value(low + 0.25 - 1e-14, 0.5 - 1e-14)).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace flank::internal::verify
