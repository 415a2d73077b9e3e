// A pass with sharp turns becomes pieces between which the tool leaves the part.
#include "flank/wheel/point/pass_strips.h"

#include <gtest/gtest.h>

#include "flank/path/turning.h"

namespace flank::internal {
namespace {

TEST(PassStrips, NoPieceBeginsWhereAnotherOneEnds) {
  const RadialFunction radial(ToolFamily::kCylinder, 8.0, Eigen::VectorXd::Constant(1, 1.5));
  // A staircase of four steps.
  Strip strip{.id = 1, .kind = "edge", .face = "F1", .poses = {}};
  Vec3 at = Vec3::Zero();
  for (int step = 0; step < 4; ++step)
    for (int k = 0; k < 8; ++k) {
      at += 0.5 * (step % 2 == 0 ? Vec3::UnitX() : Vec3::UnitY());
      strip.poses.push_back({at, Vec3::UnitZ()});
    }
  PointOptions options;
  std::vector<Strip> pieces;
  add_strip(strip, radial, options, pieces);
  ASSERT_GE(pieces.size(), 4U);
  double length = 0.0;
  for (const Strip& piece : pieces) {
    EXPECT_LE(sharpest_turn(piece.poses, 8.0, options.turn_window_mm).angle_rad, options.most_turn_rad);
    for (const Strip& other : pieces) EXPECT_GT((piece.poses.back().tip - other.poses.front().tip).norm(), 0.1);
    for (std::size_t k = 1; k < piece.poses.size(); ++k) length += (piece.poses[k].tip - piece.poses[k - 1].tip).norm();
  }
  EXPECT_GT(length, 0.7 * 15.5) << "only what is too short for a piece is left out";
}

/// Straight along x, each two places one mm apart, upright, with a kick of the axis in the middle.
Strip kicked() {
  Strip strip{.id = 1, .kind = "edge", .face = "F1", .poses = {}};
  for (int k = 0; k <= 40; ++k) {
    const Pose pose{{0.5 * k + (k == 20 ? 0.3 : 0.0), 0.0, 0.0},
                    Vec3(k < 20 ? 0.0 : 0.12, k == 20 ? 0.15 : 0.0, 1.0).normalized()};
    strip.poses.push_back(pose);
  }
  return strip;
}

TEST(PassStrips, AxesAreTurnedWhereTheyHaveRoom) {
  const RadialFunction radial(ToolFamily::kCylinder, 8.0, Eigen::VectorXd::Constant(1, 1.5));
  PointOptions options;
  options.turn_window_mm = 2.0;
  const FloorChannel nothing;
  Strip strip = kicked();
  ASSERT_GT(sharpest_turn(strip.poses, 8.0, options.turn_window_mm).angle_rad, 2.0 * options.most_turn_rad);
  steady(strip, TipRoom(nothing, radial, options), radial, options);
  EXPECT_LE(sharpest_turn(strip.poses, 8.0, options.turn_window_mm).angle_rad, options.most_turn_rad);
  for (std::size_t k = 0; k < strip.poses.size(); ++k) EXPECT_EQ(strip.poses[k].tip, kicked().poses[k].tip);
}

TEST(PassStrips, AxesThatHaveNoRoomStay) {
  const RadialFunction radial(ToolFamily::kCylinder, 8.0, Eigen::VectorXd::Constant(1, 1.5));
  PointOptions options;
  options.turn_window_mm = 2.0;
  options.held = {.up = Vec3::UnitX(), .most_rad = 0.1};  // no axis of the strip is held
  const FloorChannel nothing;
  Strip strip = kicked();
  steady(strip, TipRoom(nothing, radial, options), radial, options);
  for (std::size_t k = 0; k < strip.poses.size(); ++k) EXPECT_EQ(strip.poses[k].axis, kicked().poses[k].axis);
}

}  // namespace
}  // namespace flank::internal
