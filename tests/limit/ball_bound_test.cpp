#include "flank/limit/ball_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analytic_targets.h"
#include "flank/threads.h"

namespace flank::internal {
namespace {

/// A floor beside a wall: 20 by 10 mm, the wall at x = 0.
class FloorTarget : public PlaneTarget {
 public:
  FloorTarget() : PlaneTarget(Vec3::Zero(), Vec3::UnitZ()) { area_ = 200.0; }
  [[nodiscard]] Footpoint closest_within(const Vec3& p, double horizon_mm) const override {
    Footpoint foot;
    foot.point = Vec3(std::clamp(p.x(), 0.0, 20.0), std::clamp(p.y(), 0.0, 10.0), 0.0);
    foot.normal = Vec3::UnitZ();
    foot.distance = (p - foot.point).norm();
    foot.patch = foot.distance < horizon_mm ? 0 : -1;
    return foot;
  }
  [[nodiscard]] std::vector<SurfaceSample> samples(double spacing_mm) const override {
    std::vector<SurfaceSample> all;
    for (double x = 0.5 * spacing_mm; x < 20.0; x += spacing_mm)
      for (double y = 0.5 * spacing_mm; y < 10.0; y += spacing_mm)
        all.push_back({.point = Vec3(x, y, 0), .normal = Vec3::UnitZ(), .area = spacing_mm * spacing_mm});
    return all;
  }
};

/// What stands behind the wall: a block whose near side it is.
TriangleMesh block() {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.emplace_back((k & 1) != 0 ? 0.0 : -40.0, (k & 2) != 0 ? 50.0 : -40.0, (k & 4) != 0 ? 40.0 : -40.0);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// The floor, the wall, and the block.
struct Corner {
  FloorTarget floor;
  PlaneTarget wall{Vec3::Zero(), Vec3::UnitX()};
  verify::Winding solid{block()};
  BallScene scene{.faces = {&floor, &wall}, .solids = {&solid}};
};

const double kCorner = (std::sqrt(2.0) - 1.0) / (std::sqrt(2.0) + 1.0);  // of the radius, beside a wall

TEST(BallBound, BesideAWallComesNearTheFormulaFromBelow) {
  const Corner corner;
  const BallBound bound = ball_bound(corner.floor, corner.scene, {.radius_mm = 2.0, .spacing_mm = 2.0}, {});
  EXPECT_LE(bound.bound_mm, 2.0 * kCorner);
  EXPECT_GE(bound.bound_mm, 0.9 * 2.0 * kCorner);
  EXPECT_GE(bound.found_mm, bound.bound_mm);
  EXPECT_LT(bound.point.x(), 0.1);
  EXPECT_TRUE(bound.complete);
}

/// Else a ball in the block would touch the floor's border from within.
TEST(BallBound, BallsInASolidDoNotCount) {
  const Corner corner;
  const Vec3 site(0, 5, 0);
  EXPECT_EQ(least_error(site, Vec3::UnitZ(), {.faces = corner.scene.faces, .of_solid = true}, 2.0, {}).bound_mm, 0.0);
  BallScene scene = corner.scene;
  scene.of_solid = true;
  const double bound = least_error(site, Vec3::UnitZ(), scene, 2.0, {.gap = 0.02}).bound_mm;
  EXPECT_LE(bound, 2.0 * kCorner);
  EXPECT_GE(bound, 0.97 * 2.0 * kCorner);
}

TEST(BallBound, IsNothingWithoutAWall) {
  const FloorTarget floor;
  const BallBound bound = ball_bound(floor, {.faces = {&floor}}, {.radius_mm = 2.0, .spacing_mm = 2.0}, {});
  EXPECT_EQ(bound.bound_mm, 0.0);
  EXPECT_EQ(bound.out_of_reach_mm2, 0.0);
  EXPECT_NEAR(bound.area_mm2, 200.0, 1e-9);
}

TEST(BallBound, FinerNetsNeverLowerIt) {
  const Corner corner;
  double before = 0.0;
  for (const int levels : {1, 2, 3, 5, 7}) {
    const BallBound bound = ball_bound(corner.floor, corner.scene,
                                       {.radius_mm = 2.0, .spacing_mm = 1.5, .gap = 0.01, .levels = levels}, {});
    EXPECT_GE(bound.bound_mm, before * (1.0 - 1e-12)) << levels;
    before = bound.bound_mm;
  }
  EXPECT_GT(before, 0.95 * 2.0 * kCorner);
}

/// Within r - sqrt(4 r e) of the wall, nearly, no ball touches within e.
TEST(BallBound, TellsTheAreaThatNoToolFinishes) {
  const Corner corner;
  const BallBound bound = ball_bound(corner.floor, corner.scene,
                                     {.radius_mm = 4.0, .tolerance_mm = 0.01, .spacing_mm = 0.5, .levels = 1}, {});
  const double width = 4.0 - 0.01 - std::sqrt(4.0 * 4.0 * 0.01);
  EXPECT_LE(bound.out_of_reach_mm2, 10.0 * (width + 0.25));
  EXPECT_GE(bound.out_of_reach_mm2, 10.0 * (width - 0.5));
}

TEST(BallBound, IsTheSameForAnyNumberOfThreads) {
  const FloorTarget floor;
  const PlaneTarget wall(Vec3::Zero(), Vec3(1, 0.3, 0.2));
  const auto run = [&] {
    return ball_bound(floor, {.faces = {&floor, &wall}}, {.radius_mm = 2.0, .spacing_mm = 2.0}, {});
  };
  set_thread_count(1);
  const BallBound one = run();
  set_thread_count(0);
  const BallBound all = run();
  EXPECT_EQ(one.bound_mm, all.bound_mm);
  EXPECT_EQ(one.point, all.point);
  EXPECT_EQ(one.centre, all.centre);
}

TEST(BallBound, OfAStoppedRunIsNotComplete) {
  const Corner corner;
  Progress progress;
  progress.cancelled = [] { return true; };
  EXPECT_FALSE(ball_bound(corner.floor, corner.scene, {.radius_mm = 2.0, .spacing_mm = 2.0}, progress).complete);
}

/// What is stopped after its first net has no half of a net, and is not complete either.
TEST(BallBound, StoppedBetweenTwoNetsIsNotComplete) {
  const Corner corner;
  bool first_is_done = false;
  Progress progress;
  progress.report = [&](std::string_view, double done) { first_is_done = done >= 0.125 - 1e-9; };
  progress.cancelled = [&] { return first_is_done; };
  const BallBound bound = ball_bound(corner.floor, corner.scene, {.radius_mm = 2.0, .spacing_mm = 2.0}, progress);
  EXPECT_GT(bound.bound_mm, 0.0);
  EXPECT_FALSE(bound.complete);
}

}  // namespace
}  // namespace flank::internal
