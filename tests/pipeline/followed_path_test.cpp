// Whether a program runs its path: its own poses between those of the path are on it, what is beside is not.
#include "flank/pipeline/program/followed_path.h"

#include <gtest/gtest.h>

#include <cmath>

namespace flank::internal {
namespace {

constexpr double kLength = 27.0, kRoom = 0.025;

Pose pose_at(double share, double beside = 0.0) {
  // Directions of a path between two poses are those of the chord, as long as the axis is.
  const Vec3 first = Vec3::UnitX(), second(std::cos(0.15), std::sin(0.15), 0.0);
  return {Vec3(0.0, beside, share), ((1.0 - share) * first + share * second).normalized()};
}

/// A program that goes there in eight blocks.
Backplot in_blocks(double beside) {
  Backplot plot;
  plot.path.strips.push_back({1, "edge", "F1", {}});
  plot.moves.emplace_back();
  for (int k = 0; k <= 8; ++k) {
    plot.path.strips[0].poses.push_back(pose_at(k / 8.0, k == 4 ? beside : 0.0));
    plot.moves[0].push_back({.line = k + 1});
  }
  return plot;
}

TEST(FollowedPath, TheUpperEndOfAnAxisThatTurnsGoesAlongAnArc) {
  const Path path{{{1, "edge", "F1", {pose_at(0.0), pose_at(1.0)}}}};
  EXPECT_TRUE(follow_path(path, in_blocks(0.0), {kLength, kRoom}).findings.empty());
  const FollowedPath off = follow_path(path, in_blocks(2.0 * kRoom), {kLength, kRoom});
  ASSERT_FALSE(off.findings.empty());
  EXPECT_EQ(off.findings.front().line, 5);
}

TEST(FollowedPath, StripsThatBeginAtOnePlaceMayBeRunInAnyOrder) {
  const Path path{{{1, "edge", "F1", {pose_at(0.5), pose_at(0.25), pose_at(0.0)}},
                   {2, "edge", "F1", {pose_at(0.5), pose_at(0.75), pose_at(1.0)}}}};
  for (const bool second_first : {false, true}) {
    Backplot plot;
    for (const int turn : {0, 1}) {
      const double way = (turn == 0) == second_first ? 0.5 : -0.5;
      plot.path.strips.push_back({turn + 1, "edge", "F1", {}});
      plot.moves.emplace_back();
      for (int k = 0; k <= 4; ++k) {
        plot.path.strips[turn].poses.push_back(pose_at(0.5 + way * k / 4.0));
        plot.moves[turn].push_back({.line = 10 * turn + k + 1, .from_afar = k == 0});
      }
    }
    const FollowedPath followed = follow_path(path, plot, {kLength, kRoom});
    EXPECT_TRUE(followed.findings.empty()) << second_first << ": " << followed.findings.front().text;
    EXPECT_EQ(followed.strips[0].back(), second_first ? 1 : 0);
    EXPECT_EQ(followed.strips[1].back(), second_first ? 0 : 1);
  }
}

}  // namespace
}  // namespace flank::internal
