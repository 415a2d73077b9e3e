// Tours of walls in a row: exact on planes and cones, round outer corners, up to inner ones, in levels.
#include "flank/tour/tour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/path/turning.h"
#include "flank/tour/chain.h"
#include "tour/walls.h"

namespace flank::internal {
namespace {

using testing::Ring;
using testing::walls_of;

constexpr double kRadius = 5.0, kTolerance = 0.005;

TourRequest request_of(std::vector<Face> walls, std::optional<double> length = {}) {
  TourRequest request;
  request.walls = std::move(walls);
  request.tool = [](double axis_length) {
    return RadialFunction(ToolFamily::kCylinder, axis_length, Eigen::VectorXd::Constant(1, kRadius));
  };
  request.axis_length_mm = length;
  request.tolerance_mm = kTolerance;
  return request;
}

/// Signed distance of the flank from the faces over the motion, mm: the least of all, and the largest at any time of the nearest
/// place.
struct Nearness {
  double deepest = 1e300, loosest = 0.0;
};

Nearness nearness(const std::vector<Face>& faces, const RuledMotion& motion, double radius) {
  const auto target = make_target(faces);
  constexpr int kTimes = 400, kPlaces = 24;
  Nearness found;
  for (int i = 0; i <= kTimes; ++i) {
    const Pose pose = motion.pose(static_cast<double>(i) / kTimes);
    double nearest = 1e300;
    for (int k = 0; k <= kPlaces; ++k) {
      const Footpoint foot = target->closest(pose.at(motion.axis_length * k / kPlaces));
      nearest = std::min(nearest, foot.distance - radius);
    }
    found.deepest = std::min(found.deepest, nearest);
    found.loosest = std::max(found.loosest, nearest);
  }
  return found;
}

/// By how much the axis turns about z, degrees, and the range of its tilt.
struct Turning {
  double about_z = 0.0, least_tilt = 1e300, most_tilt = 0.0;
};

Turning turning_of(const RuledMotion& motion) {
  constexpr int kTimes = 2000;
  Turning turning;
  double before = 0.0;
  for (int i = 0; i <= kTimes; ++i) {
    const Vec3 axis = motion.pose(static_cast<double>(i) / kTimes).axis;
    const double tilt = std::acos(axis.z()) * 180.0 / std::numbers::pi;
    turning.least_tilt = std::min(turning.least_tilt, tilt);
    turning.most_tilt = std::max(turning.most_tilt, tilt);
    const double angle = std::atan2(axis.y(), axis.x()) * 180.0 / std::numbers::pi;
    if (i > 0) turning.about_z += std::remainder(angle - before, 360.0);
    before = angle;
  }
  return turning;
}

/// Of the tip about the middle, degrees: positive is counter-clockwise from above.
double way_round(const RuledMotion& motion) {
  constexpr int kTimes = 2000;
  double round = 0.0;
  for (int i = 1; i <= kTimes; ++i) {
    const Vec3 a = motion.pose((i - 1.0) / kTimes).tip, b = motion.pose(static_cast<double>(i) / kTimes).tip;
    round += std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
  }
  return round * 180.0 / std::numbers::pi;
}

bool says(const Tour& tour, const std::string& words) {
  return std::any_of(tour.notes.begin(), tour.notes.end(),
                     [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

TEST(Tour, GoesRoundADraftedPocketInOneMotionThatTouchesAllTheTime) {
  const std::vector<Face> walls = walls_of({});
  const std::optional<Tour> tour = make_tour(request_of(walls));
  ASSERT_TRUE(tour);
  EXPECT_TRUE(tour->closed);
  ASSERT_EQ(tour->motions.size(), 1U);
  EXPECT_NEAR(tour->twist_rad, 0.0, 1e-9);
  const Nearness near = nearness(walls, tour->motions[0], kRadius);
  EXPECT_GT(near.deepest, -1e-4);
  EXPECT_LT(near.loosest, 1e-4);
  const Turning turning = turning_of(tour->motions[0]);
  EXPECT_NEAR(turning.about_z, 360.0, 1e-6);
  EXPECT_NEAR(turning.least_tilt, 10.0, 1e-4);
  EXPECT_NEAR(turning.most_tilt, 10.0, 1e-4);
  EXPECT_GT(tour->motions[0].pose(0.0).axis.z(), 0.9) << "the holder is above";
  EXPECT_NEAR((tour->motions[0].pose(0.0).tip - tour->motions[0].pose(1.0).tip).norm(), 0.0, 1e-9);
  EXPECT_GT(way_round(tour->motions[0]), 359.0) << "inside, a tool that climbs goes counter-clockwise";
}

TEST(Tour, BeginsToTurnBesideARoundWallWithoutAKink) {
  const std::optional<Tour> tour = make_tour(request_of(walls_of({})));
  ASSERT_TRUE(tour);
  constexpr double kWindow = 0.5, kDegree = std::numbers::pi / 180.0;
  std::vector<Pose> poses;
  for (int k = 0; k <= 3000; ++k) poses.push_back(tour->motions[0].pose(k / 3000.0));
  EXPECT_LT(sharpest_turn(poses, tour->tool.axis_length(), kWindow).angle_rad, 10.0 * kDegree);
}

TEST(Tour, GoesRoundABossTheOtherWay) {
  const std::vector<Face> walls = walls_of({.hollow = false});
  const std::optional<Tour> tour = make_tour(request_of(walls));
  ASSERT_TRUE(tour && tour->closed);
  const Nearness near = nearness(walls, tour->motions[0], kRadius);
  EXPECT_GT(near.deepest, -1e-4);
  EXPECT_LT(near.loosest, 1e-4);
  EXPECT_LT(way_round(tour->motions[0]), -359.0);
}

TEST(Tour, RollsAboutSharpOuterCorners) {
  const std::vector<Face> walls = walls_of({.half_x = 20, .half_y = 12, .corner = 0.0, .hollow = false});
  const std::optional<Tour> tour = make_tour(request_of(walls));
  ASSERT_TRUE(tour && tour->closed);
  ASSERT_EQ(tour->motions.size(), 1U);
  const Nearness near = nearness(walls, tour->motions[0], kRadius);
  EXPECT_GT(near.deepest, -1e-4);
  EXPECT_LT(near.loosest, 1e-4) << "it stays on the edge";
}

TEST(Tour, LeavesSharpInnerCornersAndNamesThem) {
  const std::vector<Face> walls = walls_of({.corner = 0.0});
  const std::optional<Tour> tour = make_tour(request_of(walls));
  ASSERT_TRUE(tour);
  EXPECT_FALSE(tour->closed);
  ASSERT_EQ(tour->motions.size(), 4U);
  for (const RuledMotion& motion : tour->motions) {
    const Nearness near = nearness(walls, motion, kRadius);
    EXPECT_GT(near.deepest, -1e-4) << "a neighbour is cut";
    EXPECT_LT(near.loosest, 1e-4);
    for (const double t : {0.0, 1.0}) {
      // At both ends it lies along the corner, against both walls.
      const Vec3 axis = motion.pose(t).axis;
      EXPECT_NEAR(axis.z(), 1.0 / std::sqrt(1.0 + 2.0 * std::pow(std::tan(testing::kDraft), 2)), 1e-6);
    }
  }
  EXPECT_TRUE(says(*tour, "between P0 and P1 is left")) << tour->notes[0];
  EXPECT_EQ(std::count_if(tour->notes.begin(), tour->notes.end(),
                          [](const std::string& note) { return note.find("inner corner") != std::string::npos; }),
            4);
}

TEST(Tour, LeavesARoundCornerThatIsTighterThanTheTool) {
  const std::vector<Face> walls = walls_of({.corner = 3.0});
  const std::optional<Tour> tour = make_tour(request_of(walls));
  ASSERT_TRUE(tour);
  EXPECT_EQ(tour->motions.size(), 4U);
  EXPECT_TRUE(says(*tour, "C0 is not machined"));
  for (const RuledMotion& motion : tour->motions) EXPECT_GT(nearness(walls, motion, kRadius).deepest, -1e-4);
}

TEST(Tour, OfAConeTouchesWithItsFlank) {
  const std::vector<Face> walls = walls_of({.corner = 9.0});
  TourRequest request = request_of(walls);
  constexpr double kSlope = 0.05;
  request.tool = [](double axis_length) {
    return RadialFunction(ToolFamily::kCone, axis_length, Eigen::Vector2d(4.0, std::asin(kSlope)));
  };
  const std::optional<Tour> tour = make_tour(request);
  ASSERT_TRUE(tour && tour->closed);
  const RuledMotion& motion = tour->motions[0];
  const auto target = make_target(walls);
  for (const double t : {0.0, 0.13, 0.29, 0.4, 0.77, 0.9})
    for (const double s : {2.0, 9.0, 17.0}) {
      const Footpoint foot = target->closest(motion.pose(t).at(s));
      EXPECT_NEAR(foot.distance, 4.0 + kSlope * s, 1e-4) << "t " << t << ", s " << s;
    }
}

TEST(Tour, OfAShortToolGoesRoundInLevelsWithoutALift) {
  const std::vector<Face> walls = walls_of({.hollow = false});
  const std::optional<Tour> tour = make_tour(request_of(walls, 12.0));
  ASSERT_TRUE(tour && tour->closed);
  EXPECT_EQ(tour->levels, 2);
  ASSERT_EQ(tour->motions.size(), 1U);
  const RuledMotion& motion = tour->motions[0];
  const Nearness near = nearness(walls, motion, kRadius);
  EXPECT_GT(near.deepest, -1e-4);
  EXPECT_LT(near.loosest, 1e-4);
  EXPECT_LT(way_round(motion), -719.0);
  // From above the heads down to the feet, and never along the axis.
  EXPECT_GT(motion.pose(0.0).at(12.0).z(), testing::kHeight);
  EXPECT_LT(motion.pose(1.0).tip.z(), kRadius * std::sin(testing::kDraft) + 1e-3);
  for (int k = 0; k <= 200; ++k) {
    const AxisJet jet = motion.jet(k / 200.0);
    EXPECT_LT(std::abs(jet.tip_d1.dot(jet.u)), 0.5 * jet.tip_d1.norm());
  }
}

TEST(Tour, OfAnOpenRowEndsAtItsEnds) {
  std::vector<Face> walls = walls_of({});
  walls = {walls[0], walls[4], walls[1]};
  const std::optional<Tour> tour = make_tour(request_of(walls));
  ASSERT_TRUE(tour);
  EXPECT_FALSE(tour->closed);
  ASSERT_EQ(tour->motions.size(), 1U);
  const Nearness near = nearness(walls, tour->motions[0], kRadius);
  EXPECT_GT(near.deepest, -1e-4);
  EXPECT_LT(near.loosest, 1e-4);
}

TEST(Tour, NeedsWallsInARowAndAStraightMeridian) {
  std::vector<Face> walls = walls_of({});
  std::vector<Face> apart = {walls[0], walls[2]};
  EXPECT_FALSE(make_tour(request_of(apart)));
  EXPECT_FALSE(make_tour(request_of({walls[0]})));
  TourRequest barrel = request_of(walls);
  barrel.tool = [](double axis_length) {
    return RadialFunction(ToolFamily::kBarrel, axis_length, Eigen::Vector3d(80.0, 5.0, 0.5 * axis_length));
  };
  EXPECT_FALSE(make_tour(barrel));
}

}  // namespace
}  // namespace flank::internal
