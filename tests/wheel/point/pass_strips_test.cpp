// A pass with sharp turns becomes pieces between which the tool leaves the part.
#include "flank/wheel/point/pass_strips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

/// A bend of a millimetre, in poses a hundredth of a millimetre apart: from any of them on it turns as sharply.
TEST(PassStrips, ATurnOverSomeWayIsLeftOutAtOnce) {
  const RadialFunction radial(ToolFamily::kCylinder, 8.0, Eigen::VectorXd::Constant(1, 1.5));
  Strip strip{.id = 1, .kind = "edge", .face = "F1", .poses = {}};
  Vec3 at = Vec3::Zero();
  for (int k = 0; k < 1000; ++k) {
    const double angle = 0.6 * std::clamp((k - 450) / 100.0, 0.0, 1.0);
    at += 0.01 * Vec3(std::cos(angle), std::sin(angle), 0.0);
    strip.poses.push_back({at, Vec3::UnitZ()});
  }
  PointOptions options;
  std::vector<Strip> pieces;
  add_strip(strip, radial, options, pieces);
  ASSERT_EQ(pieces.size(), 2U);
  for (const Strip& piece : pieces) {
    EXPECT_LE(sharpest_turn(piece.poses, 8.0, options.turn_window_mm).angle_rad, options.most_turn_rad);
    EXPECT_GT(piece.poses.size(), 430U);
  }
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
  const TipRoom room(nothing, radial, options);
  steady(
      strip, [&](std::size_t, const Pose& pose) { return room.is_free(pose); }, radial, options);
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
  const TipRoom room(nothing, radial, options);
  steady(
      strip, [&](std::size_t, const Pose& pose) { return room.is_free(pose); }, radial, options);
  for (std::size_t k = 0; k < strip.poses.size(); ++k) EXPECT_EQ(strip.poses[k].axis, kicked().poses[k].axis);
}

/// An arc with a kink, in steps that are far shorter than joining straight asks for.
TEST(PassStrips, ThinnedStripsStayBesideWhatTheyWere) {
  constexpr double kChord = 0.015, kUp = 10.0;
  Strip strip{.id = 4, .kind = "rough", .face = "F1", .poses = {}};
  strip.layer = 3;
  for (int k = 0; k <= 300; ++k) {
    const double a = 0.005 * k;
    strip.poses.push_back({Vec3(30.0 * std::sin(a), 30.0 * std::cos(a), k > 150 ? 0.05 * (k - 150) : 0.0),
                           Vec3(0.2 * std::sin(2.0 * a), 0.1, 1.0).normalized()});
  }
  const Strip thin = thinned(strip, kUp, kChord);
  EXPECT_EQ(thin.id, 4);
  EXPECT_EQ(thin.layer, 3);
  EXPECT_EQ(thin.poses.front().tip, strip.poses.front().tip);
  EXPECT_EQ(thin.poses.back().tip, strip.poses.back().tip);
  EXPECT_LT(thin.poses.size(), strip.poses.size() / 4);
  for (const Pose& pose : strip.poses) {
    double least = 1e300;
    for (std::size_t k = 0; k + 1 < thin.poses.size(); ++k) {
      // The nearest place of the chord, of tip and upper end together.
      const Pose &a = thin.poses[k], &b = thin.poses[k + 1];
      const Vec3 tip = b.tip - a.tip, top = b.at(kUp) - a.at(kUp), here = pose.tip - a.tip,
                 above = pose.at(kUp) - a.at(kUp);
      const double share = (here.dot(tip) + above.dot(top)) / (tip.squaredNorm() + top.squaredNorm()),
                   at = std::clamp(share, 0.0, 1.0);
      least = std::min(least, std::max((here - at * tip).norm(), (above - at * top).norm()));
    }
    EXPECT_LE(least, kChord);
  }
  strip.poses.resize(2);
  EXPECT_EQ(thinned(strip, kUp, kChord).poses.size(), 2U);
}

}  // namespace
}  // namespace flank::internal
