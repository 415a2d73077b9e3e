#include "flank/geom/trim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

/// Exact circle of four rational quarter arcs.
TrimLoop circle(double x, double y, double radius) {
  BSplineCurve2 c;
  c.degree = 2;
  c.knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  c.poles.resize(2, 9);
  for (int k = 0; k < 9; ++k) {
    const double angle = k * std::numbers::pi / 4, reach = k % 2 == 1 ? std::numbers::sqrt2 : 1.0;
    c.poles.col(k) = Vec2(x + radius * reach * std::cos(angle), y + radius * reach * std::sin(angle));
    c.weights.push_back(1 / reach);
  }
  return {{c}};
}

TEST(Trim, NoLoopOrTheRectangleItselfTrimsNothing) {
  const ParameterRectangle r{-1, 3, 2, 7};
  EXPECT_TRUE(TrimRegion({}, r).whole());
  TrimLoop loop = rectangle_loop(r);
  EXPECT_TRUE(TrimRegion({loop}, r).whole());
  loop.edges[0].poles(1, 0) += 1e-9;  // round-off of a file
  EXPECT_TRUE(TrimRegion({loop}, r).whole());
  EXPECT_FALSE(TrimRegion({rectangle_loop({-1, 3, 2, 6.9})}, r).whole());
  EXPECT_FALSE(TrimRegion({loop, circle(1, 4, 0.5)}, r).whole());
  const TrimRegion whole({}, r);
  EXPECT_TRUE(whole.inside(0, 5));
  EXPECT_FALSE(whole.inside(-1.1, 5));
}

TEST(Trim, RectangleWithARoundHole) {
  const ParameterRectangle r{0, 10, 0, 4};
  const TrimRegion region({rectangle_loop({1, 9, 0, 4}), circle(5, 2, 1.5)}, r);
  EXPECT_FALSE(region.whole());
  EXPECT_DOUBLE_EQ(region.box().u0, 1);
  EXPECT_DOUBLE_EQ(region.box().v1, 4);
  Random random(1);
  for (int k = 0; k < 100000; ++k) {
    const double u = random.uniform(0, 10), v = random.uniform(0, 4), rho = std::hypot(u - 5, v - 2);
    if (std::abs(rho - 1.5) < 4e-6 || std::abs(u - 1) < 1e-9 || std::abs(u - 9) < 1e-9) continue;
    EXPECT_EQ(region.inside(u, v), u > 1 && u < 9 && rho > 1.5) << u << ' ' << v;
  }
}

TEST(Trim, CellsAreInsideOutsideOrCut) {
  const TrimRegion region({circle(5, 5, 3)}, {0, 10, 0, 10});
  using Side = TrimRegion::Side;
  EXPECT_EQ(region.classify({4, 6, 4, 6}), Side::kInside);
  EXPECT_EQ(region.classify({0, 1, 0, 1}), Side::kOutside);
  EXPECT_EQ(region.classify({7.5, 8.5, 4, 6}), Side::kCut);
  EXPECT_EQ(region.classify({0, 10, 0, 10}), Side::kCut) << "a rectangle that holds the loop";
  EXPECT_EQ(region.classify({2.0, 2.7, 2.0, 2.7}), Side::kOutside) << "in the box of the circle only";
  Random random(2);
  for (int k = 0; k < 2000; ++k) {
    const double u = random.uniform(0, 9), v = random.uniform(0, 9), h = random.uniform(0.01, 1);
    const Side side = region.classify({u, u + h, v, v + h});
    for (int m = 0; m < 20; ++m) {
      const bool in = std::hypot(u + random.uniform() * h - 5, v + random.uniform() * h - 5) < 3 - 1e-5;
      if (in) {
        EXPECT_NE(side, Side::kOutside);
      }
    }
  }
}

TEST(Trim, EndsThatDoNotMeetAreJoined) {
  TrimLoop loop = rectangle_loop({2, 8, 2, 8});
  loop.edges[1].poles(1, 0) += 1e-5;
  const TrimRegion region({loop}, {0, 10, 0, 10});
  EXPECT_TRUE(region.inside(5, 5));
  EXPECT_FALSE(region.inside(1, 5));
  EXPECT_FALSE(region.inside(9, 2 + 1e-6));
}

TEST(Trim, LoopsWithinLoopsAlternate) {
  const TrimRegion rings({circle(5, 5, 4), circle(5, 5, 3), circle(5, 5, 2), circle(5, 5, 1)}, {0, 10, 0, 10});
  for (const double angle : {0.1, 1.7, 3.2, 5.9})
    for (const auto& [rho, in] : {std::pair(0.5, false), std::pair(1.5, true), std::pair(2.5, false),
                                  std::pair(3.5, true), std::pair(4.5, false)})
      EXPECT_EQ(rings.inside(5 + rho * std::cos(angle), 5 + rho * std::sin(angle)), in) << rho;
}

TEST(Trim, TheDirectionAndTheOrderOfLoopsDoNotMatter) {
  TrimLoop outer = circle(5, 5, 4), back = outer;
  BSplineCurve2& edge = back.edges[0];
  edge.poles = edge.poles.rowwise().reverse().eval();
  std::reverse(edge.weights.begin(), edge.weights.end());
  const ParameterRectangle r{0, 10, 0, 10};
  const TrimRegion a({outer, circle(4, 5, 1)}, r), b({circle(4, 5, 1), back}, r);
  Random random(3);
  for (int k = 0; k < 5000; ++k) {
    const double u = random.uniform(0, 10), v = random.uniform(0, 10);
    EXPECT_EQ(a.inside(u, v), b.inside(u, v));
  }
  EXPECT_NEAR(a.box().u0, b.box().u0, 1e-12);
}

/// Areas by counting: what is inside, and what cells that are inside or outside leave to those that are cut.
TEST(Trim, CutCellsHoldTheBorderAndNothingElse) {
  const TrimRegion region({circle(5, 5, 3)}, {0, 10, 0, 10});
  constexpr int kCells = 100;
  double inside = 0.0, cut = 0.0;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const ParameterRectangle cell{0.1 * i, 0.1 * (i + 1), 0.1 * j, 0.1 * (j + 1)};
      const TrimRegion::Side side = region.classify(cell);
      (side == TrimRegion::Side::kInside ? inside : cut) += side == TrimRegion::Side::kOutside ? 0.0 : 0.01;
      if (side != TrimRegion::Side::kCut) continue;
      const double near =
          std::hypot(std::max({cell.u0 - 5, 5 - cell.u1, 0.0}), std::max({cell.v0 - 5, 5 - cell.v1, 0.0}));
      const double far = std::hypot(std::max(std::abs(cell.u0 - 5), std::abs(cell.u1 - 5)),
                                    std::max(std::abs(cell.v0 - 5), std::abs(cell.v1 - 5)));
      EXPECT_LE(near, 3.0 + 1e-5);
      EXPECT_GE(far, 3.0 - 1e-5);
    }
  EXPECT_LT(inside, 9 * std::numbers::pi);
  EXPECT_GT(inside + cut, 9 * std::numbers::pi);
  EXPECT_LT(cut, 0.1 * 8 * 3 * 1.5) << "a line of cells";
}

TEST(Trim, WhatSticksOutOfTheRectangleIsClipped) {
  const TrimRegion region({circle(0, 5, 3)}, {0, 10, 0, 10});
  EXPECT_DOUBLE_EQ(region.box().u0, 0.0);
  EXPECT_NEAR(region.box().u1, 3.0, 1e-5);
  EXPECT_TRUE(region.inside(1, 5));
  EXPECT_FALSE(region.inside(-1, 5));
}

}  // namespace
}  // namespace flank::internal
