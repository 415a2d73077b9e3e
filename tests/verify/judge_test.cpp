#include "flank/judge.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <numeric>

#include "flank/error.h"
#include "flank/threads.h"
#include "verify/brute_force.h"
#include "verify/faces.h"

namespace flank::internal {
namespace {

Tool cylinder(double radius, double length) {
  Tool tool;
  tool.radial = RadialFunction::spline(length, Eigen::VectorXd::Constant(6, radius));
  return tool;
}

/// Axis along z at y = `height`, from x = `from` to x = `to`.
Path pass(double from, double to, double height, int poses = 11) {
  Strip strip;
  for (int i = 0; i < poses; ++i)
    strip.poses.push_back({Vec3(from + (to - from) * i / (poses - 1), height, 0.0), Vec3::UnitZ()});
  return {{strip}};
}

TEST(Judge, AnExactPassOverAPlaneIsFlawless) {
  const Face face = test::plane_face("F1", 40.0, 20.0);
  const auto samples = sample_face(face, 0.5, true);
  const VerifyReport r = judge(cylinder(5.0, 20.0), pass(-1.0, 41.0, 5.0), {samples}, {&face}, {});
  EXPECT_EQ(r.verdict, Verdict::kPass);
  EXPECT_EQ(r.coverage_bound, 1.0);
  EXPECT_DOUBLE_EQ(r.coverage, 1.0);
  EXPECT_LT(r.overcut_mm, 1e-12);
  EXPECT_LT(r.undercut_mm, 1e-12);
  EXPECT_LT(r.rms_mm, 1e-12);
  EXPECT_EQ(r.faces.at(0).samples, samples.points.size());
  EXPECT_NEAR(r.faces.at(0).area_mm2, 800.0, 1e-9);
  EXPECT_NEAR(std::accumulate(r.histogram_area_mm2.begin(), r.histogram_area_mm2.end(), 0.0), 800.0, 1e-9);
  EXPECT_NEAR(r.histogram_area_mm2.at(20), 800.0, 1e-9) << "all of it in the middle bin";
}

TEST(Judge, HeightAboveThePlaneIsMaterialLeft) {
  const Face face = test::plane_face("F1", 40.0, 20.0);
  const auto samples = sample_face(face, 0.5, true);
  const VerifyReport r = judge(cylinder(5.0, 20.0), pass(-1.0, 41.0, 5.03), {samples}, {&face}, {});
  EXPECT_EQ(r.verdict, Verdict::kPass) << "material left is no overcut";
  EXPECT_EQ(r.coverage, 0.0);
  EXPECT_EQ(r.coverage_bound, 0.0);
  EXPECT_NEAR(r.undercut_mm, 0.03, 1e-9);
  EXPECT_NEAR(r.undercut_covered_mm, 0.03, 1e-9);
  EXPECT_NEAR(r.rms_mm, 0.03, 1e-9);
  EXPECT_NEAR(r.histogram_area_mm2.back(), 800.0, 1e-9) << "the last bin is open";
}

// What lies between samples was not seen: it passes only if it cannot be deeper than the tolerance.
TEST(Judge, SamplesAlonePassNoMoreThanTheySaw) {
  const Face face = test::plane_face("F1", 40.0, 20.0);
  const Tool tool = cylinder(5.0, 20.0);
  const Path path = pass(-1.0, 41.0, 5.0);
  JudgeOptions options;
  options.depth = DepthProof::kSampled;
  for (double spacing : {100.0, 1.0, 0.2}) {
    const VerifyReport r = judge(tool, path, {sample_face(face, spacing, true)}, {&face}, options);
    EXPECT_EQ(r.depth, DepthProof::kSampled);
    EXPECT_LT(r.overcut_mm, 1e-12);
    EXPECT_GT(r.overcut_bound_mm, 0.01);
    EXPECT_EQ(r.verdict, Verdict::kUnproved) << spacing;
    EXPECT_EQ(judge(tool, path, {sample_face(face, spacing, true)}, options).verdict, Verdict::kUnproved);
  }
  // Cells of 0.01 mm reach no farther than 0.0071 mm.
  const Face small = test::plane_face("F1", 2.0, 2.0);
  EXPECT_EQ(judge(tool, path, {sample_face(small, 0.01, true)}, {&small}, options).verdict, Verdict::kPass);
}

TEST(Judge, TheProvedCoverageComesNearTheMeasuredOne) {
  const Face face = test::plane_face("F1", 40.0, 20.0);
  const auto samples = sample_face(face, 0.5, true);
  const VerifyReport half = judge(cylinder(5.0, 20.0), pass(-1.0, 20.0, 5.0), {samples}, {&face}, {});
  EXPECT_LE(*half.coverage_bound, 0.5 + std::sqrt(2.0 * 5.0 * 0.01) / 40.0);
  EXPECT_GE(*half.coverage_bound, 0.5);
  EXPECT_GT(half.faces[0].cover_cells, 0u);
  // A cut spoils it: what is cut too deep is not finished, and where that is, is known of the face as a whole only.
  const VerifyReport cut = judge(cylinder(5.0, 20.0), pass(-1.0, 41.0, 4.9), {samples}, {&face}, {});
  EXPECT_EQ(cut.coverage_bound, 0.0);
  EXPECT_FALSE(judge(cylinder(5.0, 20.0), pass(-1.0, 41.0, 5.0), {samples}, {}).coverage_bound);
}

// What is far from the path is left out in blocks; near it nothing may be lost.
TEST(Judge, DistancesUpToTheHorizonAreThoseOfEachPointAlone) {
  const Tool tool = cylinder(5.0, 20.0);
  Path path = pass(30.0, 170.0, 4.9, 29);
  for (Pose& p : path.strips[0].poses) p.axis = Vec3(0.1, 0.002 * p.tip.x(), 1.0).normalized();
  const auto face = sample_face(test::plane_face("F1", 300.0, 150.0), 0.7, false);
  const SweptVolume volume(tool, path);
  for (double horizon : {0.01, 0.7, 20.0}) {
    const std::vector<SweptDistance> all = swept_distances(volume, face, horizon);
    int near = 0, far = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double alone = volume.distance(face.points[i], horizon).f;
      ASSERT_NEAR(std::min(all[i].f, horizon), std::min(alone, horizon), 1e-9) << face.points[i].transpose();
      EXPECT_EQ(all[i].strip < 0, all[i].f >= horizon);
      ++(alone < horizon ? near : far);
    }
    EXPECT_GT(near, 100) << horizon;
    EXPECT_GT(far, 10000) << horizon;
  }
}

TEST(Judge, HalfAPlaneIsHalfCovered) {
  const auto samples = sample_face(test::plane_face("F1", 40.0, 20.0), 0.5, true);
  const VerifyReport r = judge(cylinder(5.0, 20.0), pass(-1.0, 20.0, 5.0), {samples}, {});
  // The round end of the sweep stays within the tolerance for sqrt(2 * 5 * 0.01) = 0.316 mm beyond the last pose.
  EXPECT_NEAR(r.coverage, 0.5, 0.0126);
  EXPECT_GE(r.coverage, 0.5);
  EXPECT_NEAR(r.undercut_mm, std::hypot(19.75, 5.0) - 5.0, 1e-9);
  EXPECT_LT(r.undercut_covered_mm, 1e-12) << "what lies beyond the last pose is not swept";
  EXPECT_LT(r.rms_mm, 1e-12);
}

TEST(Judge, CoveredSamplesAreTheOnesWithinTolerance) {
  const auto samples = sample_face(test::plane_face("F1", 40.0, 20.0), 0.5, true);
  const SweptVolume volume(cylinder(5.0, 20.0), pass(-1.0, 20.0, 5.0));
  const auto covered = covered_samples(volume, samples, 0.01);
  EXPECT_NEAR(static_cast<double>(covered.size()) / static_cast<double>(samples.points.size()), 0.5, 0.0126);
  for (std::size_t i : covered) EXPECT_LT(samples.points[i].x(), 20.32);
}

TEST(Judge, CoverageIsWeightedByAreaOverTheTargets) {
  const auto near = sample_face(test::plane_face("F1", 40.0, 20.0), 0.5, true);
  const auto far = sample_face(test::plane_face("F2", 40.0, 60.0, -30.0), 1.0, true);
  const VerifyReport r = judge(cylinder(5.0, 20.0), pass(-1.0, 41.0, 5.0), {near, far}, {});
  EXPECT_NEAR(r.coverage, 0.25, 1e-12);
  EXPECT_DOUBLE_EQ(r.faces.at(0).coverage, 1.0);
  EXPECT_DOUBLE_EQ(r.faces.at(1).coverage, 0.0);
}

TEST(Judge, PlantedDipsAreFoundWithPlaceDepthAndPose) {
  // Two dips of the axis, the deeper one at x = 30; the axis stays parallel to z.
  Path path;
  path.strips.emplace_back();
  for (double x : {-1.0, 8.0, 10.0, 12.0, 28.0, 30.0, 32.0, 41.0}) {
    const double dip = x == 10.0 ? 0.05 : x == 30.0 ? 0.2 : 0.0;
    path.strips[0].poses.push_back({Vec3(x, 5.0 - dip, 0.0), Vec3::UnitZ()});
  }
  const auto samples = sample_face(test::plane_face("F4", 40.0, 20.0), 0.25, true);
  const VerifyReport r = judge(cylinder(5.0, 20.0), path, {samples}, {});
  EXPECT_EQ(r.verdict, Verdict::kOvercut);
  EXPECT_LE(r.overcut_mm, 0.2 + 1e-12);
  EXPECT_GE(r.overcut_mm + r.sampling_bound_mm, 0.2);
  EXPECT_NEAR(r.overcut_mm, 0.2, 0.125 * 0.125 / 9.0);
  ASSERT_GE(r.worst.size(), 2u);
  EXPECT_EQ(r.worst[0].face, "F4");
  EXPECT_EQ(r.worst[0].f, -r.overcut_mm);
  EXPECT_NEAR(r.worst[0].point.x(), 30.0, 0.13);
  EXPECT_NEAR(r.worst[0].t, 5.0, 0.1);
  EXPECT_EQ(r.worst[0].strip, 0);
  for (std::size_t i = 0; i < r.worst.size(); ++i) {
    EXPECT_LT(r.worst[i].f, 0.0);
    EXPECT_LE(r.worst[i > 0 ? i - 1 : 0].f, r.worst[i].f);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((r.worst[i].point - r.worst[j].point).norm(), 2.0) << "spread out";
  }
}

TEST(Judge, ACutIntoACheckFaceIsAGouge) {
  const auto target = sample_face(test::plane_face("F1", 40.0, 20.0), 0.5, true);
  // A wall under the tip: the round end reaches 5 below z = 0.
  Face floor = test::plane_face("F2", 40.0, 12.0);
  for (Vec3& p : floor.surface.poles) p = Vec3(p.x(), p.z(), -4.7);
  const VerifyReport r =
      judge(cylinder(5.0, 20.0), pass(-1.0, 41.0, 5.0), {target, sample_face(floor, 0.25, false)}, {});
  EXPECT_EQ(r.verdict, Verdict::kGouge);
  EXPECT_NEAR(r.gouge_mm, 0.3, 0.002);
  EXPECT_LE(r.gouge_mm, 0.3);
  EXPECT_LT(r.overcut_mm, 1e-12);
  EXPECT_EQ(r.worst.at(0).face, "F2");
  EXPECT_NEAR(r.worst.at(0).point.y(), 5.0, 0.13);
  EXPECT_NEAR(r.worst.at(0).s, 0.0, 1e-12);
}

// Samples stand in the middle of cells: a cut at a border is between them.
TEST(Judge, ACutAtABorderIsMissedBySamplesAndFoundByTheProof) {
  const Face target = test::plane_face("F1", 40.0, 20.0), check = test::plane_face("F2", 40.0, 20.0, -1.0);
  const std::vector<FaceSamples> samples = {sample_face(target, 0.5, true), sample_face(check, 1.0, false)};
  Path path = pass(-1.0, 41.0, 5.0);
  path.strips.push_back(
      {2, "flank", "", {{Vec3(40.0, 4.985, -3.0), Vec3::UnitZ()}, {Vec3(40.01, 4.985, -3.0), Vec3::UnitZ()}}});
  const Tool tool = cylinder(5.0, 20.0);
  EXPECT_EQ(judge(tool, path, samples, {}).depth, DepthProof::kSampled);
  const VerifyReport r = judge(tool, path, samples, {&target, &check}, {});
  EXPECT_EQ(r.depth, DepthProof::kProved);
  EXPECT_EQ(r.verdict, Verdict::kOvercut);
  EXPECT_NEAR(r.overcut_mm, 0.015, 1e-7);
  EXPECT_GE(r.overcut_bound_mm, 0.015 - 1e-9);
  EXPECT_EQ(r.gouge_bound_mm, 0.0);
  ASSERT_TRUE(r.faces.at(0).deepest);
  EXPECT_NEAR(r.faces.at(0).deepest->point.x(), 40.0, 0.1);
  EXPECT_EQ(r.worst.at(0).f, -r.overcut_mm);
  const VerifyReport good = judge(tool, pass(-1.0, 41.0, 5.0), samples, {&target, &check}, {});
  EXPECT_EQ(good.verdict, Verdict::kPass);
  EXPECT_LE(good.overcut_bound_mm, 0.01);
}

TEST(Judge, BetweenSamplesItIsNoWorseThanTheBoundSays) {
  Random random(17);
  const Tool tool = brute::random_tool(random, 20.0);
  Path path = pass(-2.0, 42.0, 0.0, 40);
  for (Pose& p : path.strips[0].poses) {
    p.tip.y() = tool.radial.at(10.0).r - 0.05 + 0.1 * std::sin(2.0 * p.tip.x());
    p.axis = Vec3(0.02 * std::cos(p.tip.x()), 0.02 * std::sin(p.tip.x()), 1.0).normalized();
  }
  const Face face = test::plane_face("F1", 40.0, 20.0);
  const VerifyReport fine = judge(tool, path, {sample_face(face, 0.08, true)}, {});
  for (double spacing : {0.4, 0.8, 1.6, 3.2}) {
    const VerifyReport coarse = judge(tool, path, {sample_face(face, spacing, true)}, {});
    EXPECT_LE(fine.overcut_mm, coarse.overcut_mm + coarse.sampling_bound_mm) << spacing;
    EXPECT_LE(coarse.sampling_bound_mm, 0.71 * spacing);
    if (spacing > 0.5) continue;
    // At the border only the slope of f tells; inside, the bound is of second order in the spacing.
    FaceSamples inner = sample_face(face, spacing, true);
    EXPECT_GT(coarse.sampling_bound_mm, 0.05);
    inner.smooth.assign(inner.points.size(), 1);
    EXPECT_LE(judge(tool, path, {inner}, {}).sampling_bound_mm, 0.05);
  }
}

TEST(Judge, BeyondTheHorizonIsCountedAsNotMachined) {
  const auto samples = sample_face(test::plane_face("F1", 40.0, 20.0), 0.5, true);
  JudgeOptions options;
  options.horizon_mm = 1.0;
  const VerifyReport r = judge(cylinder(5.0, 20.0), pass(-1.0, 20.0, 5.0), {samples}, options);
  EXPECT_DOUBLE_EQ(r.undercut_mm, 1.0);
  EXPECT_NEAR(r.coverage, 0.5, 0.0126);
  EXPECT_LT(r.undercut_covered_mm, 1e-12);
}

TEST(Judge, AnEmptyPathCoversNothing) {
  const auto samples = sample_face(test::plane_face("F1", 4.0, 2.0), 0.5, true);
  JudgeOptions options;
  options.horizon_mm = 3.0;
  const VerifyReport r = judge(cylinder(5.0, 20.0), Path{}, {samples}, options);
  EXPECT_EQ(r.coverage, 0.0);
  EXPECT_EQ(r.overcut_mm, 0.0);
  EXPECT_EQ(r.undercut_mm, 3.0);
  EXPECT_TRUE(r.worst.empty());
}

TEST(Judge, NothingComesNearWhereNothingMoves) {
  const auto samples = sample_face(test::plane_face("F1", 4.0, 2.0), 0.5, true);
  const VerifyReport r = judge(cylinder(5.0, 20.0), Path{}, {samples}, {});
  EXPECT_EQ(r.undercut_mm, std::numeric_limits<double>::infinity());
  EXPECT_EQ(r.faces.at(0).undercut_mm, r.undercut_mm);
  EXPECT_EQ(r.rms_mm, 0.0);
}

TEST(Judge, SameBitsForOneAndTwoThreads) {
  Random random(23);
  const Tool tool = brute::random_tool(random, 20.0);
  const Path path = brute::twisted_path(random, 60, 30.0, 0.6);
  const auto samples = sample_face(test::quarter_cylinder("F1", 15.0, 20.0), 0.4, true);
  set_thread_count(1);
  const VerifyReport a = judge(tool, path, {samples}, {});
  set_thread_count(2);
  const VerifyReport b = judge(tool, path, {samples}, {});
  set_thread_count(0);
  EXPECT_EQ(a.coverage, b.coverage);
  EXPECT_EQ(a.overcut_mm, b.overcut_mm);
  EXPECT_EQ(a.undercut_mm, b.undercut_mm);
  EXPECT_EQ(a.undercut_covered_mm, b.undercut_covered_mm);
  EXPECT_EQ(a.rms_mm, b.rms_mm);
  EXPECT_EQ(a.histogram_area_mm2, b.histogram_area_mm2);
  ASSERT_EQ(a.worst.size(), b.worst.size());
  for (std::size_t i = 0; i < a.worst.size(); ++i) {
    EXPECT_EQ(a.worst[i].point, b.worst[i].point);
    EXPECT_EQ(a.worst[i].f, b.worst[i].f);
    EXPECT_EQ(a.worst[i].t, b.worst[i].t);
    EXPECT_EQ(a.worst[i].s, b.worst[i].s);
  }
}

// Samples of the axis would step over the waist by micrometres.
TEST(Judge, SmallestRadiusIsThatOfTheWaist) {
  const double radius = 5.0, slope = 0.00731, bend = 0.01;
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kHyperbolic, 20.0, Eigen::Vector3d(radius, slope, bend));
  EXPECT_NEAR(smallest_radius(tool), radius - slope * slope / (4.0 * bend), 1e-12);
}

TEST(Judge, RefusesOptionsThatAreNone) {
  JudgeOptions options;
  options.tolerance_mm = -1.0;
  EXPECT_THROW((void)judge(cylinder(5.0, 20.0), pass(0, 1, 5.0), {}, options), UsageError);
  options = {};
  options.histogram_bins = 0;
  EXPECT_THROW((void)judge(cylinder(5.0, 20.0), pass(0, 1, 5.0), {}, options), UsageError);
}

}  // namespace
}  // namespace flank::internal
