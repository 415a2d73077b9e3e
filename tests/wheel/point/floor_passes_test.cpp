// Passes on a floor between two leaning walls leave scallops within their share, climb the walls, and cut nothing.
#include "flank/wheel/point/floor_passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/geom/triangle_bvh.h"
#include "flank/judge.h"
#include "flank/tool.h"
#include "flank/wheel/point/tip_room.h"

namespace flank::internal {
namespace {

constexpr double kLength = 20.0, kWidth = 8.0, kHeight = 5.0, kLean = 0.3, kTip = 1.5, kAxis = 8.0;
constexpr double kTolerance = 0.05;

/// A bilinear face whose normal is du x dv.
Face plane(const Vec3& corner, const Vec3& along_u, const Vec3& along_v) {
  Face face;
  BSplineSurface& s = face.surface;
  s.degree_u = s.degree_v = 1;
  s.count_u = s.count_v = 2;
  s.knots_u = s.knots_v = {0.0, 0.0, 1.0, 1.0};
  s.poles = {corner, corner + along_v, corner + along_u, corner + along_u + along_v};
  return face;
}

void add_plane(const Vec3& corner, const Vec3& along_u, const Vec3& along_v, TriangleMesh& out) {
  const int k = static_cast<int>(out.vertices.size());
  for (const Vec3& p : {corner, Vec3(corner + along_u), Vec3(corner + along_v), Vec3(corner + along_u + along_v)})
    out.vertices.push_back(p);
  out.triangles.push_back({k, k + 1, k + 3});
  out.triangles.push_back({k, k + 3, k + 2});
}

/// Along x; the wheel's axis is far below, so that the floor is nearly flat. A right-handed turn about it goes towards -y.
struct Channel {
  explicit Channel(double widens_mm = 0.0) : widens(widens_mm) {}
  double widens;  ///< from one end to the other, mm
  Vec3 near_up{0.0, -kLean*kHeight, kHeight}, far_up{0.0, kLean*kHeight, kHeight};
  Vec3 along = kLength * Vec3::UnitX(), across = (kWidth + widens) * Vec3::UnitY(), far_corner{0.0, kWidth, 0.0},
       far_along = along + widens * Vec3::UnitY();
  std::unique_ptr<Target> floor = make_target({plane(Vec3::Zero(), along, across)});
  std::unique_ptr<Target> near = make_target({plane(Vec3::Zero(), near_up, along)});
  std::unique_ptr<Target> far = make_target({plane(far_corner, far_along, far_up)});
  TriangleBvh coarse = [this] {
    TriangleMesh all;
    add_plane(Vec3::Zero(), along, across, all);
    add_plane(Vec3::Zero(), near_up, along, all);
    add_plane(far_corner, far_along, far_up, all);
    return TriangleBvh(all);
  }();
  RadialFunction radial{ToolFamily::kCylinder, kAxis, Eigen::VectorXd::Constant(1, kTip)};

  [[nodiscard]] FloorChannel asked() const {
    FloorChannel out;
    out.axis.point = Vec3(0.0, 0.5 * kWidth, -4000.0), out.axis.direction = Vec3::UnitX();
    out.floor = {floor.get()}, out.first = {far.get()}, out.second = {near.get()};
    out.walls = {near.get(), far.get()};
    out.coarse = &coarse;
    return out;
  }
  [[nodiscard]] Path passes(bool finished) const {
    PointOptions options;
    options.tolerance_mm = kTolerance;
    options.is_finished = [finished](const Vec3&) { return finished; };
    Path path;
    path.strips = point_passes(asked(), radial, options, "F1", "F2", "F3");
    return path;
  }
};

struct Left {
  double least = 1e300, most = -1e300;
};

/// What the path leaves of a flat face between shares of its sides; < 0: cut.
Left left_of(const SweptVolume& volume, const Vec3& corner, const Vec3& u, const Vec3& v, double from, double to) {
  Left out;
  for (double x = 0.1; x <= 0.9; x += 0.031)
    for (double y = from; y <= to; y += 0.013) {
      const double f = volume.distance(corner + x * u + y * v).f;
      out.least = std::min(out.least, f), out.most = std::max(out.most, f);
    }
  return out;
}

TEST(PointPasses, FinishFloorAndWallsAndCutNothing) {
  const Channel channel;
  const Path path = channel.passes(false);
  ASSERT_GT(path.strips.size(), 5U);
  Tool tool;
  tool.radial = channel.radial;
  const SweptVolume volume(tool, path);
  // The tip stands off its corner by its radius times the tangent of half of what is left of a straight angle.
  const double corner = kTip * std::tan(0.5 * (0.5 * M_PI - std::atan(kLean)));
  const Left floor =
      left_of(volume, Vec3::Zero(), channel.along, channel.across, corner / kWidth, 1.0 - corner / kWidth);
  EXPECT_GE(floor.least, -1e-6);
  EXPECT_LE(floor.most, kTolerance);
  EXPECT_GT(floor.most, 0.3 * kTolerance) << "passes that are closer than the tolerance asks for take time for nothing";
  for (const bool near : {true, false}) {
    const Vec3 up = near ? channel.near_up : channel.far_up, at = near ? Vec3::Zero() : channel.far_corner;
    const Left wall = left_of(volume, at, channel.along, up, corner / up.norm(), 0.95);
    EXPECT_GE(wall.least, -0.4 * kTolerance);
    EXPECT_LE(wall.most, kTolerance);
  }
}

/// Passes that were a share of the way across would be closer than they need be where the channel is narrow.
TEST(PointPasses, AreNoCloserThanTheScallopAsksWhereTheChannelIsNarrow) {
  constexpr double kWidens = 12.0;
  const Channel channel(kWidens);
  const Path path = channel.passes(true);
  Tool tool;
  tool.radial = channel.radial;
  const SweptVolume volume(tool, path);
  const double corner = kTip * std::tan(0.5 * (0.5 * M_PI - std::atan(kLean)));
  for (const double x : {0.2, 0.5, 0.8}) {  // pieces across of which the floor is about a rectangle
    const double width = kWidth + x * kWidens;
    const Left floor = left_of(volume, (x - 0.05) * channel.along, 0.1 * channel.along, width * Vec3::UnitY(),
                               (corner + 0.1) / width, 1.0 - (corner + 0.7) / width);
    EXPECT_GE(floor.least, -1e-6);
    EXPECT_LE(floor.most, kTolerance);
  }
  double ours = 0.0;
  for (const Strip& strip : path.strips)
    for (std::size_t k = 1; k < strip.poses.size(); ++k) ours += (strip.poses[k].tip - strip.poses[k - 1].tip).norm();
  const double apart = std::sqrt(8.0 * PointOptions().scallop_share * kTolerance * kTip),
               area = kLength * (kWidth + 0.5 * kWidens - 2.0 * corner);
  EXPECT_LT(ours, 1.12 * (area / apart + kLength));
}

/// Something that stands far above the flank, over the middle of the channel.
TEST(PointPasses, TheAxisKeepsOutOfWhatStandsFarAboveTheFlank) {
  constexpr double kUp = 40.0, kHalf = 10.0;
  const Channel channel;
  TriangleMesh bar;
  add_plane(Vec3(-kLength, 0.5 * kWidth - kHalf, kUp), 3.0 * channel.along, 2.0 * kHalf * Vec3::UnitY(), bar);
  const TriangleBvh wheel(bar);
  FloorChannel asked = channel.asked();
  PointOptions options;
  options.tolerance_mm = kTolerance;
  options.is_finished = [](const Vec3&) { return true; };
  const auto through = [&](const std::vector<Strip>& strips) {
    int out = 0;
    for (const Strip& strip : strips)
      for (const Pose& pose : strip.poses) {
        const double s = (kUp - pose.tip.z()) / pose.axis.z();
        if (std::abs(pose.at(s).y() - 0.5 * kWidth) < kHalf) ++out;
      }
    return out;
  };
  EXPECT_GT(through(point_passes(asked, channel.radial, options, "F1", "F2", "F3")), 0);
  asked.wheel = &wheel, asked.reach_mm = 2.0 * kUp;
  const std::vector<Strip> strips = point_passes(asked, channel.radial, options, "F1", "F2", "F3");
  EXPECT_GT(strips.size(), 5U);
  EXPECT_EQ(through(strips), 0);
  // A shank has a radius: beside the bar there is no room either.
  const double rod = options.shank_mm = 0.5, beside = 0.5 * kWidth + kHalf;
  const TipRoom room(asked, channel.radial, options);
  EXPECT_FALSE(room.is_free({Vec3(0.5 * kLength, beside + 0.9 * rod, 8.0), Vec3::UnitZ()}));
  EXPECT_TRUE(room.is_free({Vec3(0.5 * kLength, beside + 2.0 * rod + 0.02 * kUp, 8.0), Vec3::UnitZ()}));
}

TEST(PointPasses, AWallThatIsFinishedHasNone) {
  const Channel channel;
  const Path path = channel.passes(true);
  ASSERT_FALSE(path.strips.empty());
  for (const Strip& strip : path.strips) EXPECT_EQ(strip.kind, "floor");
}

TEST(PointPasses, SidesThatDoNotStandOnTheFloorHaveNone) {
  const Channel channel;
  FloorChannel asked = channel.asked();
  const auto beside = make_target({plane(Vec3(0.0, 0.0, 50.0), channel.near_up, channel.along)});
  asked.second = {beside.get()};
  EXPECT_TRUE(point_passes(asked, channel.radial, {}, "F1", "F2", "F3").empty());
}

}  // namespace
}  // namespace flank::internal
