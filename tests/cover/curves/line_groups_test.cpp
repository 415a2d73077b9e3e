// Lines of a known motion, in any order: one group, in the order of the motion.
#include "flank/cover/curves/line_groups.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cover/cover_targets.h"
#include "flank/base/random.h"
#include "flank/cover/curves/line_clusters.h"

namespace flank::internal {
namespace {

struct Shuffled {
  std::vector<StraightLine> lines;
  std::vector<double> t;
};

/// Poses of the exact motion at `count` times in a random order, with their velocities in a random sense.
Shuffled shuffled(const testing::LongSurface& surface, int count) {
  Random random(4);
  Shuffled out;
  for (int k = 0; k < count; ++k) out.t.push_back((k + 0.8 * random.uniform()) / count);
  for (std::size_t k = out.t.size(); k > 1; --k)
    std::swap(out.t[k - 1], out.t[static_cast<std::size_t>(random.uniform() * static_cast<double>(k))]);
  for (const double t : out.t) {
    StraightLine line;
    line.pose = surface.pose(t);
    line.error_mm = random.uniform();
    line.velocity =
        movability(*surface.exact.target, line.pose, surface.tool.axis_length(), 24, MovabilityOptions{}).velocity;
    if (random.uniform() < 0.5) line.velocity = {-line.velocity.middle, -line.velocity.omega};
    out.lines.push_back(line);
  }
  return out;
}

bool in_order(const LineGroup& group, const std::vector<double>& t) {
  std::vector<double> times;
  for (const int k : group.lines) times.push_back(t[static_cast<std::size_t>(k)]);
  return std::is_sorted(times.begin(), times.end()) || std::is_sorted(times.rbegin(), times.rend());
}

TEST(GroupLines, FollowTheMotion) {
  const testing::LongSurface surface;
  const Shuffled scene = shuffled(surface, 30);
  const std::vector<LineGroup> groups = group_lines(scene.lines, surface.tool.axis_length(), {});
  ASSERT_FALSE(groups.empty());
  for (const LineGroup& group : groups) {
    EXPECT_EQ(group.lines.size(), group.poses.size());
    EXPECT_TRUE(in_order(group, scene.t));
  }
  EXPECT_EQ(groups.front().lines.size(), 30u);
}

TEST(GroupLines, TurnsLinesRoundWhereEndsAreAlike) {
  const testing::LongSurface surface;
  const double length = surface.tool.axis_length();
  Shuffled scene = shuffled(surface, 30);
  for (std::size_t k = 0; k < scene.lines.size(); k += 3) {
    scene.lines[k].pose = turned_round(scene.lines[k].pose, length);
    scene.lines[k].velocity.omega = -scene.lines[k].velocity.omega;
  }
  LineGroupOptions options;
  options.ends_alike = true;
  const std::vector<LineGroup> groups = group_lines(scene.lines, length, options);
  ASSERT_FALSE(groups.empty());
  EXPECT_EQ(groups.front().lines.size(), 30u);
  EXPECT_TRUE(in_order(groups.front(), scene.t));
  for (const Pose& pose : groups.front().poses) EXPECT_GT(pose.axis.dot(groups.front().poses.front().axis), 0.5);
  options.ends_alike = false;
  for (const LineGroup& group : group_lines(scene.lines, length, options)) EXPECT_LT(group.lines.size(), 30u);
}

TEST(GroupLines, TwoRowsAreTwoGroups) {
  // Lines one beside the other along x, in two rows: no line of a row lies where a line of the other can move to.
  std::vector<StraightLine> lines;
  for (int k = 0; k < 10; ++k) {
    for (const double y : {0.0, 14.0}) {
      StraightLine line;
      line.pose = {Vec3(2.0 * k, y, 4.0), Vec3::UnitY()};
      line.velocity.middle = Vec3::UnitX();
      lines.push_back(line);
    }
  }
  const std::vector<LineGroup> groups = group_lines(lines, 12.0, {});
  ASSERT_GE(groups.size(), 2u);
  for (const LineGroup& group : groups) {
    EXPECT_EQ(group.lines.size(), 10u);
    for (const int k : group.lines) EXPECT_EQ(k % 2, group.lines.front() % 2);
  }
  EXPECT_TRUE(group_lines({lines.front()}, 12.0, {}).empty());
}

}  // namespace
}  // namespace flank::internal
