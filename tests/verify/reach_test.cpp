#include "flank/verify/reach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "flank/error.h"
#include "flank/geom/tessellate.h"
#include "flank/threads.h"
#include "flank/verify/clearance/winding.h"
#include "verify/faces.h"

namespace flank::internal {
namespace {

/// [0, 40] x [0, 20] of the plane y = 0, machined from y > 0; x and z span it.
FaceSamples floor_samples(double spacing = 0.5) {
  Face face = test::plane_face("F1", 40.0, 20.0);
  face.reversed = true;
  return sample_face(face, spacing, true);
}

TriangleMesh quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return {{a, b, c, d}, {{0, 1, 2}, {0, 2, 3}}};
}

/// Six sides, each on its own, outwards.
std::vector<TriangleMesh> box(const Vec3& low, const Vec3& high) {
  std::vector<TriangleMesh> sides;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    for (bool top : {false, true}) {
      Vec3 a = top ? high : low, b = a, c = a, d = a;
      a[i] = d[i] = low[i], b[i] = c[i] = high[i];
      a[j] = b[j] = low[j], c[j] = d[j] = high[j];
      sides.push_back(top ? quad(a, b, c, d) : quad(a, d, c, b));
    }
  }
  return sides;
}

std::vector<ReachFace> solid(const std::vector<TriangleMesh>& sides, int number, bool checked = true) {
  std::vector<ReachFace> faces;
  for (const TriangleMesh& side : sides) faces.push_back({side, number, checked});
  return faces;
}

double area_share(const FaceSamples& face, const std::vector<double>& shares) {
  double part = 0.0, whole = 0.0;
  for (std::size_t i = 0; i < shares.size(); ++i) part += shares[i] * face.areas[i], whole += face.areas[i];
  return part / whole;
}

double reach(const FaceSamples& face, const std::vector<ReachFace>& others, double radius, double tolerance = 0.01) {
  return area_share(face, reachable_shares(face, others, {radius, tolerance}));
}

constexpr double kShare = 5e-4;  ///< half of the 0.1 % that the share is good to

TEST(Reach, NothingInTheWay) { EXPECT_EQ(reach(floor_samples(), {}, 5.0), 1.0); }

TEST(Reach, AWallKeepsTheBallAtItsRadius) {
  const ReachFace wall{quad({0, -9, -30}, {0, -9, 50}, {0, 30, 50}, {0, 30, -30}), -1, true};
  for (double radius : {0.7, 3.0, 5.0, 7.31})
    for (double tolerance : {0.01, 0.3})
      EXPECT_NEAR(reach(floor_samples(), {wall}, radius, tolerance), 1.0 - (radius - tolerance) / 40.0, kShare);
  const ReachFace unchecked{wall.mesh, -1, false};
  EXPECT_EQ(reach(floor_samples(), {unchecked}, 5.0), 1.0);
}

/// What a ball of 5 mm reaches of a face that is all there is, cut into triangles for the ball.
double reach_alone(const Face& face) {
  const ReachScene scene({}, tessellate(face, {.chord_mm = 0.002, .edge_mm = 1.0}).mesh, {5.0, 0.01});
  const FaceSamples samples = sample_face(face, 0.1, true);
  return area_share(samples, scene.shares(samples));
}

TEST(Reach, ACornerOfTheTargetKeepsTheBallAwayFromBothSides) {
  EXPECT_NEAR(reach_alone(test::corner_face("F1", 20.0, 30.0)), 1.0 - (5.0 - 0.01) / 20.0, 0.005);
}

TEST(Reach, ABendOfTheTargetKeepsTheBallAwayWhereItIsTighterThanTheBall) {
  for (const double radius : {4.8, 5.2}) {
    Face bend = test::quarter_cylinder("F1", radius, 8.0);
    bend.reversed = true;  // towards the axis
    EXPECT_EQ(reach_alone(bend), radius < 5.0 ? 0.0 : 1.0) << radius;
    bend.reversed = false;
    EXPECT_EQ(reach_alone(bend), 1.0) << radius;
  }
}

TEST(Reach, ASlantedWallCutsCellsAskew) {
  // Through the corner (0, 0), at an angle to the rows: the ball keeps R - tolerance along its normal.
  const double angle = 0.3, sine = std::sin(angle), cosine = std::cos(angle), limit = 2.0 - 0.01;
  const Vec3 along(cosine, 0, sine);
  const ReachFace wall{quad(-90 * along - Vec3(0, 9, 0), 90 * along - Vec3(0, 9, 0), 90 * along + Vec3(0, 30, 0),
                            -90 * along + Vec3(0, 30, 0)),
                       -1, true};
  // Forbidden: |z cos - x sin| < limit within the rectangle; by lines of constant x.
  double forbidden = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const double x = 40.0 * (i + 0.5) / 100000, middle = x * sine / cosine, half = limit / cosine;
    forbidden += std::max(0.0, std::min(20.0, middle + half) - std::max(0.0, middle - half));
  }
  const double expected = 1.0 - forbidden / 100000 / 20.0;
  for (double spacing : {1.0, 0.5, 0.2}) EXPECT_NEAR(reach(floor_samples(spacing), {wall}, 2.0), expected, kShare);
}

// The face runs through a solid: inside it is no place for a tool, however far the surface is.
TEST(Reach, InsideAnotherSolidNothingIsReachable) {
  const std::vector<TriangleMesh> sides = box({10, -15, -10}, {30, 15, 30});
  const double expected = 1.0 - (20.0 + 2.0 * 0.99) / 40.0;
  EXPECT_NEAR(reach(floor_samples(), solid(sides, 4), 1.0), expected, kShare);
  std::vector<TriangleMesh> inverted = sides;
  for (TriangleMesh& side : inverted)
    for (auto& t : side.triangles) std::swap(t[1], t[2]);
  EXPECT_NEAR(reach(floor_samples(), solid(inverted, 4), 1.0), expected, kShare);
  EXPECT_EQ(reach(floor_samples(), solid(sides, 4, false), 1.0), 1.0) << "a solid of which nothing is checked";
  // One checked side is enough, the others close it.
  std::vector<ReachFace> one = solid(sides, 4, false);
  for (ReachFace& face : one)
    if (face.mesh.box().low.x() == 10.0 && face.mesh.box().high.x() == 10.0) face.checked = true;
  EXPECT_NEAR(reach(floor_samples(), one, 1.0), 1.0 - (20.0 + 0.99) / 40.0, kShare);
  // Sheets have no inside: only what is near them is forbidden.
  EXPECT_NEAR(reach(floor_samples(), solid(sides, -1), 1.0), 1.0 - 4.0 * 0.99 / 40.0, kShare);
}

// Two solids that overlap each other: their union is solid.
TEST(Reach, SolidsMayOverlap) {
  std::vector<ReachFace> two = solid(box({10, -15, -10}, {22, 15, 30}), 1);
  for (const ReachFace& face : solid(box({18, -15, -10}, {30, 15, 30}), 2)) two.push_back(face);
  EXPECT_NEAR(reach(floor_samples(), two, 1.0), 1.0 - (20.0 + 2.0 * 0.99) / 40.0, kShare);
}

TEST(Reach, FacesThatTurnAwayAtTheBorderTakeNothing) {
  // The floor is the top of a block: the block's other sides.
  std::vector<ReachFace> sides;
  for (const TriangleMesh& side : box({0, -10, 0}, {40, 0, 20}))
    if (side.box().low.y() < -1.0) sides.push_back({side, -1, true});
  ASSERT_EQ(sides.size(), 5u);
  for (double tolerance : {1e-6, 1e-3, 0.1}) EXPECT_EQ(reach(floor_samples(), sides, 5.0, tolerance), 1.0);
}

TEST(Reach, SameBitsForAnyNumberOfThreads) {
  const FaceSamples face = floor_samples(0.3);
  const std::vector<ReachFace> others = solid(box({10, -15, -10}, {30, 15, 7.7}), 1);
  set_thread_count(1);
  const std::vector<double> one = reachable_shares(face, others, {1.7, 0.01});
  set_thread_count(2);
  EXPECT_EQ(one, reachable_shares(face, others, {1.7, 0.01}));
  set_thread_count(0);
}

TEST(Reach, FacesThatAreSharedSayWhatEachSceneOfItsOwnSays) {
  const FaceSamples floor = floor_samples(0.4);
  const TriangleMesh own = quad({0, -9, 0}, {40, -9, 0}, {40, 30, 0}, {0, 30, 0});
  const std::vector<TriangleMesh> block = box({10, -15, -10}, {30, 15, 7.7});
  std::vector<ReachFace> all{{own, 0, true}, {quad({0, -9, -30}, {0, -9, 50}, {0, 30, 50}, {0, 30, -30}), 0, true}};
  for (const ReachFace& side : solid(block, 1)) all.push_back(side);
  // Of its own solid a target has faces to keep out of, and no inside.
  std::vector<ReachFace> others = solid(block, 1);
  others.push_back({all[1].mesh, -1, true});
  const ReachFaces faces(all);
  for (const bool corners : {false, true}) {
    const std::vector<double> shared = ReachScene(faces, 0, corners, {1.7, 0.01}).shares(floor);
    EXPECT_EQ(shared, ReachScene(others, corners ? own : TriangleMesh(), {1.7, 0.01}).shares(floor));
    EXPECT_NE(*std::min_element(shared.begin(), shared.end()), *std::max_element(shared.begin(), shared.end()));
  }
}

TEST(Reach, RefusesBallsThatAreNone) {
  for (double radius : {0.0, -1.0, 1e300 * 1e300}) EXPECT_THROW((void)reach(floor_samples(), {}, radius), UsageError);
  EXPECT_THROW((void)reach(floor_samples(), {}, 1.0, 0.0), UsageError);
}

TEST(Reach, TheToolTellsTheSideOfASheet) {
  Tool tool;
  tool.radial = RadialFunction::spline(20.0, Eigen::VectorXd::Constant(6, 5.0));
  Path path{{Strip{}}};
  for (int i = 0; i <= 10; ++i) path.strips[0].poses.push_back({Vec3(4.0 * i, 5.0, 0.0), Vec3::UnitZ()});
  FaceSamples sheet = floor_samples();
  EXPECT_EQ(side_of_tool(tool, path, sheet), +1);
  for (Vec3& n : sheet.normals) n = -n;
  EXPECT_EQ(side_of_tool(tool, path, sheet), -1);
}

TEST(Reach, TheJudgeGivesCoverageOfBoth) {
  Tool tool;
  tool.radial = RadialFunction::spline(20.0, Eigen::VectorXd::Constant(6, 5.0));
  Path path{{Strip{}}};
  for (int i = 0; i <= 10; ++i) path.strips[0].poses.push_back({Vec3(10.0 + 3.1 * i, 5.0, 0.0), Vec3::UnitZ()});
  FaceSamples face = floor_samples();
  const ReachFace wall{quad({0, -9, -30}, {0, -9, 50}, {0, 30, 50}, {0, 30, -30}), -1, true};
  face.reachable = reachable_shares(face, {wall}, {5.0, 0.01});
  const VerifyReport r = judge(tool, path, {face}, {});
  // The strip's first end leaves sqrt(2 * 5 * 0.01) = 0.316 mm more within the tolerance.
  EXPECT_NEAR(r.coverage, (30.0 + 0.316) / 40.0, 0.0126);
  EXPECT_NEAR(r.reachable_share, 35.01 / 40.0, kShare);
  EXPECT_NEAR(r.coverage_reachable, r.coverage / r.reachable_share, 1e-12);
  EXPECT_EQ(r.faces.at(0).coverage_reachable, r.coverage_reachable);
  face.reachable.assign(face.points.size(), 0.0);
  EXPECT_EQ(judge(tool, path, {face}, {}).coverage_reachable, 0.0) << "nothing is reachable";
}

TEST(Winding, IsOneInsideAndNoneOutside) {
  // A sphere of many triangles, so that far nodes count as areas.
  TriangleMesh sphere;
  constexpr int kRows = 60, kColumns = 120;
  for (int j = 0; j <= kRows; ++j)
    for (int i = 0; i < kColumns; ++i) {
      const double a = std::numbers::pi * j / kRows, b = 2.0 * std::numbers::pi * i / kColumns;
      sphere.vertices.emplace_back(10.0 * Vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    }
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < kColumns; ++i) {
      const int a = j * kColumns + i, b = j * kColumns + (i + 1) % kColumns;
      sphere.triangles.push_back({a, a + kColumns, b + kColumns});
      sphere.triangles.push_back({a, b + kColumns, b});
    }
  const verify::Winding winding(sphere);
  for (double r : {0.0, 3.0, 8.0, 9.8}) {
    EXPECT_NEAR(winding.number({r, 0.1 * r, 0.05 * r}), r * r * 1.0125 < 99.0 ? 1.0 : 0.0, 0.05) << r;
  }
  for (double r : {10.2, 12.0, 30.0, 1e4}) EXPECT_NEAR(winding.number({0.0, r, 0.3 * r}), 0.0, 0.05) << r;
  EXPECT_TRUE(winding.inside({1, 2, 3}));
  EXPECT_FALSE(winding.inside({10, 2, 3}));
  EXPECT_FALSE(verify::Winding(TriangleMesh()).inside({0, 0, 0}));
}

TEST(Reach, TheLargestBallBesideAWallIsAsLargeAsItIsFar) {
  // A wall stands on the edge z = 0 of the floor: at a distance d from it a ball of radius d touches both.
  const FaceSamples floor = floor_samples(1.0);
  const std::vector<ReachFace> others = solid(box({-10, -10, -5}, {50, 60, 0}), 1);
  constexpr double kRadius = 6.0, kTolerance = 1e-4;
  const std::vector<double> radii = ReachScene(others, {}, {kRadius, kTolerance}).largest_balls(floor);
  ASSERT_EQ(radii.size(), floor.points.size());
  for (std::size_t i = 0; i < radii.size(); ++i)
    EXPECT_NEAR(radii[i], std::min(kRadius, floor.points[i].z()), 2e-3 * kRadius) << floor.points[i].transpose();
  // It agrees with what is reachable by a ball of any radius.
  for (const double radius : {1.0, 2.5, 5.0}) {
    double larger = 0.0, whole = 0.0;
    for (std::size_t i = 0; i < radii.size(); ++i)
      larger += radii[i] >= radius ? floor.areas[i] : 0.0, whole += floor.areas[i];
    EXPECT_NEAR(larger / whole, reach(floor, others, radius, kTolerance), 0.03) << radius;
  }
}

TEST(Reach, TheLargestBallInAGrooveIsTheGroovesOwn) {
  // A groove of radius 5, its own triangles, seen from its axis.
  constexpr double kGroove = 5.0;
  FaceSamples bottom;
  TriangleMesh own;
  constexpr int kSteps = 720;
  for (int k = 0; k <= kSteps; ++k) {
    const double a = std::numbers::pi * k / kSteps;
    const Vec3 out(std::cos(a), -std::sin(a), 0.0);
    own.vertices.push_back(kGroove * out - 40.0 * Vec3::UnitZ());
    own.vertices.push_back(kGroove * out + 40.0 * Vec3::UnitZ());
    if (k == 0) continue;
    own.triangles.push_back({2 * k - 2, 2 * k, 2 * k - 1});
    own.triangles.push_back({2 * k, 2 * k + 1, 2 * k - 1});
  }
  for (const double share : {0.3, 0.5, 0.6}) {
    const double a = std::numbers::pi * share;
    bottom.points.emplace_back(kGroove * std::cos(a), -kGroove * std::sin(a), 0.0);
    bottom.normals.push_back(-bottom.points.back().normalized());
    bottom.areas.push_back(1.0);
  }
  for (const double radius : ReachScene({}, own, {20.0, 1e-3}).largest_balls(bottom))
    EXPECT_NEAR(radius, kGroove, 0.05);
  for (const double radius : ReachScene({}, own, {4.0, 1e-3}).largest_balls(bottom)) EXPECT_EQ(radius, 4.0);
}

}  // namespace
}  // namespace flank::internal
