// What every target has in common, whether it is made of faces or of triangles.
#include "flank/target.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "flank/surface/facet_gaps.h"
#include "flank/threads.h"
#include "surface/mesh_shapes.h"
#include "surface/nurbs_fixtures.h"

namespace flank::internal {
namespace {

Vec3 wave(double u, double v) { return {40 * u, 30 * v, 3 * std::sin(3 * u) * std::cos(2 * v)}; }

/// The same wave as a spline surface.
Face wave_face() {
  Face face;
  face.id = "F1";
  std::vector<Vec3> points;
  std::vector<double> t;
  for (int k = 0; k <= 20; ++k) t.push_back(k / 20.0);
  for (const double u : t)
    for (const double v : t) points.push_back(wave(u, v));
  face.surface = interpolate_grid(points, t, t, 3);
  return face;
}

const std::vector<std::unique_ptr<Target>>& waves() {
  static const std::vector<std::unique_ptr<Target>> targets = [] {
    std::vector<std::unique_ptr<Target>> list;
    list.push_back(make_target(std::vector<Face>{wave_face()}));
    list.push_back(make_target(shapes::grid(40, 40, wave)));
    return list;
  }();
  return targets;
}

std::vector<Vec3> query_points(int count) {
  Random random(1);
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k)
    points.emplace_back(random.uniform(-3, 43), random.uniform(-3, 33), random.uniform(-8, 8));
  return points;
}

void expect_equal(const Footpoint& a, const Footpoint& b) {
  EXPECT_EQ(a.point, b.point);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.distance, b.distance);
  EXPECT_EQ(a.k1, b.k1);
  EXPECT_EQ(a.k2, b.k2);
  EXPECT_EQ(a.patch, b.patch);
  EXPECT_EQ(a.location, b.location);
}

TEST(Target, BatchesAreTheSingleQueriesForAnyNumberOfThreads) {
  const std::vector<Vec3> points = query_points(300);
  for (const auto& target : waves())
    for (const int threads : {1, 3}) {
      set_thread_count(threads);
      std::vector<Footpoint> cold(points.size()), warm;
      target->closest_batch(points, cold);
      warm = cold;
      std::vector<Vec3> moved = points;
      for (Vec3& p : moved) p += Vec3(0.1, -0.1, 0.05);
      target->track_batch(moved, warm);
      for (std::size_t k = 0; k < points.size(); ++k) {
        expect_equal(cold[k], target->closest(points[k]));
        expect_equal(warm[k], target->track(moved[k], cold[k]));
      }
    }
  set_thread_count(0);
}

TEST(Target, FacesAndTrianglesOfOneSurfaceAgree) {
  for (const Vec3& p : query_points(200)) {
    const Footpoint a = waves()[0]->closest(p), b = waves()[1]->closest(p);
    EXPECT_NEAR(a.distance, b.distance, 2e-3);
    if (a.location != Location::kInside || b.location != Location::kInside) continue;
    EXPECT_LT((a.normal - b.normal).norm(), 5e-3);
    EXPECT_NEAR(a.k1, b.k1, 5e-3);
    EXPECT_NEAR(a.k2, b.k2, 5e-3);
  }
}

TEST(Target, AHorizonHidesWhatLiesBeyondIt) {
  for (const auto& target : waves())
    for (const Vec3& p : query_points(100)) {
      const Footpoint all = target->closest(p);
      const double distance = (all.point - p).norm();
      EXPECT_GE(all.patch, 0);
      EXPECT_LT(target->closest_within(p, 0.99 * distance).patch, 0);
      const Footpoint seen = target->closest_within(p, 1.01 * distance + 1e-9);
      EXPECT_GE(seen.patch, 0);
      EXPECT_NEAR(seen.distance, all.distance, 1e-9);
    }
}

/// The signed distance's gradient is the normal, and 1 - d k its derivative along a principal direction.
TEST(Target, TheNormalIsTheGradientOfTheDistance) {
  constexpr double h = 1e-4;
  for (const auto& target : waves()) {
    int inside = 0;
    for (const Vec3& p : query_points(200)) {
      const Footpoint f = target->closest(p);
      if (f.location != Location::kInside || std::abs(f.distance) > 4.0) continue;
      ++inside;
      Vec3 gradient;
      for (int axis = 0; axis < 3; ++axis)
        gradient[axis] = (target->track(p + h * Vec3::Unit(axis), f).distance -
                          target->track(p - h * Vec3::Unit(axis), f).distance) /
                         (2 * h);
      EXPECT_LT((gradient - f.normal).norm(), 2e-4);
      const Footpoint ahead = target->track(p + h * f.d1, f), behind = target->track(p - h * f.d1, f);
      const Vec3 moved = (ahead.point - behind.point) / (2 * h);
      EXPECT_NEAR(moved.dot(f.d1) * (1.0 - f.distance * f.k1), 1.0, 2e-2);
    }
    EXPECT_GT(inside, 50);
  }
}

TEST(Target, MovesWithThePart) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Vec3(1, -2, 2).normalized()).toRotationMatrix();
  const Vec3 shift(200, 100, -50);
  Face face = wave_face();
  for (Vec3& p : face.surface.poles) p = turn * p + shift;
  const auto moved = make_target(std::vector<Face>{face});
  EXPECT_NEAR(moved->area(), waves()[0]->area(), 1e-9);
  for (const Vec3& p : query_points(100)) {
    const Footpoint a = waves()[0]->closest(p), b = moved->closest(turn * p + shift);
    EXPECT_NEAR(a.distance, b.distance, 1e-9);
    EXPECT_LT((turn * a.point + shift - b.point).norm(), 1e-6);
    EXPECT_NEAR(a.k1, b.k1, 1e-6);
    EXPECT_NEAR(a.k2, b.k2, 1e-6);
    EXPECT_EQ(a.location, b.location);
  }
}

TEST(Target, ReversedParametersOrASwapGiveTheSameFootpoints) {
  const Face face = wave_face();
  Face backwards = face;
  BSplineSurface& s = backwards.surface;
  for (int i = 0; i < s.count_u; ++i)
    for (int j = 0; j < s.count_v; ++j) s.pole(i, j) = face.surface.pole(s.count_u - 1 - i, j);
  backwards.reversed = true;  // S_u x S_v turns round with u
  const auto target = make_target(std::vector<Face>{backwards});
  for (const Vec3& p : query_points(100)) {
    const Footpoint a = waves()[0]->closest(p), b = target->closest(p);
    EXPECT_NEAR(a.distance, b.distance, 1e-9);
    EXPECT_LT((a.point - b.point).norm(), 1e-7);
    EXPECT_LT((a.normal - b.normal).norm(), 1e-7);
    EXPECT_NEAR(a.k1, b.k1, 1e-7);
  }
}

TEST(Target, SamplesAndBorderPointsLieOnIt) {
  for (const auto& target : waves()) {
    // A mesh's samples lie on its triangles, not on the smooth surface through their corners.
    const double off = 1.1 * facet_gaps(*target, 0.0).largest_mm;
    double area = 0.0;
    for (const SurfaceSample& s : target->samples(2.0)) {
      area += s.area;
      const Footpoint f = target->closest(s.point + 0.3 * s.normal);
      EXPECT_NEAR(f.distance, 0.3, 1e-6 + off);
      EXPECT_LT((f.normal - s.normal).norm(), 1e-4);
      EXPECT_EQ(target->box().squared_distance(s.point) < 1e-12, true);
    }
    EXPECT_NEAR(area / target->area(), 1.0, 1e-3);
    const std::vector<Vec3> border = target->border_points(1.0);
    EXPECT_GE(border.size(), 140u);
    for (const Vec3& p : border) {
      const double to_side = std::min({std::abs(p[0]), std::abs(p[0] - 40), std::abs(p[1]), std::abs(p[1] - 30)});
      EXPECT_LT(to_side, 1e-6);
    }
  }
}

}  // namespace
}  // namespace flank::internal
