// Passes along a round edge leave no more than the tolerance on it, and cut nothing.
#include "flank/wheel/point/face_passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "flank/geom/tessellate.h"
#include "flank/judge.h"
#include "flank/wheel/finished_places.h"
#include "flank/wheel/point/face_lines.h"
#include "flank/wheel/point/flank_joints.h"
#include "flank/wheel/point/tip_room.h"

namespace flank::internal {
namespace {

constexpr double kEdge = 0.4, kSpan = 12.0, kTip = 0.5, kTolerance = 0.05;

/// Half a cylinder along z, its outward side that of the edge of a blade that lies behind x = 0.
Face half_cylinder() {
  constexpr int kAcross = 25, kAlong = 4;
  std::vector<Vec3> points;
  std::vector<double> u, v;
  for (int i = 0; i < kAcross; ++i) u.push_back(i / (kAcross - 1.0));
  for (int j = 0; j < kAlong; ++j) v.push_back(j / (kAlong - 1.0));
  for (const double a : u)
    for (const double b : v) points.emplace_back(kEdge * std::sin(M_PI * a), -kEdge * std::cos(M_PI * a), kSpan * b);
  Face face;
  face.id = "F1";
  face.surface = interpolate_grid(points, u, v, 3);
  return face;
}

struct Edge {
  Face face = half_cylinder();
  std::unique_ptr<Target> target = make_target({face});
  TriangleBvh coarse{tessellate(face, {.chord_mm = 0.005}).mesh};
  Tool tool;
  Edge() { tool.radial = RadialFunction(ToolFamily::kCone, 6.0, Eigen::Vector2d(kTip, 0.1)); }

  /// `tilt_deg`: of the axis from +y, at most; none: any.
  [[nodiscard]] std::vector<Strip> passes(
      bool finished, std::optional<double> tilt_deg = {},
      const std::function<std::optional<SurfaceLeft>(const Vec3&)>& left_by_flank = {}, bool joins = false) const {
    FloorChannel around;
    around.walls = {target.get()};
    around.coarse = &coarse;
    PointOptions options;
    options.tolerance_mm = kTolerance;
    if (tilt_deg) options.held = {Vec3::UnitY(), *tilt_deg * M_PI / 180.0};
    options.left_by_flank = left_by_flank, options.joins_flank = joins;
    if (finished) options.is_finished = [](const Vec3&) { return true; };
    return face_passes(face, around, tool.radial, options, "edge", "F1");
  }
};

TEST(FacePasses, FinishARoundEdgeAndCutNothing) {
  const Edge edge;
  Path path;
  path.strips = edge.passes(false);
  ASSERT_GE(path.strips.size(), 5U);
  const SweptVolume volume(edge.tool, path);
  double most = -1e300, least = 1e300;
  for (const SurfaceSample& sample : edge.target->samples(0.07)) {
    const double f = volume.distance(sample.point).f;
    most = std::max(most, f), least = std::min(least, f);
  }
  EXPECT_LE(most, kTolerance);
  EXPECT_GT(most, 0.3 * kTolerance) << "passes that are closer than the tolerance asks for take time for nothing";
  EXPECT_GE(least, -1e-3);
}

TEST(FacePasses, RunAlongTheLongerDirection) {
  for (const Strip& strip : Edge().passes(false)) {
    EXPECT_EQ(strip.kind, "edge");
    EXPECT_GT(std::abs(strip.poses.back().tip.z() - strip.poses.front().tip.z()), 0.9 * kSpan);
  }
}

TEST(FacePasses, LeanNoFartherThanAMachineTilts) {
  const auto largest = [](const std::vector<Strip>& strips) {
    double most = 0.0;
    for (const Strip& strip : strips)
      for (const Pose& pose : strip.poses) most = std::max(most, std::acos(pose.axis.y()));
    return most * 180.0 / M_PI;
  };
  EXPECT_GT(largest(Edge().passes(false)), 60.0);
  const std::vector<Strip> held = Edge().passes(false, 60.0);
  EXPECT_GE(held.size(), 3U);
  EXPECT_LE(largest(held), 60.0 + 1e-9);
}

TEST(FacePasses, WhatIsFinishedHasNone) { EXPECT_TRUE(Edge().passes(true).empty()); }

/// Half of the border's length is beside a side that a flank has finished, too deep.
TEST(FacePasses, GoOnAlongTheBorderFromWhatTheFlankHasLeft) {
  constexpr double kCut = 0.03, kLean = 0.05;
  const Edge edge;
  const auto left = [&](const Vec3& x) -> std::optional<SurfaceLeft> {
    if (x.z() > 0.5 * kSpan) return {};
    const Footpoint foot = edge.target->closest(x);
    return SurfaceLeft{-kCut, (foot.normal + kLean * Vec3::UnitZ()).normalized()};
  };
  const std::vector<Strip> plain = edge.passes(false), strips = edge.passes(false, {}, left);
  ASSERT_EQ(strips.size(), plain.size()) << "a step along a pass would be a kink, and cut it";
  int joined = 0, alone = 0;
  for (const Strip* strip : {&strips.front(), &strips.back()})
    for (const Pose& pose : strip->poses) {
      const Footpoint foot = edge.target->closest(pose.tip);
      if (pose.tip.z() < 0.45 * kSpan && pose.tip.z() > 0.1) {
        // It touches the surface that is left, where that is the border's.
        const Vec3 touched = pose.tip - kTip * (foot.normal + kLean * Vec3::UnitZ()).normalized();
        EXPECT_NEAR(edge.target->closest(touched).distance, -kCut, 1e-3);
        ++joined;
      } else if (pose.tip.z() > 0.9 * kSpan) {
        EXPECT_NEAR(foot.distance, kTip + 0.1 * kTolerance, 1e-6);
        ++alone;
      }
    }
  EXPECT_GT(joined, 20);
  EXPECT_GT(alone, 4);
}

/// Scallops of other passes end at a border of a fillet within the tolerance, and as a step beside what the flank has left.
TEST(FacePasses, JoinTheFlankWhereAllIsFinishedToo) {
  const Edge edge;
  const auto left = [&](const Vec3& x) -> std::optional<SurfaceLeft> {
    if (x.z() > 0.5 * kSpan) return {};
    return SurfaceLeft{0.0, edge.target->closest(x).normal};
  };
  EXPECT_TRUE(edge.passes(true, {}, left).empty());
  const std::vector<Strip> strips = edge.passes(true, {}, left, true);
  ASSERT_EQ(strips.size(), 2U) << "one along each border";
  for (const Strip& strip : strips) {
    const auto [low, high] = std::minmax(strip.poses.front().tip.z(), strip.poses.back().tip.z());
    EXPECT_LT(low, 0.1);
    EXPECT_NEAR(high, 0.5 * kSpan, 3.0) << "no farther than where the flank ends";
    for (const Pose& pose : strip.poses) EXPECT_LT(std::abs(std::abs(pose.tip.y()) - kEdge - kTip), 0.02);
  }
}

/// Half of the border's length is beside a side on which the flank has left material: passes close to it would cut into that.
TEST(FlankJoints, KeepPassesBesideOffWhatTheFlankHasLeft) {
  constexpr double kLeft = 0.03;
  const Edge edge;
  FloorChannel around;
  around.walls = {edge.target.get()};
  const PointOptions options;
  const TipRoom room(around, edge.tool.radial, options);
  const FaceLines lines(edge.face, kTip, 0.002, 0.5);
  ASSERT_GE(lines.lines(), 12U);
  const auto left = [&](const Vec3& x) -> std::optional<SurfaceLeft> {
    if (x.z() > 0.5 * kSpan) return {};
    return SurfaceLeft{kLeft, edge.target->closest(x).normal};
  };
  const FlankJoints joints(lines, room, left);
  double least = 1e300, most_up = 0.0;
  for (std::size_t n = 1; n + 1 < lines.lines(); ++n)
    for (double place = 0.0; place < 0.45 * kSpan / 0.5; place += 0.25) {
      const FaceLines::Place here = lines.at(n, place).value();
      const Vec3 moved = joints.at(n, place, here).moved;
      most_up = std::max(most_up, moved.dot(here.normal));
      for (const std::size_t border : {std::size_t{0}, lines.lines() - 1})
        least = std::min(least,
                         (here.point + room.lift_mm() * here.normal + moved - lines.at(border, place)->point).norm());
    }
  EXPECT_GE(least, kTip + kLeft - 1e-9);
  EXPECT_GT(most_up, 0.3 * kLeft);
  EXPECT_GT(joints.stops(1).size(), 2 * lines.places()) << "chords between few poses would cut as well";
  EXPECT_EQ(joints.stops(lines.lines() / 2).size(), lines.places());
  const double last = static_cast<double>(lines.places()) - 1.0;
  EXPECT_LT(joints.at(1, last, *lines.at(1, last)).moved.norm(), 1e-12) << "no flank has been there";
}

/// A flank goes straight from pose to pose: what it leaves is plane there, and turns at each pose. Poses of the pass beside it that are
/// spread evenly would round that.
TEST(FlankJoints, StopWhereTheFlankTurns) {
  constexpr double kApart = 1.7, kTurn = 0.004, kRound = 0.05;  // mm, radians, and mm in which it turns
  const Edge edge;
  const auto lean = [](double z) {
    const double at = z / kApart, whole = std::floor(at);
    return kTurn * (whole + std::clamp((at - whole - 1.0) * kApart / kRound + 1.0, 0.0, 1.0) - 4.0);
  };
  const auto left = [&](const Vec3& x) -> std::optional<SurfaceLeft> {
    return SurfaceLeft{0.0, (edge.target->closest(x).normal + lean(x.z()) * Vec3::UnitZ()).normalized()};
  };
  FloorChannel around;
  around.walls = {edge.target.get()};
  const PointOptions options;
  const TipRoom room(around, edge.tool.radial, options);
  const FaceLines lines(edge.face, kTip, 0.002, 0.5);
  const FlankJoints joints(lines, room, left);
  const std::vector<double> stops = joints.stops(0);
  double most = 0.0;
  for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
    ASSERT_LT(stops[k], stops[k + 1]);
    const double a = lines.at(0, stops[k])->point.z(), b = lines.at(0, stops[k + 1])->point.z();
    most = std::max(most, std::abs(lean(b) - lean(a)));
  }
  EXPECT_LT(most, 0.6 * kTurn) << "a turn is followed, and not passed over in one step";
  EXPECT_LT(stops.size(), 2 * (8 * lines.places())) << "only where it turns";
}

/// What the flank has left has an edge: stops ever nearer to it would make a corner of the pass.
TEST(FlankJoints, DoNotJumpAcrossAnEdge) {
  const Edge edge;
  const auto left = [&](const Vec3& x) -> std::optional<SurfaceLeft> {
    const double lean = x.z() < 0.4 * kSpan ? 0.1 : -0.1;
    return SurfaceLeft{0.0, (edge.target->closest(x).normal + lean * Vec3::UnitY()).normalized()};
  };
  FloorChannel around;
  around.walls = {edge.target.get()};
  const PointOptions options;
  const TipRoom room(around, edge.tool.radial, options);
  const FaceLines lines(edge.face, kTip, 0.002, 0.5);
  EXPECT_EQ(FlankJoints(lines, room, left).stops(0).size(), 8 * (lines.places() - 1) + 1);
}

TEST(FaceLines, AreNearerToEachOtherWhereTheSphereIsSmaller) {
  const Face face = half_cylinder();
  EXPECT_GT(FaceLines(face, 0.2, 0.02, 0.5).lines(), FaceLines(face, 2.0, 0.02, 0.5).lines());
  EXPECT_EQ(FaceLines(face, 0.5, 0.02, 0.5).places(), 25U);
}

/// A strip of a plane that lies aslant in its parameters, as trimmed planes of a CAD file do.
Face slanting_strip() {
  Face face;
  BSplineSurface& s = face.surface;
  s.degree_u = s.degree_v = 1, s.count_u = s.count_v = 2;
  s.knots_u = s.knots_v = {0.0, 0.0, 1.0, 1.0};
  s.poles = {Vec3(0, 0, 0), Vec3(0, 20, 0), Vec3(40, 0, 0), Vec3(40, 20, 0)};
  const std::vector<Vec2> corners{{0.0, 0.0}, {0.05, 0.0}, {1.0, 0.95}, {1.0, 1.0}, {0.95, 1.0}, {0.0, 0.05}};
  TrimLoop loop;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    BSplineCurve2 edge;
    edge.degree = 1, edge.knots = {0.0, 0.0, 1.0, 1.0};
    edge.poles.resize(2, 2);
    edge.poles << corners[k], corners[(k + 1) % corners.size()];
    loop.edges.push_back(edge);
  }
  face.loops = {loop};
  return face;
}

TEST(FaceLines, OfAStripThatLiesAslantRunAlongIt) {
  const Face face = slanting_strip();
  const FaceLines lines(face, 0.5, 0.025, 0.5);
  EXPECT_LT(lines.lines(), 12U);
  const std::size_t middle = lines.lines() / 2;
  int there = 0;
  for (std::size_t k = 0; k < lines.places(); ++k) there += lines.at(middle, static_cast<double>(k)) ? 1 : 0;
  EXPECT_GT(there, 0.9 * static_cast<double>(lines.places()));
  EXPECT_GT(static_cast<double>(there) * 0.5, 0.9 * std::hypot(40.0, 20.0));
}

TEST(FinishedPlaces, AreThoseThatAPoseComesNearTo) {
  const RadialFunction radial(ToolFamily::kCylinder, 10.0, Eigen::VectorXd::Constant(1, 2.0));
  Strip strip;
  for (int k = 0; k <= 40; ++k) strip.poses.push_back({Vec3(0.5 * k, 0.0, 0.0), Vec3::UnitZ()});
  const FinishedPlaces finished({strip}, radial, 0.05);
  EXPECT_TRUE(finished(Vec3(10.0, 2.04, 5.0)));
  EXPECT_TRUE(finished(Vec3(10.0, 0.0, -1.99)));
  EXPECT_FALSE(finished(Vec3(10.0, 2.06, 5.0)));
  EXPECT_FALSE(finished(Vec3(30.0, 2.0, 5.0)));
  // Strips all over, one of which is near: the same as each of them alone says.
  std::vector<Strip> strips;
  for (int n = 0; n < 12; ++n) {
    Strip& one = strips.emplace_back();
    for (int k = 0; k <= 30; ++k)
      one.poses.push_back({Vec3(0.5 * k, 3.0 * n, 0.3 * n), Vec3(0.02 * k, 0.1 * n, 1.0).normalized()});
  }
  const FinishedPlaces all(strips, radial, 0.05);
  int inside = 0;
  for (int k = 0; k < 400; ++k) {
    const Vec3 x(0.05 * k, 0.11 * ((7 * k) % 331), -2.0 + 0.05 * ((13 * k) % 337));
    const bool by_one = std::any_of(strips.begin(), strips.end(),
                                    [&](const Strip& one) { return FinishedPlaces({one}, radial, 0.05)(x); });
    EXPECT_EQ(all(x), by_one) << k;
    inside += by_one ? 1 : 0;
  }
  EXPECT_GT(inside, 40);
  EXPECT_LT(inside, 360);
}

TEST(FinishedPlaces, LeaveWhatTheJudgeFinds) {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCone, 12.0, Eigen::Vector2d(0.5, 0.2));
  Path path;
  Strip& strip = path.strips.emplace_back();
  for (int k = 0; k <= 20; ++k)
    strip.poses.push_back({Vec3(0.7 * k, 0.004 * k * k, 0.0), Vec3(0.3, 0.02 * k, 1.0).normalized()});
  const FinishedPlaces finished(path.strips, tool.radial, 0.05);
  const SweptVolume volume(tool, path);
  int near = 0;
  for (int k = 0; k < 40; ++k) {
    // On the flank of a pose between two, and a little off it.
    const double t = 0.5 + 0.47 * k, s = 1.0 + 0.25 * k, share = t - std::floor(t);
    const Pose &a = strip.poses[static_cast<std::size_t>(t)], &b = strip.poses[static_cast<std::size_t>(t) + 1];
    const Pose pose{(1.0 - share) * a.tip + share * b.tip, ((1.0 - share) * a.axis + share * b.axis).normalized()};
    const Vec3 out = pose.axis.cross(b.tip - a.tip).normalized(), x = pose.at(s) + tool.radial.at(s).r * out;
    const SweptDistance judged = volume.distance(x, 1.0);
    const std::optional<SurfaceLeft> left = finished.left(x);
    ASSERT_EQ(left.has_value(), judged.f <= 0.05) << k;
    if (!left) continue;
    ++near;
    EXPECT_NEAR(left->height_mm, judged.f, 1e-5) << k;
    EXPECT_NEAR(left->normal.norm(), 1.0, 1e-12);
  }
  EXPECT_GT(near, 20);
}

}  // namespace
}  // namespace flank::internal
