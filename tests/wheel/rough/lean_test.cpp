// Beside a side that leans the axis leans as it does, and nowhere else.
#include "flank/wheel/rough/lean.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "flank/geom/tessellate.h"
#include "verify/faces.h"

namespace flank::internal {
namespace {

constexpr double kLength = 20.0, kHeight = 12.0, kTip = 1.0, kAway = 5.0;

/// A side along x that leans outwards from y = 5, by an angle from the vertical; before y = 0 there is air.
struct Side {
  explicit Side(double lean) {
    Face face;
    BSplineSurface& s = face.surface;
    s.degree_u = s.degree_v = 1;
    s.count_u = s.count_v = 2;
    s.knots_u = s.knots_v = {0.0, 0.0, 1.0, 1.0};
    const Vec3 corner(0.0, kAway, -kHeight), up = 2.0 * kHeight * Vec3(0.0, std::tan(lean), 1.0),
                                             along = kLength * Vec3::UnitX();
    const Vec3 low = corner - kHeight * Vec3(0.0, std::tan(lean), 0.0);
    s.poles = {low, low + up, low + along, low + along + up};
    target = make_target({face});
    channel.walls = {target.get()};
  }
  std::unique_ptr<Target> target;
  FloorChannel channel;
  RadialFunction radial{ToolFamily::kCylinder, 6.0, Eigen::VectorXd::Constant(1, kTip)};
  PointOptions options;
};

/// Places from y = 0 to beside the side, upright.
std::vector<std::vector<Pose>> upright() {
  std::vector<std::vector<Pose>> rows;
  for (double x = 4.0; x <= kLength - 4.0; x += 0.5) {
    rows.emplace_back();
    for (int c = 0; c <= 16; ++c) rows.back().push_back({Vec3(x, c / 16.0 * (kAway - kTip - 0.1), 0.0), Vec3::UnitZ()});
  }
  return rows;
}

double lean_of(const Pose& pose) { return std::atan2(pose.axis.y(), pose.axis.z()); }

TEST(Lean, TheFlankComesToASideThatLeansAway) {
  constexpr double kLean = 0.25;
  const Side side(kLean);
  const TipRoom room(side.channel, side.radial, side.options);
  std::vector<std::vector<Pose>> rows = upright();
  lean_to_sides(rows, room);
  for (const std::vector<Pose>& row : rows) {
    EXPECT_NEAR(lean_of(row.back()), kLean, 0.05) << row.back().tip.x();
    EXPECT_NEAR(lean_of(row.front()), 0.0, 0.02) << "no side is there";
    for (std::size_t c = 1; c < row.size(); ++c) {
      EXPECT_TRUE(room.is_free(row[c]));
      EXPECT_LT(lean_of(row[c]) - lean_of(row[c - 1]), 0.1) << "the axes of neighbours differ slowly";
      EXPECT_GT(lean_of(row[c]) - lean_of(row[c - 1]), -1e-6);
    }
  }
}

TEST(Lean, AnUprightSideLeavesAxesUpright) {
  const Side side(0.0);
  const TipRoom room(side.channel, side.radial, side.options);
  std::vector<std::vector<Pose>> rows = upright();
  lean_to_sides(rows, room);
  for (const std::vector<Pose>& row : rows)
    for (const Pose& pose : row) EXPECT_NEAR(lean_of(pose), 0.0, 0.03);
}

}  // namespace
}  // namespace flank::internal
