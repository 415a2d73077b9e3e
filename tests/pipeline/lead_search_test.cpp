// Ways out for a tool along a wall: those away from it, out of a lid in another direction, back where nothing else is left.
#include <gtest/gtest.h>

#include "flank/pipeline/folder/link_lift.h"

namespace flank::internal {
namespace {

constexpr double kTolerance = 0.01, kLift = 3.0;

// An upright cylinder of radius 2 along the wall y = 0 from x = -20 to 0. Another wall stands at x = 12.
struct Corner {
  Tool tool{RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 2.0)), "cylinder", {}, {}};
  Path strips;
  std::vector<FaceSamples> walls;
  LinkOptions links;

  Corner() {
    Strip strip{1, "flank", "F1", {}};
    for (int x = -20; x <= 0; x += 5) strip.poses.push_back({Vec3(x, 2, 0), Vec3::UnitZ()});
    strips.strips.push_back(strip);
    FaceSamples wall;
    for (int i = -30; i <= 30; i += 3)
      for (int j = 0; j <= 20; j += 3) {
        wall.points.emplace_back(i, 0.0, j);
        wall.points.emplace_back(12.0, i, j);
      }
    walls.push_back(wall);
    links.keep_out.add(Vec3(-30, -30, 0));
    links.keep_out.add(Vec3(30, 30, 40));
    links.tool_radius = 2.0;
  }
  /// A plate, or a bar, between two corners.
  void plate(double x0, double x1, double y0, double y1, double z0, double z1) {
    FaceSamples face;
    const auto steps = [](double a, double b) { return std::max(1, static_cast<int>((b - a) / 2.0)); };
    for (int i = 0; i <= steps(x0, x1); ++i)
      for (int j = 0; j <= steps(y0, y1); ++j)
        for (int k = 0; k <= steps(z0, z1); ++k)
          face.points.emplace_back(x0 + (x1 - x0) * i / steps(x0, x1), y0 + (y1 - y0) * j / steps(y0, y1),
                                   z0 + (z1 - z0) * k / steps(z0, z1));
    walls.push_back(face);
  }
  [[nodiscard]] LeadSearch search() const { return {tool, strips, walls, kLift, kTolerance, links}; }
  /// The least distance of the tool from the walls on the way out of an end, from where it has left the contact.
  [[nodiscard]] double least(std::size_t end, const Lead& lead) const {
    const std::vector<Pose>& poses = strips.strips[0].poses;
    std::vector<Pose> out = lead_out(end == 0 ? poses.front() : poses.back(), lead);
    const std::vector<Pose> rest = way_to_sphere(out.back(), lead, links);
    out.insert(out.end(), rest.begin() + 1, rest.end());
    Path path;
    path.strips.push_back({1, kLinkKind, "", std::move(out)});
    const SweptVolume volume(tool, path);
    double least = 1e300;
    for (const FaceSamples& face : walls)
      for (const Vec3& p : face.points) least = std::min(least, volume.distance(p).f);
    return least;
  }
};

TEST(LeadSearch, TheFirstLeadGoesOffTheWall) {
  const Corner corner;
  const LeadSearch search = corner.search();
  ASSERT_EQ(search.ends(), 2U);
  const Lead lead = search.lead(1);
  EXPECT_GT(lead.off.y(), 2.0);
  EXPECT_NEAR(lead.off.norm(), kLift, 1e-12);
  EXPECT_TRUE(lead.out.isZero()) << "along the axis";
  EXPECT_TRUE(lead.back.empty());
}

// A lid over the strip's end keeps the tool from leaving along its axis, on all places beside it.
TEST(LeadSearch, UnderALidTheToolLeavesInAnotherDirection) {
  Corner corner;
  corner.plate(-30, 11, 1, 9, 26, 26);
  const LeadSearch search = corner.search();
  for (const std::size_t end : {0U, 1U}) {
    const Lead& lead = search.lead(end);
    EXPECT_FALSE(lead.out.isZero());
    EXPECT_GE(corner.least(end, lead), -kTolerance);
  }
}

// A lane that bends, under a lid but at its beginning: out by the way it came.
TEST(LeadSearch, FromADeadEndTheToolGoesBackAlongItsStrip) {
  Corner lane;
  lane.walls.clear();
  Strip strip{1, "flank", "F1", {}};
  const auto at = [](double radius, double degrees, double z) {
    const double angle = degrees * M_PI / 180.0;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  for (int k = 0; k <= 60; k += 6) strip.poses.push_back({at(12.0, 2.0 * k, 0.0), Vec3::UnitZ()});
  lane.strips.strips = {strip};
  FaceSamples walls;
  for (int degrees = 0; degrees <= 134; degrees += 6) {
    for (int z = -3; z <= 23; z += 3)
      for (const double radius : {10.0, 17.0}) walls.points.push_back(at(radius, degrees, z));
    for (double radius = 10.0; radius <= 17.0 && degrees >= 30; radius += 1.0)
      walls.points.push_back(at(radius, degrees, 23.0));
  }
  for (double radius = 10.0; radius <= 17.0; radius += 1.0)
    for (int z = -3; z <= 23; z += 2) walls.points.push_back(at(radius, 134.0, z));
  lane.walls = {walls};
  const LeadSearch search = lane.search();
  EXPECT_TRUE(search.lead(0).back.empty());
  const Lead& lead = search.lead(1);
  ASSERT_GE(lead.back.size(), strip.poses.size());
  EXPECT_LT((lead.back.back().tip - strip.poses.front().tip).norm(), 8.0) << "at the other end";
  EXPECT_GE(lane.least(1, lead), -kTolerance);
}

// Closed all round: no way is free, and what is told of the best one is that it cuts.
TEST(LeadSearch, InAClosedBoxNoWayIsFree) {
  Corner corner;
  corner.plate(-24, 3, 0, 7, 23, 23);
  corner.plate(-24, 3, 7, 7, -3, 23);
  corner.plate(3, 3, 0, 7, -3, 23);
  corner.plate(-24, -24, 0, 7, -3, 23);
  corner.plate(-24, 3, 0, 7, -3, -3);
  LeadSearch search = corner.search();
  for (const std::size_t end : {0U, 1U})
    for (int k = 0; k < 4; ++k, (void)search.next(end)) EXPECT_LT(corner.least(end, search.lead(end)), -0.1);
}

TEST(LeadSearch, OthersFollowUntilThereIsNone) {
  const Corner corner;
  LeadSearch search = corner.search();
  const Lead first = search.lead(1);
  ASSERT_TRUE(search.next(1));
  const Lead second = search.lead(1);
  EXPECT_GT((first.off - second.off).norm() + (first.along.tip - second.along.tip).norm(), 1e-3);
  EXPECT_GT(second.off.y(), 0.0) << "the second best is off the wall too";
  int others = 2;
  while (search.next(1)) ++others;
  EXPECT_GT(others, 32) << "straight ways and some arcs";
  const Lead last = search.lead(1);
  EXPECT_FALSE(search.next(1));
  EXPECT_EQ(search.lead(1).off, last.off);
}

}  // namespace
}  // namespace flank::internal
