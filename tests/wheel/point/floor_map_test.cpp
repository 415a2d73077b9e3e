// Where sides stand on the floor of a channel.
#include "flank/wheel/point/floor_map.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "flank/triangle_mesh.h"

namespace flank::internal {
namespace {

/// Triangles between rows of points, `round` to a row.
template <class Point>
TriangleMesh grid(int round, int rows, const Point& point) {
  TriangleMesh out;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i < round; ++i) out.vertices.push_back(point(i, j));
  const auto at = [&](int i, int j) { return j * round + i % round; };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < round; ++i) {
      out.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      out.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return out;
}

TEST(SideLine, OfAFaceAllRoundAVaneThePlacesCountThatLookIntoTheChannel) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const auto floor = make_target(grid(180, 20, [](int i, int j) {
    const double a = kTurn * i / 180.0, r = 40.0 - j;
    return Vec3(r * std::cos(a), r * std::sin(a), 0.0);
  }));
  // A pin of radius 3 mm, 30 mm from the axis of the floor.
  const auto pin = make_target(grid(72, 40, [](int i, int j) {
    const double a = kTurn * i / 72.0;
    return Vec3(30.0 + 3.0 * std::cos(a), 3.0 * std::sin(a), 0.5 * j);
  }));
  WheelAxis axis;
  const FloorMap map({floor.get()}, axis);
  const SideLine ahead({pin.get()}, {floor.get()}, map, 1.0), behind({pin.get()}, {floor.get()}, map, -1.0);
  ASSERT_FALSE(ahead.empty() || behind.empty());
  const double way = map.way(Vec3(30.0, 0.0, 0.0)), middle = map.angle(Vec3(30.0, 0.0, 0.0));
  EXPECT_NEAR(ahead.angle(way) - middle, 0.1, 0.01);
  EXPECT_NEAR(behind.angle(way) - middle, -0.1, 0.01);
}

}  // namespace
}  // namespace flank::internal
