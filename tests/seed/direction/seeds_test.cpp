// Where lines are begun: places that follow the shape, directions that the filter leaves.
#include "flank/seed/direction/seeds.h"

#include <gtest/gtest.h>

#include "cover/cover_targets.h"
#include "flank/seed/direction/shape_places.h"

namespace flank::internal {
namespace {

/// Flat for x < 50, then rolled up with radius 10 over a quarter of a turn.
std::unique_ptr<Target> rolled_sheet() {
  constexpr double kRadius = 10.0, kFlat = 50.0, kArc = 1.5707963267948966 * kRadius;
  std::vector<double> u, v = {0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0};
  for (int i = 0; i <= 200; ++i) u.push_back(i / 200.0);
  std::vector<Vec3> points;
  for (const double a : u) {
    const double way = a * (kFlat + kArc), turn = std::max(0.0, way - kFlat) / kRadius;
    for (const double b : v)
      points.emplace_back(std::min(way, kFlat) + kRadius * std::sin(turn), 30.0 * b, kRadius * (1.0 - std::cos(turn)));
  }
  Face face;
  face.id = "F1";
  face.surface = interpolate_grid(points, u, v, 3);
  return make_target(std::vector<Face>{face});
}

TEST(ShapePlaces, AreDenserWhereTheTargetBends) {
  const auto sheet = rolled_sheet();
  const std::vector<SurfaceSample> places = shape_places(*sheet, 20);
  ASSERT_EQ(places.size(), 20u);
  const auto bent =
      std::count_if(places.begin(), places.end(), [](const SurfaceSample& p) { return p.point.x() > 50.0; });
  EXPECT_GE(bent, 12) << "a quarter of the area, and all of the curvature";
  EXPECT_LE(bent, 19);
}

TEST(ShapePlaces, SpreadOverAFlatTarget) {
  const auto sheet = testing::flat_target(0.0, 60.0, 0.0, 40.0);
  const std::vector<SurfaceSample> places = shape_places(*sheet, 24);
  for (const SurfaceSample& sample : sheet->samples(4.0)) {
    double nearest = 1e300;
    for (const SurfaceSample& place : places) nearest = std::min(nearest, (place.point - sample.point).norm());
    EXPECT_LT(nearest, 13.0) << "a place stands for 10 x 10 mm";
  }
}

TEST(AdmissibleSeeds, HoldATrueLineOfAnExactEnvelope) {
  const testing::LongSurface surface;
  const Pose truth = surface.pose(0.5);
  const double s = 12.0;
  const Footpoint foot = surface.exact.target->closest(truth.at(s));
  const std::vector<LineSeed> seeds =
      admissible_seeds(*surface.exact.target, {{foot.point, foot.normal}}, surface.tool, 1, 1e-3);
  ASSERT_FALSE(seeds.empty());
  double nearest = 1e300;
  for (const LineSeed& seed : seeds)
    nearest = std::min(nearest, (seed_pose(seed, surface.tool).axis - truth.axis).norm());
  EXPECT_LT(nearest, 1e-4) << "contact of second order is that of the envelope";
}

TEST(AdmissibleSeeds, LeaveTurnedRoundTwinsOut) {
  const auto sheet = make_target(make_example("elliptic-side").faces);
  const std::vector<SurfaceSample> places = grid_places(*sheet, 10);
  const RadialFunction cylinder = testing::cylinder(3.0, 10.0).radial;
  const RadialFunction cone(ToolFamily::kCone, 10.0, Eigen::Vector2d(3.0, 0.05));
  const auto equal_ends = admissible_seeds(*sheet, places, cylinder, 1, 0.05);
  ASSERT_FALSE(equal_ends.empty());
  for (std::size_t a = 0; a < equal_ends.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_TRUE(equal_ends[a].point != equal_ends[b].point ||
                  equal_ends[a].direction.dot(equal_ends[b].direction) > -1.0 + 1e-6);
  EXPECT_GT(admissible_seeds(*sheet, places, cone, 1, 0.05).size(), equal_ends.size());
  EXPECT_TRUE(admissible_seeds(*sheet, places, cone, 1, 1e-9).size() < equal_ends.size()) << "the filter rejects";
}

}  // namespace
}  // namespace flank::internal
