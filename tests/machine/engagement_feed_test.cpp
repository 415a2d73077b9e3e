// Feeds that follow the engagement: the thickest chip of side milling stays what it is at the reference.
#include "flank/machine/engagement_feed.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/machine/model/machine_file.h"
#include "flank/machine/post.h"

namespace flank::internal {
namespace {

constexpr double kRadius = 5.0, kDegree = M_PI / 180.0;

/// Of side milling: what a radial depth engages, and the shops' formula of the thickest chip by the feed per tooth.
double engaged(double depth) { return std::acos(1.0 - depth / kRadius); }
double thickest(double depth) {
  const double share = depth / (2.0 * kRadius);
  return share < 0.5 ? 2.0 * std::sqrt(share - share * share) : 1.0;
}

TEST(EngagementFeed, TheThickestChipIsTheFormulaOfTheRadialDepth) {
  for (const double depth : {0.01, 0.3, 1.0, 2.5, 4.9, 5.0, 6.0, 9.9})
    EXPECT_NEAR(chip_share(engaged(depth)), thickest(depth), 1e-12) << depth;
  EXPECT_EQ(chip_share(0.0), 0.0);
  EXPECT_EQ(chip_share(M_PI), 1.0);
}

TEST(EngagementFeed, IsFasterWhereLessIsEngagedUpToItsMost) {
  const EngagementFeed rule{.feed = 10.0, .reference = 60.0 * kDegree, .most_feed = 30.0};
  EXPECT_NEAR(feed_at(60.0 * kDegree, rule), 10.0, 1e-12);
  EXPECT_NEAR(feed_at(30.0 * kDegree, rule), 10.0 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(feed_at(90.0 * kDegree, rule), 5.0 * std::sqrt(3.0), 1e-12);
  EXPECT_EQ(feed_at(120.0 * kDegree, rule), feed_at(90.0 * kDegree, rule));
  EXPECT_EQ(feed_at(0.0, rule), 30.0);
  EXPECT_EQ(feed_at(0.0, {.feed = 10.0}), 10.0) << "no reference: the feed is even";
}

TEST(EngagementFeed, AWayHasTheFeedOfItsSlowestPlace) {
  const std::vector<double> slowness{0.1, 0.5, 0.2, 0.4};
  EXPECT_EQ(feed_between(slowness, 0.0, 3.0, 7.0), 2.0);
  EXPECT_EQ(feed_between(slowness, 0.0, 1.0, 7.0), 2.0);
  EXPECT_NEAR(feed_between(slowness, 0.0, 0.5, 7.0), 1.0 / 0.3, 1e-12);
  EXPECT_NEAR(feed_between(slowness, 2.0, 2.75, 7.0), 1.0 / 0.35, 1e-12);
  EXPECT_EQ(feed_between(slowness, 3.0, 3.0, 7.0), 2.5);
  EXPECT_EQ(feed_between({}, 0.0, 3.0, 7.0), 7.0);
}

/// A side cut of 100 mm, along an arc so wide that hardly a pose is left out, whose radial depth swells and ebbs.
struct SideCut {
  Path path;
  std::vector<double> depth, engagement;
};
SideCut side_cut(int poses) {
  SideCut cut;
  Strip strip{1, "front", "F1", {}};
  for (int k = 0; k < poses; ++k) {
    const double t = static_cast<double>(k) / (poses - 1), angle = 0.5 * t;
    strip.poses.push_back({Vec3(200.0 * std::sin(angle), 200.0 * (1.0 - std::cos(angle)), 0.0), Vec3(0.3, 0.1, 1.0)});
    strip.poses.back().axis.normalize();
    cut.depth.push_back(1.3 + 1.2 * std::sin(12.0 * t));
    cut.engagement.push_back(engaged(cut.depth.back()));
  }
  cut.path.strips.push_back(strip);
  return cut;
}

/// Thickest chips of the blocks of a program by the feed per tooth at the reference, least and largest, away from the
/// ends, where the machine starts and stops.
std::pair<double, double> chips(const Post& posted, const SideCut& cut, double feed_mm_min) {
  double least = 1e300, largest = 0.0;
  const std::vector<NcMove>& moves = posted.program.moves;
  EXPECT_EQ(moves.size(), cut.depth.size()) << "every pose is a block";
  for (std::size_t k = 20; k + 20 < moves.size(); ++k) {
    const double chip = moves[k].feed / feed_mm_min * thickest(std::max(cut.depth[k - 1], cut.depth[k]));
    least = std::min(least, chip);
    largest = std::max(largest, chip);
  }
  return {least, largest};
}

// On a machine that keeps up, every block has the same thickest chip; at an even feed it would vary by half.
TEST(EngagementFeed, AProgramKeepsItsThickestChip) {
  Machine machine = read_machine("fanuc-ac");
  for (Joint& joint : machine.joints) joint.acceleration *= 1e4;
  // F is of the way that is written: with four digits after the point it would follow their rounding.
  machine.dialect.length_decimals = 7;
  const SideCut cut = side_cut(1600);
  const PostTool tool{.name = "end mill", .axis_length = 20.0, .tip_radius = kRadius, .largest_radius = kRadius};
  PostOptions options;
  options.setup.translation = Vec3(0, 0, 50);
  options.deviation = 1e-6;
  const EngagementFeed rule{.feed = 1000.0 / 60.0, .reference = 60.0 * kDegree, .most_feed = 1e4};
  options.slowness.resize(1);
  for (const double engagement : cut.engagement) options.slowness[0].push_back(1.0 / feed_at(engagement, rule));
  const auto [least, largest] = chips(post(machine, cut.path, tool, options), cut, 1000.0);
  const double wanted = std::sin(60.0 * kDegree);
  EXPECT_LE(largest, wanted * (1.0 + 1e-3));
  EXPECT_GE(least, wanted * 0.97);
  options.slowness.clear();
  const auto [thin, thick] = chips(post(machine, cut.path, tool, options), cut, 1000.0);
  EXPECT_LT(thin, 0.5 * thick);
}

}  // namespace
}  // namespace flank::internal
