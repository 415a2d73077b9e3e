#include "flank/verify/swept/pose_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "flank/error.h"
#include "verify/brute_force.h"

namespace flank::internal::verify {
namespace {

constexpr double kLength = 20.0;

Path two_strips(std::uint64_t seed) {
  Random random(seed);
  Path path = brute::twisted_path(random, 17, 25.0, 1.1);
  path.strips.push_back(brute::twisted_path(random, 9, 10.0, 0.4).strips[0]);
  path.strips[1].poses.back() = path.strips[1].poses[7];  // a pose that stands still
  return path;
}

/// The least over |y| <= 1 of the larger distance, at the two ends of the axis, of the deviation from the node's line.
double off_line(const PoseNode& node, const Pose& pose) {
  const Vec3 low = pose.tip - node.tip, high = pose.at(kLength) - node.tip - kLength * node.axis;
  const auto off = [&](double y) {
    return std::max((low - y * node.half_tip).norm(), (high - y * (node.half_tip + kLength * node.half_turn)).norm());
  };
  return brute::golden(-1.0, 1.0, off);
}

TEST(PoseTree, BoundsHoldForEveryPoseOfEveryNode) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const PoseTree tree(two_strips(seed), kLength, 0.5);
    Random random(seed);
    for (const PoseNode& node : tree.nodes) {
      EXPECT_NEAR(node.turn, node.half_turn.norm(), 1e-15);
      for (int i = 0; i < 6; ++i) {
        const int k = node.first_piece +
                      static_cast<int>(random.next() % static_cast<std::uint64_t>(node.end_piece - node.first_piece));
        const Piece& piece = tree.pieces[static_cast<std::size_t>(k)];
        const Pose pose = tree.segment_of(k).at(random.uniform(piece.low, piece.high));
        for (const double s : {0.0, 0.3 * kLength, kLength}) {
          const double even = node.low_reach + (node.high_reach - node.low_reach) * s / kLength;
          ASSERT_LE((pose.at(s) - node.tip - s * node.axis).norm(), std::min(node.reach, even) + 1e-12);
        }
        ASSERT_LE(off_line(node, pose), node.bend + 1e-9);
      }
    }
  }
}

TEST(PoseTree, PiecesCoverEverySegmentWithoutGaps) {
  const PoseTree tree(two_strips(4), kLength, 0.5);
  EXPECT_EQ(tree.segments.size(), 16u + 8u);
  std::size_t k = 0;
  for (int segment = 0; segment < static_cast<int>(tree.segments.size()); ++segment) {
    double at = 0.0;
    for (; k < tree.pieces.size() && tree.pieces[k].segment == segment; ++k) {
      EXPECT_EQ(tree.pieces[k].low, at);
      at = tree.pieces[k].high;
    }
    EXPECT_EQ(at, 1.0) << segment;
  }
  EXPECT_EQ(k, tree.pieces.size());
}

TEST(PoseTree, SegmentsJoinThePosesAndKnowTheirPlace) {
  const Path path = two_strips(5);
  const PoseTree tree(path, kLength, 0.5);
  for (const Segment& g : tree.segments) {
    const auto& poses = path.strips[static_cast<std::size_t>(g.strip)].poses;
    const Pose &p = poses[static_cast<std::size_t>(g.pose)], &q = poses[static_cast<std::size_t>(g.pose) + 1];
    EXPECT_NEAR((g.at(0.0).tip - p.tip).norm() + (g.at(0.0).axis - p.axis).norm(), 0.0, 1e-14);
    EXPECT_NEAR((g.at(1.0).tip - q.tip).norm() + (g.at(1.0).axis - q.axis).norm(), 0.0, 1e-14);
  }
}

TEST(PoseTree, ChildrenShareTheirParentsPieces) {
  const PoseTree tree(two_strips(6), kLength, 0.5);
  ASSERT_EQ(tree.nodes.size(), 2 * tree.pieces.size() - 1);
  EXPECT_EQ(tree.nodes[0].first_piece, 0);
  EXPECT_EQ(tree.nodes[0].end_piece, static_cast<int>(tree.pieces.size()));
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const PoseNode& node = tree.nodes[i];
    if (node.second < 0) {
      EXPECT_EQ(node.end_piece - node.first_piece, 1);
      EXPECT_LE(node.reach, tree.piece_reach);
      continue;
    }
    const PoseNode &first = tree.nodes[i + 1], &second = tree.nodes[static_cast<std::size_t>(node.second)];
    EXPECT_EQ(first.first_piece, node.first_piece);
    EXPECT_EQ(first.end_piece, second.first_piece);
    EXPECT_EQ(second.end_piece, node.end_piece);
  }
}

TEST(PoseTree, TheFirstCutIsBetweenTheStrips) {
  const PoseTree tree(two_strips(7), kLength, 0.5);
  const int cut = tree.nodes[static_cast<std::size_t>(tree.nodes[0].second)].first_piece;
  EXPECT_EQ(tree.segment_of(cut - 1).strip, 0);
  EXPECT_EQ(tree.segment_of(cut).strip, 1);
}

/// Strips side by side, each a little beside the one before and back again: of many the pieces are grouped by where they are.
Path side_by_side(std::uint64_t seed, int count) {
  Random random(seed);
  const Path first = brute::twisted_path(random, 9, 20.0, 0.4);
  Path path;
  for (int k = 0; k < count; ++k) {
    Strip strip = first.strips[0];
    if (k % 2 == 1) std::reverse(strip.poses.begin(), strip.poses.end());
    for (Pose& pose : strip.poses) pose.tip += Vec3(0.1 * k, 0.05 * k, 0.02 * k);
    path.strips.push_back(std::move(strip));
  }
  return path;
}

/// Calls visit(piece) for all leaves below a node.
template <class Visit>
void visit_leaves(const PoseTree& tree, int node, const Visit& visit) {
  const PoseNode& n = tree.nodes[static_cast<std::size_t>(node)];
  if (n.second < 0) {
    visit(n.first_piece);
    return;
  }
  visit_leaves(tree, node + 1, visit);
  visit_leaves(tree, n.second, visit);
}

TEST(PoseTree, GroupsOfManyStripsHoldAllOfTheirPosesOnce) {
  const PoseTree tree(side_by_side(11, 20), kLength, 0.3);
  ASSERT_EQ(tree.nodes.size(), 2 * tree.pieces.size() - 1);
  std::vector<int> seen(tree.pieces.size(), 0);
  visit_leaves(tree, 0, [&](int piece) { ++seen[static_cast<std::size_t>(piece)]; });
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
  Random random(11);
  for (int k = 0; k < static_cast<int>(tree.nodes.size()); ++k) {
    const PoseNode& node = tree.nodes[static_cast<std::size_t>(k)];
    visit_leaves(tree, k, [&](int piece) {
      const Piece& p = tree.pieces[static_cast<std::size_t>(piece)];
      const Pose pose = tree.segment_of(piece).at(random.uniform(p.low, p.high));
      for (const double s : {0.0, 0.6 * kLength, kLength})
        ASSERT_LE((pose.at(s) - node.tip - s * node.axis).norm(), node.reach + 1e-12);
      ASSERT_LE(off_line(node, pose), node.bend + 1e-9);
    });
  }
}

TEST(PoseTree, GroupsOfManyStripsGetSmallSoonerThanTheirStrips) {
  const PoseTree tree(side_by_side(12, 64), kLength, 0.3);
  // Halved five times, a node of strips in their order would still hold two whole ones.
  std::vector<int> level{0};
  for (int n = 0; n < 5; ++n) {
    std::vector<int> next;
    for (const int k : level) next.push_back(k + 1), next.push_back(tree.nodes[static_cast<std::size_t>(k)].second);
    level = std::move(next);
  }
  for (const int k : level) EXPECT_LT(tree.nodes[static_cast<std::size_t>(k)].reach, 0.5 * tree.nodes[0].reach);
}

TEST(PoseTree, PiecesMoveTheAxisByNoMoreThanWasAsked) {
  for (const double reach : {5.0, 0.5, 0.05}) {
    const PoseTree tree(two_strips(8), kLength, reach);
    EXPECT_LE(tree.piece_reach, reach * (1.0 + 1e-9));
    EXPECT_GT(tree.piece_reach, 0.2 * reach) << "and by not much less";
  }
}

TEST(PoseTree, AStripOfOnePoseIsOnePieceThatStandsStill) {
  const Path path{{{1, "flank", "F1", {{Vec3(1, 2, 3), Vec3::UnitX()}}}}};
  const PoseTree tree(path, kLength, 0.1);
  ASSERT_EQ(tree.nodes.size(), 1u);
  EXPECT_EQ(tree.nodes[0].reach, 0.0);
  EXPECT_EQ(tree.nodes[0].bend, 0.0);
  EXPECT_EQ(tree.segments[0].at(0.7).tip, Vec3(1, 2, 3));
  EXPECT_TRUE(PoseTree(Path{}, kLength, 0.1).nodes.empty());
  EXPECT_TRUE(PoseTree(Path{{Strip{}}}, kLength, 0.1).nodes.empty());
}

TEST(PoseTree, RefusesPosesThatAreNoneNamingStripAndPose) {
  const auto complaint = [](const Path& path) -> std::string {
    try {
      const PoseTree tree(path, kLength, 0.5);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  };
  const Path good = two_strips(9);
  EXPECT_EQ(complaint(good), "accepted");
  Path bad = good;
  bad.strips[1].poses[3].tip.y() = std::nan("");
  EXPECT_NE(complaint(bad).find("pass 2, CL point 4 is not finite"), std::string::npos) << complaint(bad);
  bad = good;
  bad.strips[0].poses[16].axis *= 1.01;
  EXPECT_NE(complaint(bad).find("pass 1, CL point 17 has an axis of length 1.01"), std::string::npos) << complaint(bad);
  bad = good;
  bad.strips[0].poses[5].axis *= -1.0;
  EXPECT_NE(complaint(bad).find("pass 1, CL point 6 turns the axis by more than 170 degrees"), std::string::npos)
      << complaint(bad);
  bad = good;
  bad.strips[0].poses[2].axis *= 1.0005;
  EXPECT_EQ(complaint(bad), "accepted") << "files have rounded numbers";
}

}  // namespace
}  // namespace flank::internal::verify
