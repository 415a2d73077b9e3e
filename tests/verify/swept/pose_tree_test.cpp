#include "flank/verify/swept/pose_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

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
        for (const double s : {0.0, 0.3 * kLength, kLength})
          ASSERT_LE((pose.at(s) - node.tip - s * node.axis).norm(), node.reach + 1e-12);
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
  EXPECT_NE(complaint(bad).find("strip 2, pose 4 is not finite"), std::string::npos) << complaint(bad);
  bad = good;
  bad.strips[0].poses[16].axis *= 1.01;
  EXPECT_NE(complaint(bad).find("strip 1, pose 17 has an axis of length 1.01"), std::string::npos) << complaint(bad);
  bad = good;
  bad.strips[0].poses[5].axis *= -1.0;
  EXPECT_NE(complaint(bad).find("strip 1, pose 6 turns the axis by more than 170 degrees"), std::string::npos)
      << complaint(bad);
  bad = good;
  bad.strips[0].poses[2].axis *= 1.0005;
  EXPECT_EQ(complaint(bad), "accepted") << "files have rounded numbers";
}

}  // namespace
}  // namespace flank::internal::verify
