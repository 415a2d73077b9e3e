// CERTIFY on a plane, where every depth is known: what is fine stays, what is not is lifted, trimmed or dropped.
#include "flank/strip/certify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "cover/cover_targets.h"
#include "flank/base/tolerance_budget.h"
#include "flank/path/turning.h"

namespace flank::internal {
namespace {

constexpr double kTolerance = 0.01, kRadius = 5.0, kLength = 20.0;

/// A round-ended cylinder over the plane z = 0, 60 x 40 mm; its axis lies along y, deep by depth(x).
class Certify : public ::testing::Test {
 protected:
  CoverStrip strip(const std::function<double(double)>& depth, int control_points = 40) {
    std::vector<Pose> poses;
    std::vector<double> t;
    for (int i = 0; i <= 160; ++i) {
      t.push_back(i / 160.0);
      poses.push_back({Vec3(60.0 * t.back(), 10.0, kRadius - depth(60.0 * t.back())), Vec3::UnitY()});
    }
    return measure_strip(samples_, fit_motion(poses, t, kLength, control_points), radial_, fitter_);
  }
  CoverStrip cut(const CoverStrip& strip, const PoseGuard& guard = {}) {
    return cut_to_certified(samples_, guard, strip, radial_, fitter_);
  }
  CoverStrip lift(const CoverStrip& strip, const PoseGuard& guard = {}) {
    return lifted(samples_, guard, strip, radial_, fitter_);
  }
  CoverStrip cut_fine(const CoverStrip& strip, const PoseGuard& guard = {}) {
    return cut_finely(samples_, guard, strip, radial_, fitter_);
  }
  /// The deepest place over many poses, from the plane itself.
  static double deepest(const RuledMotion& motion) {
    double depth = -1e300;
    for (int i = 0; i <= 4000; ++i) {
      const Pose pose = motion.pose(i / 4000.0);
      if (pose.tip.x() < 0.0 || pose.tip.x() > 60.0) continue;
      depth = std::max({depth, kRadius - pose.tip.z(), kRadius - pose.at(kLength).z()});
    }
    return depth;
  }
  static void expect_same(const RuledMotion& a, const RuledMotion& b) {
    EXPECT_EQ(a.tip.poles, b.tip.poles);
    EXPECT_EQ(a.direction.poles, b.direction.poles);
  }

  std::unique_ptr<Target> target_ = testing::flat_target(0.0, 60.0, 0.0, 40.0);
  Tool tool_ = testing::cylinder(kRadius, kLength);
  RadialFunction radial_ = tool_.radial;
  CoverSamples samples_ = cover_samples(*target_, 1.0);
  LineFitter fitter_{*target_, radial_, {.tolerance_mm = kTolerance}};
};

double bump(double x, double middle, double width) { return std::exp(-std::pow((x - middle) / width, 2)); }

TEST_F(Certify, AKinkIsCutOutAndBothLegsStay) {
  constexpr double kLimit = 15.0 * std::numbers::pi / 180.0;
  const TurnLimit limit{kLimit, turn_window(target_->diagonal())};
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int i = 0; i <= 600; ++i) {
    t.push_back(i / 600.0);
    const double x = 60.0 * t.back();
    poses.push_back({Vec3(x, 4.0 + 0.7 * std::abs(x - 24.0), kRadius), Vec3::UnitY()});
  }
  const CoverStrip bent = measure_strip(samples_, fit_motion(poses, t, kLength, 100), radial_, fitter_);
  ASSERT_TRUE(has_kink(bent.motion, limit, kTolerance));
  EXPECT_FALSE(has_kink(bent.motion, {0.0, limit.window_mm}, kTolerance)) << "no limit";
  const std::vector<CoverStrip> pieces = cut_at_kinks(samples_, {}, bent, radial_, fitter_, limit);
  ASSERT_EQ(pieces.size(), 2U);
  double area = 0.0;
  for (const CoverStrip& piece : pieces) {
    EXPECT_FALSE(has_kink(piece.motion, limit, kTolerance));
    EXPECT_TRUE(is_certified({}, piece, kTolerance));
    area += piece.area;
  }
  EXPECT_GE(area, 0.95 * bent.area);
}

TEST_F(Certify, AStripWithoutKinksIsNotCut) {
  const CoverStrip straight = strip([](double) { return 0.0; });
  const std::vector<CoverStrip> pieces =
      cut_at_kinks(samples_, {}, straight, radial_, fitter_, {0.01, turn_window(target_->diagonal())});
  ASSERT_EQ(pieces.size(), 1U);
  expect_same(pieces.front().motion, straight.motion);
}

TEST_F(Certify, AllowsItsShareOfTheToleranceAndNoMore) {
  const double limit = kToleranceBudget.target.certified * kTolerance;
  EXPECT_TRUE(is_certified({}, strip([=](double) { return limit - 1e-5; }), kTolerance));
  EXPECT_FALSE(is_certified({}, strip([=](double) { return limit + 1e-5; }), kTolerance));
  EXPECT_FALSE(is_certified({}, CoverStrip{}, kTolerance)) << "a strip without cells is none";
}

TEST_F(Certify, AsksForClearanceFromEndToEnd) {
  const CoverStrip fine = strip([](double) { return 0.0; });
  // A post at the very start, one at the very end, one in the middle, and one beside the way.
  for (const double x : {-2.0, 30.0, 62.0}) {
    const Obstacles post = testing::triangle_obstacle(Vec3(x, 20.0, 1.0), Vec3(x, 21.0, 1.0), Vec3(x, 20.0, 30.0));
    EXPECT_FALSE(is_certified(PoseGuard(tool_, post, -0.005), fine, kTolerance)) << x;
  }
  const Obstacles beside = testing::triangle_obstacle(Vec3(30, 36, 1), Vec3(30, 37, 1), Vec3(30, 36, 30));
  EXPECT_TRUE(is_certified(PoseGuard(tool_, beside, -0.005), fine, kTolerance));
}

TEST_F(Certify, WhatIsFineIsUnchanged) {
  const CoverStrip fine = strip([](double x) { return 0.004 * std::sin(0.2 * x); });
  ASSERT_TRUE(is_certified({}, fine, kTolerance));
  expect_same(cut(fine).motion, fine.motion);
  expect_same(lift(fine).motion, fine.motion);
  expect_same(cut_fine(fine).motion, fine.motion);
  EXPECT_EQ(cut_fine(fine).cells, fine.cells);
}

TEST_F(Certify, TheLongestOfThreeStretchesRemains) {
  // Too deep about x = 12 and x = 40: the stretch between them is the longest.
  const CoverStrip bad = strip([](double x) { return 0.05 * (bump(x, 12.0, 2.0) + bump(x, 40.0, 2.0)); });
  ASSERT_NEAR(bad.overcut_mm, 0.05, 3e-3);
  const CoverStrip left = cut(bad);
  ASSERT_TRUE(is_certified({}, left, kTolerance));
  // The bump is below the limit where exp(-(x/2)^2) < 0.188: from 2.6 mm on.
  const double off = 2.0 * std::sqrt(std::log(0.05 / (kToleranceBudget.target.certified * kTolerance)));
  EXPECT_NEAR(left.motion.pose(0.0).tip.x(), 12.0 + off, 0.6);
  EXPECT_NEAR(left.motion.pose(1.0).tip.x(), 40.0 - off, 0.6);
  EXPECT_LE(deepest(left.motion), kTolerance);
  EXPECT_NEAR(left.area, (28.0 - 2.0 * off) * (kLength + 2.0 * std::sqrt(2.0 * kRadius * kTolerance)), 40.0);
}

TEST_F(Certify, WhatIsTooDeepAllOverIsDropped) {
  const CoverStrip bad = strip([](double) { return 0.03; });
  EXPECT_TRUE(cut(bad).cells.empty());
  EXPECT_TRUE(cut_fine(strip([](double) { return 2.0; })).cells.empty()) << "nor can two millimetres be lifted";
}

TEST_F(Certify, LessThanATenthIsDropped) {
  // Right over 4 mm of 60 about x = 30.
  const auto right_over = [](double width) { return [=](double x) { return 0.05 * (1.0 - bump(x, 30.0, width)); }; };
  EXPECT_TRUE(cut(strip(right_over(3.0))).cells.empty());
  const CoverStrip left = cut(strip(right_over(20.0)));
  ASSERT_FALSE(left.cells.empty());
  EXPECT_NEAR(left.motion.pose(0.5).tip.x(), 30.0, 0.5);
}

TEST_F(Certify, AnObstacleCutsAsDepthDoes) {
  const Obstacles wall = testing::triangle_obstacle(Vec3(20, -50, -50), Vec3(20, 80, -50), Vec3(20, 0, 90));
  const PoseGuard guard(tool_, wall, -0.005);
  const CoverStrip left = cut(strip([](double) { return 0.0; }), guard);
  ASSERT_TRUE(is_certified(guard, left, kTolerance));
  EXPECT_NEAR(left.motion.pose(0.0).tip.x(), 20.0 + kRadius, 0.6);
  EXPECT_NEAR(left.motion.pose(1.0).tip.x(), 60.0, 1e-3);
}

TEST_F(Certify, LiftsEachDeepPlaceByItself) {
  const CoverStrip bad = strip([](double x) { return 0.013 * bump(x, 15.0, 3.0) + 0.012 * bump(x, 45.0, 3.0); });
  ASSERT_FALSE(is_certified({}, bad, kTolerance));
  const CoverStrip up = lift(bad);
  EXPECT_TRUE(is_certified({}, up, kTolerance)) << up.overcut_mm;
  EXPECT_LE(deepest(up.motion), kTolerance);
  EXPECT_NEAR(up.motion.pose(0.5).tip.z(), bad.motion.pose(0.5).tip.z(), 1e-4) << "between them nothing moves";
  EXPECT_GE(up.area, 0.99 * bad.area);
}

TEST_F(Certify, LiftsTheEndThatIsDeep) {
  // The tip alone is 0.015 mm deep: the holder end is its hinge.
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int i = 0; i <= 80; ++i) {
    t.push_back(i / 80.0);
    const Vec3 tip(60.0 * t.back(), 10.0, kRadius - 0.015), holder(60.0 * t.back(), 10.0 + kLength, kRadius);
    poses.push_back({tip, (holder - tip).normalized()});
  }
  const CoverStrip bad = measure_strip(samples_, fit_motion(poses, t, kLength, 24), radial_, fitter_);
  ASSERT_NEAR(bad.overcut_mm, 0.015, 1e-4);
  const CoverStrip up = lift(bad);
  EXPECT_TRUE(is_certified({}, up, kTolerance)) << up.overcut_mm;
  EXPECT_GT(up.motion.pose(0.5).tip.z(), kRadius - kTolerance);
  EXPECT_NEAR(up.motion.pose(0.5).at(kLength).z(), kRadius, 1e-3);
}

TEST_F(Certify, TheFineLookLiftsWhatIsALittleTooDeep) {
  const CoverStrip bad = strip([](double x) { return 0.014 * bump(x, 30.0, 4.0); });
  const CoverStrip fine = cut_fine(bad);
  ASSERT_FALSE(fine.cells.empty());
  EXPECT_LE(deepest(fine.motion), kTolerance);
  EXPECT_NEAR(fine.motion.pose(0.0).tip.x(), 0.0, 0.1) << "it is as long as it was";
  EXPECT_NEAR(fine.motion.pose(1.0).tip.x(), 60.0, 0.1);
}

TEST_F(Certify, TheFineLookCutsWhatCannotSlideAway) {
  const Obstacles wall = testing::triangle_obstacle(Vec3(50, -50, -50), Vec3(50, 80, -50), Vec3(50, 0, 90));
  const PoseGuard guard(tool_, wall, -0.0065);
  const CoverStrip left = cut_fine(strip([](double) { return 0.0; }), guard);
  ASSERT_FALSE(left.cells.empty());
  EXPECT_NEAR(left.motion.pose(1.0).tip.x(), 50.0 - kRadius, 0.6);
  for (int i = 0; i <= 1000; ++i) EXPECT_TRUE(guard.with_floor(-kTolerance).clear(left.motion.pose(i / 1000.0)));
}

}  // namespace
}  // namespace flank::internal
