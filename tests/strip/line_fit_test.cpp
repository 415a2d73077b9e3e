// REFINE: its rows against finite differences, and lines that it has to find again.
#include "flank/strip/line_fit.h"

#include <gtest/gtest.h>

#include "cover/cover_targets.h"

namespace flank::internal {
namespace {

using testing::LongSurface;

TEST(LineFit, RowsAreTheDerivativesOfTheDistance) {
  const LongSurface surface;
  const Target& target = *surface.exact.target;
  const double length = surface.tool.axis_length(), h = 1e-4;
  const Pose pose = surface.pose(0.4);
  const LineFrame frame = line_frame(pose, Vec3(1.0, 0.3, -0.2));
  for (const double share : {0.1, 0.5, 0.8}) {
    const double s = share * length;
    const Footpoint foot = target.closest(pose.at(s));
    const Vec5 row = distance_row(frame, foot.normal, 2.0 * share - 1.0);
    for (int k = 0; k < 5; ++k) {
      const Vec5 x = h * Vec5::Unit(k);
      const double up = target.track(moved_line(pose, length, frame, x).at(s), foot).distance;
      const double down = target.track(moved_line(pose, length, frame, -x).at(s), foot).distance;
      EXPECT_NEAR((up - down) / (2.0 * h), row[k], 1e-6) << "s " << s << ", coordinate " << k;
    }
  }
}

TEST(LineFit, FindsTheLineThatTouchesExactly) {
  const LongSurface surface;
  LineFitter fitter(*surface.exact.target, surface.tool, {.tolerance_mm = 1e-3});
  for (const double t : {0.2, 0.5, 0.8}) {
    const Pose start = testing::pose_off(surface.pose(t), 24.0, Vec3(0.3, 0.4, 0.1), Vec3(-0.2, -0.3, 0.1));
    fitter.forget();
    const LineFit off = fitter.measure(start);
    const LineFit found = fitter.refine(start);
    EXPECT_GT(off.largest_mm, 0.1);
    EXPECT_LT(found.largest_mm, 1e-4) << "t " << t;
    EXPECT_EQ(found.inside_share, 1.0);
    EXPECT_LE(fitter.overcut(found.pose), found.largest_mm + 1e-9);
  }
}

TEST(LineFit, EvensTheLargestErrorOut) {
  // A cylinder across a round sheet cannot touch along a line: it sinks until the largest errors have both signs.
  const auto sheet = make_target(make_example("elliptic-side").faces);
  LineFitter fitter(*sheet, testing::cylinder(5.0, 30.0).radial, {.tolerance_mm = 1e-3});
  const std::vector<SurfaceSample> samples = sheet->samples(3.0);
  const Footpoint foot = sheet->closest(samples[samples.size() / 2].point);
  const Vec3 along = std::abs(foot.k1) > std::abs(foot.k2) ? foot.d1 : foot.d2;
  const Pose start{foot.point + 5.0 * foot.normal - 15.0 * along, along};
  const LineFit found = fitter.refine(start);
  ASSERT_TRUE(found.touches());
  const double overcut = fitter.overcut(found.pose);
  EXPECT_NEAR(overcut, found.largest_mm, 0.1 * found.largest_mm);
  EXPECT_EQ(fitter.overcut(found.pose, 0.5 * overcut), overcut);
  EXPECT_EQ(fitter.overcut(found.pose, 2.0 * overcut), 2.0 * overcut);
  fitter.forget();
  EXPECT_LT(found.largest_mm, 0.6 * fitter.measure(start).largest_mm);
}

TEST(LineFit, HoldsTheTravel) {
  const LongSurface surface;
  LineFitter fitter(*surface.exact.target, surface.tool, {.tolerance_mm = 1e-3});
  const Pose start = testing::pose_off(surface.pose(0.5), 24.0, Vec3(0.3, 0.4, 0.1), Vec3(0.3, 0.2, 0.1));
  const Vec3 travel = line_frame(start, Vec3::UnitX()).e1;
  const LineFit found = fitter.refine(start, {travel});
  EXPECT_LT(found.largest_mm, 1e-3);
  EXPECT_NEAR((found.pose.at(12.0) - start.at(12.0)).dot(travel), 0.0, 1e-4);
}

}  // namespace
}  // namespace flank::internal
