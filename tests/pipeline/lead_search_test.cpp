// Leads away from a wall, the farthest first, and what is left where they are refused.
#include <gtest/gtest.h>

#include "flank/pipeline/folder/link_lift.h"

namespace flank::internal {
namespace {

// An upright cylinder of radius 2 along the wall y = 0, at whose +x end it stops; another wall stands at x = 12.
struct Corner {
  Tool tool{RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 2.0)), "cylinder", {}, {}};
  std::vector<StripEnd> ends{{{Vec3(0, 2, 0), Vec3::UnitZ()}, Vec3::UnitX()}};
  std::vector<FaceSamples> walls;

  Corner() {
    FaceSamples wall;
    for (int i = -30; i <= 30; ++i)
      for (int j = 0; j <= 20; ++j) {
        wall.points.emplace_back(i, 0.0, j);
        wall.points.emplace_back(12.0, i, j);
      }
    walls.push_back(wall);
  }
};

TEST(LeadSearch, TheFirstLeadGoesOffTheWall) {
  const Corner corner;
  const LeadSearch search(corner.tool, corner.ends, corner.walls, 3.0, 50.0);
  ASSERT_EQ(search.ends(), 1U);
  const Lead lead = search.lead(0);
  EXPECT_GT(lead.off.y(), 2.0);
  EXPECT_NEAR(lead.off.norm(), 3.0, 1e-12);
}

TEST(LeadSearch, OthersFollowUntilThereIsNone) {
  const Corner corner;
  LeadSearch search(corner.tool, corner.ends, corner.walls, 3.0, 50.0);
  const Lead first = search.lead(0);
  ASSERT_TRUE(search.next(0));
  const Lead second = search.lead(0);
  EXPECT_GT((first.off - second.off).norm() + (first.along - second.along).norm(), 1e-3);
  EXPECT_GT(second.off.y(), 0.0) << "the second best is off the wall too";
  int others = 2;
  while (search.next(0)) ++others;
  EXPECT_GT(others, 32) << "straight ways and some arcs";
  const Lead last = search.lead(0);
  EXPECT_FALSE(search.next(0));
  EXPECT_EQ(search.lead(0).off, last.off);
}

}  // namespace
}  // namespace flank::internal
