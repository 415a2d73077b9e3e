#include "flank/geom/stray_pole.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

/// A net of a face 100 mm long, bent in both directions, with uneven rows.
BSplineSurface bent_net(int count_u, int count_v) {
  BSplineSurface net;
  net.count_u = count_u;
  net.count_v = count_v;
  for (int i = 0; i < count_u; ++i)
    for (int j = 0; j < count_v; ++j) {
      const double x = 100.0 * std::pow(i / (count_u - 1.0), 1.5), y = 40.0 * j / (count_v - 1.0);
      net.poles.emplace_back(x, y, 10.0 * std::sin(0.03 * x) + 5.0 * std::cos(0.05 * y));
    }
  return net;
}

TEST(StrayPole, IsFoundWhereverItIsAndWhicheverWay) {
  Random random(7);
  for (int trial = 0; trial < 200; ++trial) {
    BSplineSurface net = bent_net(8 + trial % 9, 4 + trial % 5);
    ASSERT_FALSE(stray_pole(net)) << trial;
    const int i = static_cast<int>(random.uniform() * net.count_u),
              j = static_cast<int>(random.uniform() * net.count_v);
    // Across the face: along it a control point may lie unevenly.
    net.pole(i, j).z() += trial % 2 == 0 ? 60.0 : -60.0;
    const auto stray = stray_pole(net);
    ASSERT_TRUE(stray) << trial;
    EXPECT_EQ(stray->u, i);
    EXPECT_EQ(stray->v, j);
  }
}

TEST(StrayPole, IsNoneWhereALineOfThemBends) {
  for (const int row : {0, 3, 9}) {
    BSplineSurface net = bent_net(10, 6);
    for (int j = 0; j < 6; ++j) net.pole(row, j).z() += 15.0;
    EXPECT_FALSE(stray_pole(net)) << row;
  }
}

TEST(StrayPole, IsNoneOfTooFewOrOfRationalOnes) {
  BSplineSurface net = bent_net(8, 3);
  net.pole(3, 1).z() += 60.0;
  EXPECT_FALSE(stray_pole(net));
  net = bent_net(8, 5);
  net.weights.assign(40, 1.0);
  net.pole(3, 1).z() += 60.0;
  EXPECT_FALSE(stray_pole(net));
}

/// Weights of a band of arcs: those of all its columns alike.
BSplineSurface arcs(int count_u, int count_v) {
  BSplineSurface net = bent_net(count_u, count_v);
  for (int i = 0; i < count_u; ++i)
    for (int j = 0; j < count_v; ++j) net.weights.push_back(i % 2 == 0 ? 1.0 : std::sqrt(0.5));
  return net;
}

TEST(StrayWeight, IsFoundWhereverItIs) {
  for (const double factor : {15.0, 1.0 / 15.0, 3.0})
    for (int i = 0; i < 9; ++i)
      for (int j = 0; j < 5; ++j) {
        BSplineSurface net = arcs(9, 5);
        ASSERT_FALSE(stray_weight(net));
        net.weights[static_cast<std::size_t>(i * 5 + j)] *= factor;
        const auto stray = stray_weight(net);
        ASSERT_TRUE(stray) << i << " " << j << " " << factor;
        EXPECT_EQ(stray->u, i);
        EXPECT_EQ(stray->v, j);
      }
}

TEST(StrayCurveWeight, IsNoArc) {
  const double root = std::sqrt(0.5);
  EXPECT_EQ(stray_curve_weight({}), 0.0);
  EXPECT_EQ(stray_curve_weight({1.0, 1.0, root, 1.0, 1.0}), 0.0);
  EXPECT_EQ(stray_curve_weight({1.0, 0.5, 1.0, 0.5, 1.0, 0.5, 1.0}), 0.0);
  for (const double factor : {406.0, 15.0, 1.0 / 15.0})
    for (int k = 0; k < 7; ++k) {
      std::vector<double> weights(7, 1.0);
      weights[static_cast<std::size_t>(k)] = factor;
      EXPECT_NEAR(stray_curve_weight(weights), std::max(factor, 1.0 / factor), 1e-9) << k;
    }
}

TEST(StrayWeight, IsNoneOfEvenOnesAndOfNone) {
  BSplineSurface net = bent_net(6, 6);
  EXPECT_FALSE(stray_weight(net));
  net.weights.assign(36, 2.0);
  EXPECT_FALSE(stray_weight(net));
}

}  // namespace
}  // namespace flank::internal
