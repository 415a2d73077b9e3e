// k-means of lines: the metric, bunches found, and the same answer every time.
#include "flank/cover/curves/line_clusters.h"

#include <gtest/gtest.h>

#include <set>

#include "flank/base/random.h"
#include "flank/threads.h"

namespace flank::internal {
namespace {

constexpr double kLength = 20.0;

Pose random_line(Random& random, const Vec3& middle, const Vec3& axis, double spread) {
  const auto noise = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
  const Vec3 u = (axis + spread / kLength * noise()).normalized();
  return {middle + spread * noise() - 0.5 * kLength * u, u};
}

TEST(LineDistance, IsTheMeanOverTheAxis) {
  Random random(1);
  for (int k = 0; k < 20; ++k) {
    const Pose a = random_line(random, Vec3::Zero(), Vec3::UnitZ(), 5.0);
    const Pose b = random_line(random, Vec3::Zero(), Vec3::UnitX(), 5.0);
    double sum = 0.0;
    constexpr int kSteps = 2000;
    for (int j = 0; j < kSteps; ++j) {
      const double s = (j + 0.5) / kSteps * kLength;
      sum += (a.at(s) - b.at(s)).squaredNorm() / kSteps;
    }
    EXPECT_NEAR(squared_line_distance(a, b, kLength), sum, 1e-6 * sum);
    EXPECT_NEAR(squared_line_distance(a, turned_round(turned_round(a, kLength), kLength), kLength), 0.0, 1e-20);
  }
}

/// Bunches of 30 lines each, apart in place or in direction.
std::vector<Pose> bunches() {
  Random random(5);
  std::vector<Pose> lines;
  for (int k = 0; k < 30; ++k) {
    lines.push_back(random_line(random, Vec3::Zero(), Vec3::UnitZ(), 0.2));
    lines.push_back(random_line(random, Vec3::Zero(), Vec3::UnitX(), 0.2));
    lines.push_back(random_line(random, Vec3(30.0, 0.0, 0.0), Vec3::UnitZ(), 0.2));
  }
  return lines;
}

TEST(ClusterLines, FindsBunches) {
  const std::vector<Pose> lines = bunches();
  LineClusterOptions options;
  options.clusters = 3;
  const LineClusters found = cluster_lines(lines, kLength, options);
  ASSERT_EQ(found.representatives.size(), 3u);
  for (std::size_t k = 0; k < lines.size(); ++k) EXPECT_EQ(found.cluster[k], found.cluster[k % 3]);
  EXPECT_EQ(std::set<int>(found.cluster.begin(), found.cluster.begin() + 3).size(), 3u);
  for (int c = 0; c < 3; ++c)
    EXPECT_EQ(found.cluster[static_cast<std::size_t>(found.representatives[static_cast<std::size_t>(c)])], c);
}

TEST(ClusterLines, TurnedRoundIsTheSameWhereEndsAreAlike) {
  std::vector<Pose> lines = bunches();
  for (std::size_t k = 0; k < lines.size(); k += 2) lines[k] = turned_round(lines[k], kLength);
  LineClusterOptions options;
  options.clusters = 3;
  options.ends_alike = true;
  const LineClusters found = cluster_lines(lines, kLength, options);
  for (std::size_t k = 0; k < lines.size(); ++k) EXPECT_EQ(found.cluster[k], found.cluster[k % 3]);
  options.ends_alike = false;
  options.clusters = 6;
  const LineClusters apart = cluster_lines(lines, kLength, options);
  EXPECT_NE(apart.cluster[0], apart.cluster[3]) << "line 0 is turned, line 3 is not";
}

TEST(ClusterLines, SameForAnyNumberOfThreadsAndEveryTime) {
  Random random(9);
  std::vector<Pose> lines;
  for (int k = 0; k < 2000; ++k) lines.push_back(random_line(random, Vec3::Zero(), Vec3::UnitZ(), 10.0));
  LineClusterOptions options;
  options.clusters = 50;
  std::vector<LineClusters> found;
  for (const int threads : {1, 3, 1}) {
    set_thread_count(threads);
    found.push_back(cluster_lines(lines, kLength, options));
  }
  set_thread_count(0);
  EXPECT_EQ(found[0].cluster, found[1].cluster);
  EXPECT_EQ(found[0].cluster, found[2].cluster);
  EXPECT_EQ(found[0].representatives, found[1].representatives);
  EXPECT_EQ(found[0].representatives.size(), 50u);
  EXPECT_GT(found[0].rounds, 1);
}

TEST(ClusterLines, FewLines) {
  EXPECT_TRUE(cluster_lines({}, kLength, {}).representatives.empty());
  const std::vector<Pose> same(5, Pose{});
  EXPECT_EQ(cluster_lines(same, kLength, {}).representatives.size(), 1u);
  Random random(2);
  std::vector<Pose> lines;
  for (int k = 0; k < 4; ++k) lines.push_back(random_line(random, Vec3::Zero(), Vec3::UnitZ(), 10.0));
  EXPECT_EQ(cluster_lines(lines, kLength, {}).representatives.size(), 4u);
}

}  // namespace
}  // namespace flank::internal
