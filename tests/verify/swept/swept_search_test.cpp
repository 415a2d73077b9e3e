#include "flank/verify/swept/swept_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sanitized.h"
#include "verify/brute_force.h"

namespace flank::internal::verify {
namespace {

constexpr double kExactMm = 1e-9;
constexpr int kPoints = kSanitized ? 10 : 80;

struct Scene {
  Tool tool;
  ToolDistance distance;
  PoseTree tree;
  Path path;

  Scene(const Tool& t, const Path& p, double reach)
      : tool(t), distance(t.radial), tree(p, t.radial.axis_length(), reach), path(p) {}

  [[nodiscard]] SweptPlace run(const Vec3& x, double horizon = 1e300, const SweptPlace& near = {}) const {
    return SweptSearch(distance, tree, x).run(horizon, near);
  }
  /// Every piece by the search that assumes nothing.
  [[nodiscard]] double over_all_pieces(const Vec3& x) const {
    double least = 1e300;
    for (const Piece& p : tree.pieces) {
      const Segment& g = tree.segments[static_cast<std::size_t>(p.segment)];
      least = std::min(least, bracketed_minimum(g, distance, x, p.low, p.high).f);
    }
    return least;
  }
};

Scene twisted(std::uint64_t seed, double turn = 0.8) {
  Random random(seed);
  const Tool tool = brute::random_tool(random, 20.0);
  return {tool, brute::twisted_path(random, 12, 25.0, turn), 0.3};
}

Vec3 around(const Scene& scene, Random& random, double size) {
  return scene.path.strips[0].poses[6].at(10.0) + brute::random_vector(random, size);
}

TEST(SweptSearch, FindsTheLeastOverAllPieces) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Scene scene = twisted(seed);
    Random random(seed);
    for (int i = 0; i < kPoints / 4; ++i) {
      const Vec3 x = around(scene, random, 15.0);
      ASSERT_NEAR(scene.run(x).f, scene.over_all_pieces(x), kExactMm) << seed << ' ' << i;
    }
  }
}

TEST(SweptSearch, AmongManyStripsItFindsTheLeastOverAllPieces) {
  Random random(31);
  const Tool tool = brute::random_tool(random, 20.0);
  Path path;
  const Path first = brute::twisted_path(random, 5, 12.0, 0.4);
  for (int k = 0; k < 14; ++k) {
    path.strips.push_back(first.strips[0]);
    for (Pose& pose : path.strips.back().poses) pose.tip += Vec3(0.3 * k, 0.1 * k, 0.0);
  }
  const Scene scene(tool, path, 0.5);
  for (int i = 0; i < kPoints / 4; ++i) {
    const Vec3 x = path.strips[7].poses[2].at(10.0) + brute::random_vector(random, 15.0);
    const double least = scene.over_all_pieces(x);
    ASSERT_NEAR(scene.run(x).f, least, kExactMm) << i;
    EXPECT_EQ(scene.run(x, least - 1e-6).piece, -1) << "nothing is below";
  }
}

TEST(SweptSearch, ThePlaceIsOneOfItsPieceAndHasTheValue) {
  const Scene scene = twisted(4);
  Random random(4);
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 x = around(scene, random, 25.0);
    const SweptPlace place = scene.run(x);
    ASSERT_GE(place.piece, 0);
    const Piece& piece = scene.tree.pieces[static_cast<std::size_t>(place.piece)];
    ASSERT_GE(place.tau, piece.low);
    ASSERT_LE(place.tau, piece.high);
    ASSERT_NEAR(place.f,
                distance_value(scene.tree.segment_of(place.piece), scene.distance.radial(), x, place.tau, place.s),
                1e-11);
  }
}

TEST(SweptSearch, WhereItLooksFirstChangesTheTimeAndNotTheValue) {
  const Scene scene = twisted(5);
  Random random(5);
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 x = around(scene, random, 15.0);
    const double wanted = scene.run(x).f;
    const int last = static_cast<int>(scene.tree.pieces.size()) - 1;
    for (const int piece : {0, last / 2, last})
      for (const double tau : {0.0, 0.5, 1.0})
        ASSERT_NEAR(scene.run(x, 1e300, {0.0, piece, tau, random.uniform(0.0, 20.0)}).f, wanted, kExactMm);
  }
}

TEST(SweptSearch, AHorizonCutsOffWhatIsNotBelowIt) {
  const Scene scene = twisted(6);
  Random random(6);
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 x = around(scene, random, 20.0);
    const double f = scene.run(x).f;
    ASSERT_NEAR(scene.run(x, f + 0.01).f, f, kExactMm);
    const SweptPlace nothing = scene.run(x, f - 0.01);
    ASSERT_EQ(nothing.piece, -1);
    ASSERT_EQ(nothing.f, f - 0.01);
  }
}

TEST(SweptSearch, FinerPiecesGiveTheSameValue) {
  Random random(7);
  const Tool tool = brute::random_tool(random, 20.0);
  const Path path = brute::twisted_path(random, 12, 25.0, 0.8);
  const Scene coarse(tool, path, 1.0), fine(tool, path, 0.05);
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 x = around(coarse, random, 15.0);
    ASSERT_NEAR(coarse.run(x).f, fine.run(x).f, kExactMm) << i;
  }
}

/// The same motion in many short steps, of unequal lengths.
Path dense(const Path& path, int steps) {
  Path out;
  for (const Strip& strip : path.strips) {
    out.strips.push_back({strip.id, strip.kind, strip.face, {}});
    for (std::size_t i = 0; i + 1 < strip.poses.size(); ++i)
      for (int k = 0; k < steps; ++k) {
        const double share = static_cast<double>(k) / steps;
        out.strips.back().poses.push_back(
            brute::between(strip.poses[i], strip.poses[i + 1], share * (0.6 + 0.4 * share)));
      }
    out.strips.back().poses.push_back(strip.poses.back());
  }
  return out;
}

// Steps of 2 mm in up to 2,000: far shorter than a piece may be.
TEST(SweptSearch, OnDensePathsItFindsTheLeastOverAllPieces) {
  Random random(9);
  const Tool tool = brute::random_tool(random, 20.0);
  for (const double turn : {0.0, 0.8, 2.0}) {
    const Path path = brute::twisted_path(random, 8, 12.0, turn);
    for (const int steps : {30, 200, kSanitized ? 300 : 2000}) {
      const Scene scene(tool, dense(path, steps), 0.3);
      SweptPlace near;
      for (int i = 0; i < std::max(4, 5 * kPoints / steps); ++i) {
        // Near the surface that is left, where many poses are about as near as the nearest.
        Vec3 x = path.strips[0].poses[4].at(10.0) + brute::random_vector(random, 12.0);
        if (i % 4 != 0) {
          const SweptPlace at = scene.run(x);
          const Vec3 c = scene.tree.segment_of(at.piece).at(at.tau).at(at.s);
          x = c + (tool.radial.at(at.s).r + random.uniform(-0.01, 0.01)) * (x - c).normalized();
        }
        const double wanted = scene.over_all_pieces(x);
        ASSERT_NEAR(scene.run(x).f, wanted, kExactMm) << turn << ' ' << steps << ' ' << i;
        const SweptPlace found = scene.run(x, 1e300, near);
        ASSERT_NEAR(found.f, wanted, kExactMm) << turn << ' ' << steps << ' ' << i;
        near = found;
      }
    }
  }
}

// Descent does not stop for the ends of steps, however many there are on the way.
TEST(SweptSearch, DescentGoesOnOverManyShortSteps) {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 3.0));
  Path line;
  line.strips.push_back({1, "flank", "F1", {{Vec3(0, 0, 0), Vec3::UnitZ()}, {Vec3(40, 0, 0), Vec3::UnitZ()}}});
  const Scene scene(tool, dense(line, 40000), 0.3);
  for (const double x : {20.0, 19.2, 21.9}) {
    const Vec3 at(x, 4.0, 10.0);
    const SweptPlace from = scene.run({20.5, 4.0, 10.0});
    EXPECT_NEAR(SweptSearch(scene.distance, scene.tree, at).descend_from(from).f, 1.0, 1e-6) << x;
  }
}

TEST(SweptSearch, ForkedToolsAreFollowedToTheirLeastMinimum) {
  // Far from a waist both shoulders are near: several minima over s for one pose.
  Tool tool;
  tool.radial = RadialFunction::spline(24.0, (Eigen::VectorXd(8) << 6.0, 5.0, 3.0, 1.6, 1.6, 3.0, 5.2, 6.3).finished());
  Random random(8);
  const Scene scene(tool, brute::twisted_path(random, 6, 12.0, 0.6), 0.2);
  for (int i = 0; i < kPoints / 4; ++i) {
    const Vec3 x = scene.path.strips[0].poses[3].at(12.0) + random.uniform(5.0, 25.0) * brute::random_unit(random);
    ASSERT_NEAR(scene.run(x).f, scene.over_all_pieces(x), kExactMm) << i;
  }
}

TEST(SweptSearch, PointsOnTheAxisAreAsDeepAsTheToolIsThick) {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 3.0));
  Path path;
  path.strips.push_back({1, "flank", "F1", {{Vec3(0, 0, 0), Vec3::UnitZ()}, {Vec3(40, 0, 0), Vec3::UnitZ()}}});
  const Scene scene(tool, path, 0.3);
  // On the axis itself the value has a tip, which golden sections follow to a millionth of a piece of 0.6 mm.
  for (const double x : {0.0, 0.7, 20.0, 40.0}) {
    for (const double z : {0.0, 3.3, 20.0}) {
      const double f = scene.run({x, 0.0, z}).f;
      EXPECT_GE(f, -3.0 - 1e-12);
      EXPECT_LE(f, -3.0 + 0.6e-6);
    }
  }
  EXPECT_NEAR(scene.run({43.0, 0.0, 24.0}).f, 2.0, kExactMm);
}

}  // namespace
}  // namespace flank::internal::verify
