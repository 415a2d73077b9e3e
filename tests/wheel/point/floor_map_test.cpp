// Where sides stand on the floor of a channel, and the lines that passes run beside there.
#include "flank/wheel/point/floor_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "flank/triangle_mesh.h"
#include "flank/wheel/point/gentle_line.h"

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

constexpr double kTurn = 2.0 * std::numbers::pi;

/// A ring from 20 to 40 mm round the z axis, with a pin of radius 3 mm on it, 30 mm from the axis.
struct PinOnARing {
  std::unique_ptr<Target> floor = make_target(grid(180, 20, [](int i, int j) {
    const double a = kTurn * i / 180.0, r = 40.0 - j;
    return Vec3(r * std::cos(a), r * std::sin(a), 0.0);
  }));
  std::unique_ptr<Target> pin = make_target(grid(72, 40, [](int i, int j) {
    const double a = kTurn * i / 72.0;
    return Vec3(30.0 + 3.0 * std::cos(a), 3.0 * std::sin(a), 0.5 * j);
  }));
  FloorMap map{{floor.get()}, WheelAxis()};
  SideLine ahead{{pin.get()}, {floor.get()}, map, 1.0}, behind{{pin.get()}, {floor.get()}, map, -1.0};
};

TEST(SideLine, OfAFaceAllRoundAVaneThePlacesCountThatLookIntoTheChannel) {
  const PinOnARing ring;
  ASSERT_FALSE(ring.ahead.empty() || ring.behind.empty());
  const double way = ring.map.way(Vec3(30.0, 0.0, 0.0)), middle = ring.map.angle(Vec3(30.0, 0.0, 0.0));
  EXPECT_NEAR(ring.ahead.angle(way) - middle, 0.1, 0.01);
  EXPECT_NEAR(ring.behind.angle(way) - middle, -0.1, 0.01);
}

/// 1/mm, of a line over a ring: the most of all places.
double bend_of(const GentleLine& line, const FloorMap& map) {
  double most = 0.0;
  for (double way = 1.0; way <= map.length() - 1.0; way += 0.25) {
    const double second = line.angle(way - 0.5) - 2.0 * line.angle(way) + line.angle(way + 0.5);
    most = std::max(most, std::abs(second) * map.radius(way) / 0.25);
  }
  return most;
}

TEST(GentleLine, BendsRoundAPinNoMoreThanAPassMayTurn) {
  const PinOnARing ring;
  const GentleLine sharp(ring.ahead, ring.behind, ring.map, 0.0);
  EXPECT_GT(bend_of(sharp, ring.map), 0.3) << "of a pin of 3 mm";
  for (const double radius : {5.0, 9.0, 20.0}) {
    const GentleLine line(ring.ahead, ring.behind, ring.map, radius);
    EXPECT_LE(bend_of(line, ring.map) * radius, 1.01);
    const double way = ring.map.way(Vec3(30.0, 0.0, 0.0));
    EXPECT_GT(line.angle(way), line.angle(way + 9.0)) << "it still goes round on its side of the pin";
    EXPECT_GT(line.off(way) * 30.0, 0.2) << "and says how far it is from the pin's foot";
    EXPECT_LT(line.off(way) * 30.0, 3.0);
  }
}

TEST(GentleLine, OfAStraightWallIsTheWall) {
  const PinOnARing ring;
  const auto wall = make_target(grid(2, 40, [](int i, int j) { return Vec3(21.0 + 0.45 * j, 2.0, 8.0 * i); }));
  const SideLine line({wall.get()}, {ring.floor.get()}, ring.map, 1.0);
  ASSERT_FALSE(line.empty());
  const GentleLine gentle(line, line, ring.map, 5.0);
  for (double way = line.from() + 1.0; way < line.to() - 1.0; way += 0.5)
    EXPECT_LT(gentle.off(way) * ring.map.radius(way), 0.05) << way;
}

}  // namespace
}  // namespace flank::internal
