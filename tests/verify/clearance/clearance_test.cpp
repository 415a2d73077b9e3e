#include "flank/clearance.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <memory>
#include <string>

#include "flank/error.h"
#include "flank/threads.h"
#include "flank/verify/clearance/flank_profile.h"
#include "flank/verify/clearance/motion_gap.h"
#include "flank/verify/swept/pose_tree.h"
#include "verify/clearance/clearance_fixture.h"

namespace flank::internal::verify {
namespace {

Tool cylinder(double radius, double length) {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, length, Eigen::VectorXd::Constant(1, radius));
  return tool;
}

Tool with_holder() {
  Tool tool = cylinder(4.0, 20.0);
  tool.shank = {{20.0, 4.0}, {50.0, 4.0}};
  tool.holder = {{50.0, 10.0}, {90.0, 14.0}};
  return tool;
}

const ClearanceFigure& figure_of(const ClearanceReport& report, ToolBody body, ObstacleRole role) {
  for (const ClearanceFigure& f : report.figures)
    if (f.body == body && f.role == role) return f;
  throw std::runtime_error("no such figure");
}

/// Whether all is kept, by figures and by the look that ends at the first that is not.
bool kept(const Tool& tool, const Path& path, const std::vector<Obstacle>& obstacles, const ClearanceOptions& options) {
  const bool by_figures = judge_clearance(tool, path, obstacles, options).kept();
  EXPECT_EQ(keeps_clear(tool, path, obstacles, options), by_figures);
  return by_figures;
}

TEST(ClearanceVerdict, StillToolOverPlane) {
  const Path path = path_of({{Vec3(0, 0, 10), Vec3::UnitZ()}, {Vec3(5, 0, 10), Vec3::UnitZ()}});
  const std::vector<Obstacle> obstacles = {{"F2", ObstacleRole::kPart, square(200, 55.0), 0.0},
                                           {"vice", ObstacleRole::kFixture, square(200, 3.0), 0.02}};
  const ClearanceReport report = judge_clearance(with_holder(), path, obstacles, {});
  ASSERT_EQ(report.figures.size(), 5u);
  // The plane at z = 55 is 25 above the shank's lower end and 5 below the holder.
  EXPECT_NEAR(figure_of(report, ToolBody::kHolder, ObstacleRole::kPart).clearance_mm, 5.0, 1e-9);
  EXPECT_NEAR(figure_of(report, ToolBody::kShank, ObstacleRole::kPart).clearance_mm, -4.0, 0.09);
  // The flank's round end reaches 4 below the tip.
  const ClearanceFigure& flank = figure_of(report, ToolBody::kFlank, ObstacleRole::kFixture);
  EXPECT_NEAR(flank.clearance_mm, 3.0, 1e-9);
  EXPECT_NEAR(flank.bound_mm, 1e-3 + 0.02 + kFlankProfileErrorMm, 1e-12);
  EXPECT_EQ(flank.obstacle, "vice");
  EXPECT_FALSE(report.kept());
  EXPECT_EQ(report.worst()->body, ToolBody::kShank);
}

/// The same obstacles, each made when it is asked for, and how many were.
ObstacleSet distant(const std::vector<Obstacle>& obstacles, std::shared_ptr<std::atomic<int>> made) {
  std::vector<DistantObstacle> all;
  for (const Obstacle& o : obstacles)
    all.push_back({o.name, o.role, o.mesh.box(), [o, made] {
                     ++*made;
                     return o;
                   }});
  return ObstacleSet(std::move(all));
}

TEST(ClearanceVerdict, OnlyWhatTheToolComesNearToIsMade) {
  const Path path = path_of({{Vec3(0, 0, 10), Vec3::UnitZ()}, {Vec3(5, 3, 10), Vec3(0.3, 0, 1).normalized()}});
  std::vector<Obstacle> obstacles = {{"near", ObstacleRole::kPart, square(5, 61.0), 0.0},
                                     {"under", ObstacleRole::kTarget, square(30, -5.0), 0.0}};
  for (int k = 0; k < 20; ++k)
    obstacles.push_back({"far " + std::to_string(k), k % 2 == 0 ? ObstacleRole::kPart : ObstacleRole::kFixture,
                         square(200, 400.0 + 50.0 * k), 0.01});
  const auto made = std::make_shared<std::atomic<int>>(0);
  const ObstacleSet set = distant(obstacles, made);
  ASSERT_TRUE(keeps_clear(with_holder(), path, {obstacles[1]}, {}));
  EXPECT_EQ(keeps_clear(with_holder(), path, set, {}), keeps_clear(with_holder(), path, obstacles, {}));
  EXPECT_LE(made->load(), 2);
  const ClearanceReport lazy = judge_clearance(with_holder(), path, set, {}),
                        whole = judge_clearance(with_holder(), path, obstacles, {});
  ASSERT_EQ(lazy.figures.size(), whole.figures.size());
  for (std::size_t k = 0; k < lazy.figures.size(); ++k) {
    EXPECT_EQ(lazy.figures[k].obstacle, whole.figures[k].obstacle);
    EXPECT_NEAR(lazy.figures[k].clearance_mm, whole.figures[k].clearance_mm, 1e-3);
  }
  EXPECT_NEAR(lazy.pose_clearance_mm[0][1], whole.pose_clearance_mm[0][1], kPoseClearanceMm);
  EXPECT_EQ(figure_of(lazy, ToolBody::kFlank, ObstacleRole::kFixture).obstacle, "far 1")
      << "what is nearest is told however far it is";
  EXPECT_LT(made->load(), 22);
  // What was asked before changes no answer.
  const ClearanceReport again = judge_clearance(with_holder(), path, set, {});
  for (std::size_t k = 0; k < lazy.figures.size(); ++k)
    EXPECT_EQ(lazy.figures[k].clearance_mm, again.figures[k].clearance_mm);
}

TEST(ClearanceVerdict, RequirementsAndWhoMayTouch) {
  // The shank touches the target at 0 and the holder keeps 5 from it.
  const Path path = path_of({{Vec3::Zero(), Vec3::UnitZ()}, {Vec3(0, 5, 0), Vec3::UnitZ()}});
  TriangleMesh wall{{{4, -50, 0}, {4, 50, 0}, {4, 50, 45}, {4, -50, 45}}, {{0, 1, 2}, {0, 2, 3}}};
  ClearanceOptions options;
  options.required_mm = 3.0;
  ClearanceReport report = judge_clearance(with_holder(), path, {{"F1", ObstacleRole::kTarget, wall, 0.0}}, options);
  EXPECT_TRUE(report.kept());
  EXPECT_TRUE(keeps_clear(with_holder(), path, {{"F1", ObstacleRole::kTarget, wall, 0.0}}, options, -0.01));
  EXPECT_FALSE(keeps_clear(with_holder(), path, {{"F1", ObstacleRole::kTarget, wall, 0.0}}, options, 0.01))
      << "a shank may touch, but not where more is asked of it";
  EXPECT_NEAR(figure_of(report, ToolBody::kShank, ObstacleRole::kTarget).clearance_mm, 0.0, 1e-9);
  EXPECT_NEAR(figure_of(report, ToolBody::kHolder, ObstacleRole::kTarget).clearance_mm, 5.0, 1e-9);
  options.required_mm = 5.5;
  EXPECT_FALSE(kept(with_holder(), path, {{"F1", ObstacleRole::kTarget, wall, 0.0}}, options));
  // As another face of the part the shank must keep the clearance as well.
  options.required_mm = 3.0;
  EXPECT_FALSE(kept(with_holder(), path, {{"F1", ObstacleRole::kPart, wall, 0.0}}, options));
  options.required_mm = -1.0;
  EXPECT_TRUE(kept(with_holder(), path, {{"F1", ObstacleRole::kPart, wall, 0.0}}, options));
}

/// A post that stands between two poses: both ends are free.
TEST(ClearanceVerdict, CollisionBetweenTwoFreePoses) {
  const TriangleMesh post{{{0, -1, 60}, {0, 1, 60}, {0, 0, 62}}, {{0, 1, 2}}};
  const std::vector<Obstacle> obstacles = {{"post", ObstacleRole::kFixture, post, 0.0}};
  const Tool tool = with_holder();
  const Pose left{Vec3(-300, 0, 0), Vec3::UnitZ()}, right{Vec3(411, 0, 0), Vec3(0.1, 0.2, 1).normalized()};
  for (const Pose& end : {left, right}) {
    EXPECT_TRUE(kept(tool, path_of({end}), obstacles, {}));
  }
  const ClearanceReport report = judge_clearance(tool, path_of({left, right}), obstacles, {});
  EXPECT_FALSE(report.kept());
  const ClearanceFigure& holder = figure_of(report, ToolBody::kHolder, ObstacleRole::kFixture);
  EXPECT_LT(holder.clearance_mm, -5.0);
  EXPECT_GT(holder.t, 0.2);
  EXPECT_LT(holder.t, 0.8);
}

/// Random motions against random triangles: the truth is sought by dense sampling in time.
TEST(MotionGap, BoundHoldsAlongRandomMotions) {
  Random random(3);
  for (int k = 0; k < 40; ++k) {
    TriangleMesh mesh;
    for (int i = 0; i < 12; ++i) {
      const Vec3 middle = random_point(random, 40.0);
      for (int c = 0; c < 3; ++c) mesh.vertices.emplace_back(middle + random_point(random, 8.0));
      mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const Vec3 axis = random_unit(random), tip = 60.0 * random_unit(random);
    std::vector<Pose> poses;
    for (int i = 0; i < 4; ++i)
      poses.push_back({tip + random_point(random, 15.0), (axis + 0.4 * random_unit(random)).normalized()});
    const std::vector<Revolved> body = convex_bodies({{2, 3}, {12, 3}, {12, 6}, {20, 7}, {24, 5}});
    const std::vector<Segment> segments = PoseTree(path_of(poses), 24.0, 1e300).segments;
    const ObstacleTree tree(mesh);
    const GapPlace found = MotionGap(body, tree, segments).least(1e-3, 1e300);
    double truth = 1e300;
    for (const Segment& segment : segments) {
      for (int i = 0; i <= 400; ++i) {
        const GapPlace still = MotionGap(body, tree,
                                         std::vector<Segment>{{segment.at(i / 400.0).tip, Vec3::Zero(),
                                                               segment.at(i / 400.0).axis, Vec3::Zero(), 0, 0}})
                                   .least(1e-3, 1e300);
        truth = std::min(truth, still.value);
      }
    }
    EXPECT_GE(truth, found.value - gap_bound(found.value, 1e-3)) << k;
    EXPECT_LE(found.value, truth + 0.4 * 0.2) << k;  // the samples lie up to a fifth of a millimetre apart
    const Pose at = segments[static_cast<std::size_t>(found.segment)].at(found.tau);
    const double z = at.axis.dot(found.point - at.tip);
    double there = 1e300;
    for (const Revolved& part : body)
      there = std::min(there, profile_distance(part.corners(), z, (found.point - at.tip - z * at.axis).norm()));
    EXPECT_NEAR(there, found.value, 1e-6) << k;
  }
}

TEST(ClearanceVerdict, OrientationAndOverlapChangeNothing) {
  Random random(11);
  TriangleMesh mesh;
  for (int i = 0; i < 200; ++i) {
    const Vec3 middle = Vec3(12, 0, 60) + random_point(random, 6.0) + Vec3(8, 0, 0);
    for (int c = 0; c < 3; ++c) mesh.vertices.emplace_back(middle + random_point(random, 1.0));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  TriangleMesh turned = mesh;
  for (std::size_t i = 0; i < turned.triangles.size(); i += 3)
    std::swap(turned.triangles[i][1], turned.triangles[i][2]);
  turned.triangles.insert(turned.triangles.end(), mesh.triangles.begin(), mesh.triangles.begin() + 50);
  const Path path = path_of({{Vec3(-3, -9, 0), Vec3::UnitZ()}, {Vec3(-3, 9, 0), Vec3(0.02, 0, 1).normalized()}});
  const auto least = [&](const TriangleMesh& m) {
    return figure_of(judge_clearance(with_holder(), path, {{"m", ObstacleRole::kPart, m, 0.0}}, {}), ToolBody::kHolder,
                     ObstacleRole::kPart)
        .clearance_mm;
  };
  EXPECT_NEAR(least(mesh), least(turned), 1e-3);
}

TEST(ClearanceVerdict, SameBitsForAnyNumberOfThreads) {
  Random random(5);
  std::vector<Pose> poses;
  for (int i = 0; i < 300; ++i)
    poses.push_back({Vec3(0.2 * i, std::sin(0.05 * i), 0.0), Vec3(0.002 * i, 0.1, 1).normalized()});
  TriangleMesh mesh;
  for (int i = 0; i < 500; ++i) {
    const Vec3 middle = Vec3(30, 25, 50) + random_point(random, 20.0);
    for (int c = 0; c < 3; ++c) mesh.vertices.emplace_back(middle + random_point(random, 1.0));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  std::vector<ClearanceFigure> first;
  for (int threads : {1, 2}) {
    set_thread_count(threads);
    const ClearanceReport report =
        judge_clearance(with_holder(), path_of(poses), {{"m", ObstacleRole::kFixture, mesh, 0.0}}, {});
    if (first.empty()) first = report.figures;
    ASSERT_EQ(first.size(), report.figures.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
      EXPECT_EQ(first[k].clearance_mm, report.figures[k].clearance_mm);
      EXPECT_EQ(first[k].t, report.figures[k].t);
      EXPECT_EQ(first[k].point, report.figures[k].point);
    }
  }
  set_thread_count(0);
}

TEST(FlankProfile, HugsTheOutline) {
  for (const RadialFunction& radial : {RadialFunction(ToolFamily::kBarrel, 40.0, Eigen::Vector3d(85.0, 5.0, 18.0)),
                                       RadialFunction(ToolFamily::kBarrel, 40.0, Eigen::Vector3d(-60.0, 5.0, 18.0)),
                                       RadialFunction(ToolFamily::kCone, 30.0, Eigen::Vector2d(2.0, 0.1))}) {
    const std::vector<Vec2> profile = flank_profile(radial);
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
      EXPECT_LE(profile[i].x(), profile[i + 1].x() + 1e-12);
      // The middle of a chord against the union of the spheres, which it must not leave nor enter far.
      const Vec2 middle = 0.5 * (profile[i] + profile[i + 1]);
      double f = 1e300;
      for (int j = 0; j <= 20000; ++j) {
        const double s = radial.axis_length() * j / 20000;
        f = std::min(f, std::hypot(middle.x() - s, middle.y()) - radial.at(s).r);
      }
      EXPECT_LE(f, 1.2 * kFlankProfileErrorMm);
      EXPECT_GE(f, -1.2 * kFlankProfileErrorMm);
    }
    // The bodies against the spheres, from all sides.
    const std::vector<Revolved> bodies = flank_bodies(radial);
    Random random(2);
    for (int k = 0; k < 300; ++k) {
      const double z = random.uniform(-20.0, 60.0), rho = random.uniform(0.0, 20.0);
      double truth = 1e300, ours = 1e300;
      for (int j = 0; j <= 4000; ++j) {
        const double s = radial.axis_length() * j / 4000;
        truth = std::min(truth, std::hypot(z - s, rho) - radial.at(s).r);
      }
      for (const Revolved& body : bodies) ours = std::min(ours, body.value(z, rho));
      for (const Revolved& body : bodies) EXPECT_LE(body.floor(z, rho), body.value(z, rho) + 1e-12);
      if (truth > 0.0) {
        EXPECT_NEAR(ours, truth, 2.0 * kFlankProfileErrorMm) << z << ' ' << rho;
      } else {
        EXPECT_LE(ours, 2.0 * kFlankProfileErrorMm) << z << ' ' << rho;
      }
    }
  }
}

TEST(ClearanceVerdict, SaysHowNearEveryPoseIs) {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 4.0));
  tool.shank = {{20.0, 6.0}, {50.0, 6.0}};
  // Standing upright over the plane z = -10, then lying with the shank 7 mm above it; the target at z = -30 is nearer to
  // nothing, and a plane that only the part has is none of the flank's.
  Path path;
  path.strips.resize(2);
  for (int k = 0; k < 5; ++k) path.strips[0].poses.push_back({Vec3(0.0, 0.0, 0.5 * k * k), Vec3::UnitZ()});
  path.strips[1].poses = {{Vec3(0.0, 0.0, 3.0), Vec3::UnitX()}, {Vec3(1.0, 0.0, 3.5), Vec3::UnitX()}};
  const std::vector<Obstacle> obstacles{{"vice", ObstacleRole::kFixture, square(200.0, -10.0), 0.0},
                                        {"F1", ObstacleRole::kTarget, square(200.0, -9.0), 0.0}};
  const ClearanceReport report = judge_clearance(tool, path, obstacles, {});
  ASSERT_EQ(report.pose_clearance_mm.size(), 2u);
  ASSERT_EQ(report.pose_clearance_mm[0].size(), 5u);
  for (int k = 0; k < 5; ++k)
    EXPECT_NEAR(report.pose_clearance_mm[0][static_cast<std::size_t>(k)], 6.0 + 0.5 * k * k, kPoseClearanceMm) << k;
  ASSERT_EQ(report.pose_clearance_mm[1].size(), 2u);
  EXPECT_NEAR(report.pose_clearance_mm[1][0], 7.0, kPoseClearanceMm);
  EXPECT_NEAR(report.pose_clearance_mm[1][1], 7.5, kPoseClearanceMm);
  const ClearanceReport touching = judge_clearance(tool, path, {obstacles[1]}, {});
  EXPECT_TRUE(std::isinf(touching.pose_clearance_mm[0][0])) << "shank and target alone are not asked";
}

TEST(ClearanceVerdict, OfALongPathSaysItOfSomePosesAndTheLesserOneOfThoseBetween) {
  constexpr std::size_t kCount = 3 * kMostShownPoses;
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 4.0));
  tool.shank = {{20.0, 6.0}, {50.0, 6.0}};
  Path path;
  path.strips.resize(1);
  constexpr double kRise = 1e-3;  // mm a pose
  for (std::size_t k = 0; k < kCount; ++k)
    path.strips[0].poses.push_back({Vec3(0.0, 0.0, kRise * static_cast<double>(k)), Vec3::UnitZ()});
  const std::vector<Obstacle> obstacles{{"vice", ObstacleRole::kFixture, square(200.0, -10.0), 0.0}};
  const std::vector<double> poses = judge_clearance(tool, path, obstacles, {}).pose_clearance_mm[0];
  ASSERT_EQ(poses.size(), kCount);
  std::size_t told = 0;
  for (std::size_t k = 0; k < kCount; ++k) {
    const double truth = 6.0 + kRise * static_cast<double>(k);
    ASSERT_LE(poses[k], truth + kPoseClearanceMm) << k;
    ASSERT_GE(poses[k], truth - 4.0 * kRise) << k;
    told += k == 0 || poses[k] != poses[k - 1] ? 1 : 0;
  }
  EXPECT_LT(told, kMostShownPoses + 4);
}

TEST(ClearanceVerdict, RefusesBadOptions) {
  ClearanceOptions options;
  options.accuracy_mm = 0.0;
  EXPECT_THROW((void)judge_clearance(with_holder(), path_of({{Vec3::Zero(), Vec3::UnitZ()}}), {}, options), UsageError);
}

TEST(Hold, WhatCrossesTheAxisAboveTheFlankLeavesNothingToHoldTheToolBy) {
  // A flank of 20 in z; the wall far above it is crossed by the axis, however far up it is and whatever stands between.
  const Path path = path_of({{Vec3(0, 0, 0), Vec3::UnitZ()}, {Vec3(5, 0, 0), Vec3::UnitZ()}});
  const auto hold_of = [&](const Tool& tool, const TriangleMesh& mesh) {
    return judge_hold(tool, path, {{"F2", ObstacleRole::kPart, mesh, 0.0}}, {});
  };
  for (const double height : {21.0, 35.0, 400.0})
    for (const Tool& tool : {cylinder(4.0, 20.0), with_holder()}) {
      const auto hold = hold_of(tool, square(50, height));
      ASSERT_TRUE(hold) << height;
      EXPECT_FALSE(hold->axis.kept) << height;
      EXPECT_EQ(hold->axis.obstacle, "F2");
      EXPECT_EQ(hold->as_thick.has_value(), tool.shank.empty());
    }
  // What the flank itself goes through is the judge's, and what lies below is nobody's.
  for (const double height : {-1.0, 5.0}) EXPECT_TRUE(hold_of(cylinder(4.0, 20.0), square(50, height))->axis.kept);
}

TEST(Hold, AWallBesideTheAxisLetsThinnerThingsPass) {
  const Path path = path_of({{Vec3(0, 0, 0), Vec3::UnitZ()}, {Vec3(0, 5, 0), Vec3::UnitZ()}});
  const auto wall = [](double x, double low) {
    return std::vector<Obstacle>{
        {"F7", ObstacleRole::kPart,
         TriangleMesh{{{x, -50, low}, {x, 50, low}, {x, 50, 90}, {x, -50, 90}}, {{0, 1, 2}, {0, 2, 3}}}, 0.0}};
  };
  const Tool tool = cylinder(4.0, 20.0);
  // 3 mm off the axis: a shank of the flank's 4 mm would enter it by 1, a thinner one would not.
  const auto near = judge_hold(tool, path, wall(3.0, 22.0), {});
  EXPECT_TRUE(near->axis.kept);
  EXPECT_FALSE(near->as_thick->kept);
  EXPECT_NEAR(near->as_thick->clearance_mm, -1.0, 0.1);
  // Above one diameter it is not asked.
  EXPECT_TRUE(judge_hold(tool, path, wall(3.0, 28.5), {})->as_thick->kept);
  // A tenth of the radius off the axis nothing passes.
  EXPECT_FALSE(judge_hold(tool, path, wall(0.2, 22.0), {})->axis.kept);
  EXPECT_TRUE(judge_hold(tool, path, wall(0.6, 22.0), {})->axis.kept);
}

TEST(Hold, WithoutObstaclesOrPosesThereIsNothingToSay) {
  const Path path = path_of({{Vec3(0, 0, 0), Vec3::UnitZ()}, {Vec3(5, 0, 0), Vec3::UnitZ()}});
  EXPECT_FALSE(judge_hold(cylinder(4.0, 20.0), path, {}, {}));
  EXPECT_FALSE(judge_hold(cylinder(4.0, 20.0), {}, {{"F2", ObstacleRole::kPart, square(50, 30.0), 0.0}}, {}));
}

}  // namespace
}  // namespace flank::internal::verify
