// Starts laid over a flat target: along it where that is free, and as a cone that leans away from it where it is not.
#include "flank/fit/starts/start_tasks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/flat_scene.h"
#include "flank/fit/starts/upper_end.h"
#include "seed/sheet.h"

namespace flank::internal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A floor of 20 x 8 mm in a dish: only lines that rise by so much are free.
class InADish : public ::testing::Test {
 protected:
  std::unique_ptr<Target> floor_ = make_target({testing::rectangle(0.0, 0.0, 20.0, 8.0)});
  Chart chart_ = Chart(*floor_);
  RuledStart start_{.radius_mm = 6.0};
  FlankFitOptions options_;

  InADish() {
    options_.bounds.smallest = 0.5;
    options_.bounds.largest = 20.0;
  }
  void rises(double degrees) {
    options_.is_free_line = [=](const Vec3&, const Vec3& direction) {
      return direction.z() >= std::sin(degrees * kDegree);
    };
  }
  double unheld_share_of(const LaidStart& found) const { return unheld_share(found.tasks.front().motion, options_); }
  LaidStart laid(const ToolModel& tool = {}) const { return lay_start(*floor_, chart_, start_, tool, options_); }
};

TEST_F(InADish, AStartLiesAlongTheFaceWhereThatIsFree) {
  for (const bool asked : {false, true}) {
    if (asked) rises(-90.0);
    const LaidStart found = laid();
    ASSERT_EQ(found.tasks.size(), 1u);
    EXPECT_EQ(found.start.lean_rad, 0.0);
    EXPECT_EQ(found.start.radius_mm, 6.0);
  }
}

TEST_F(InADish, AFreeToolLeansAsLittleAsItMust) {
  options_.bounds.largest = 40.0;
  for (const double degrees : {10.0, 20.0, 40.0}) {
    rises(degrees);
    for (const bool swapped : {false, true}) {
      start_.swapped = swapped;
      const LaidStart found = laid();
      ASSERT_EQ(found.tasks.size(), 1u);
      EXPECT_GE(found.start.lean_rad, degrees * kDegree);
      EXPECT_LE(found.start.lean_rad, (degrees + 15.0) * kDegree);
      EXPECT_EQ(unheld_share_of(found), 0.0) << degrees;
    }
  }
}

TEST_F(InADish, ALeaningToolTouchesTheFaceAlongItsFlank) {
  rises(20.0);
  for (const double skew : {0.0, 0.2}) {
    start_.skew_rad = skew;
    const LaidStart found = laid();
    const RuledMotion& motion = found.tasks.front().motion;
    for (const double t : {0.0, 0.4, 1.0}) {
      const Pose pose = motion.pose(t);
      for (const double s : {0.0, 0.5 * motion.axis_length, motion.axis_length})
        EXPECT_NEAR(pose.at(s).z(), radius_at(found.start, s), 1e-6) << t << " " << s;
    }
  }
}

TEST_F(InADish, NoConeIsWiderOrThinnerThanTheBoundsAllow) {
  rises(40.0);
  options_.bounds.largest = 10.0;
  const LaidStart across = laid();  // 8 mm of contact, 45 degrees
  EXPECT_GE(across.start.radius_mm, options_.bounds.smallest);
  EXPECT_LE(radius_at(across.start, across.tasks.front().motion.axis_length), 1.05 * options_.bounds.largest);
  start_.swapped = true;  // 20 mm: such a cone would be wider
  EXPECT_EQ(laid().start.lean_rad, 0.0);
}

TEST_F(InADish, AGivenToolStaysAsItIs) {
  rises(20.0);
  ToolModel tool;
  tool.make = [](double length, double radius) {
    return RadialFunction(ToolFamily::kCylinder, length, Eigen::VectorXd::Constant(1, radius));
  };
  EXPECT_EQ(laid(tool).start.lean_rad, 0.0);
}

TEST_F(InADish, WhereNothingIsFreeAStartLiesAlongTheFace) {
  rises(91.0);
  EXPECT_EQ(laid().start.lean_rad, 0.0);
}

TEST_F(InADish, AShankInTheWayTakesMoreRoomThanALine) {
  // Walls before and behind the floor, 1 mm high: a line 6 mm above it passes over them, a thick shank does not.
  options_.is_free_line = [](const Vec3& from, const Vec3& direction) {
    const double wall = direction.y() > 0.0 ? 10.0 : -2.0, way = (wall - from.y()) / direction.y();
    return from.z() + way * direction.z() >= 1.0;
  };
  EXPECT_EQ(laid().start.lean_rad, 0.0);
  options_.bounds.shank_in_the_way = true;
  options_.bounds.shank_radius = 5.9;
  const LaidStart found = laid();
  EXPECT_GT(found.start.lean_rad, 0.0);
  EXPECT_EQ(unheld_share_of(found), 0.0);
}

}  // namespace
}  // namespace flank::internal
