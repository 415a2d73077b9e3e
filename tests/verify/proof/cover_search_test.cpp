// What is proved of a face's coverage, against fine samples of it: no cell may have more area left than it is open.
#include "flank/verify/proof/cover_search.h"

#include <gtest/gtest.h>

#include "flank/threads.h"
#include "flank/verify/proof/face_shape.h"
#include "flank/verify/proof/mesh_shape.h"
#include "sanitized.h"
#include "verify/brute_force.h"
#include "verify/faces.h"

namespace flank::internal::verify {
namespace {

constexpr double kTolerance = 0.02;

/// A pass beside a plane of 20 x 10, of a stick along z; waves and tilts of `rough` leave parts of it.
Path pass(Random& random, double rough, double lift) {
  Strip strip;
  for (int i = 0; i < 15; ++i)
    strip.poses.push_back({Vec3(-1.0 + 1.6 * i, lift + rough * random.uniform(-1.0, 1.0), -3.0),
                           (Vec3::UnitZ() + brute::random_vector(random, 0.3 * rough)).normalized()});
  return {{strip}};
}

/// As the face, with two triangles.
TriangleMesh plane_mesh() {
  TriangleMesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(0, 0, 10), Vec3(20, 0, 0), Vec3(20, 0, 10)};
  mesh.triangles = {{0, 1, 2}, {2, 1, 3}};
  return mesh;
}

double area_of(const std::vector<double>& areas) {
  double sum = 0.0;
  for (double a : areas) sum += a;
  return sum;
}

struct Coverage {
  double measured = 0.0, proved = 0.0, fine = 0.0;
};

/// Of samples at 0.4 mm, and of fine ones.
Coverage coverage_of(const SweptVolume& volume, const Shape& shape, const FaceSamples& coarse, const FaceSamples& fine,
                     const CoverLimits& limits) {
  const auto covered = [&](const FaceSamples& samples) {
    double sum = 0.0;
    const std::vector<SweptDistance> f = swept_distances(volume, samples, 1e300);
    for (std::size_t i = 0; i < f.size(); ++i) sum += f[i].f <= limits.tolerance_mm ? samples.areas[i] : 0.0;
    return sum / area_of(samples.areas);
  };
  const ProvedCover proved = search_cover(volume, shape, coarse, swept_distances(volume, coarse, 1e300), limits);
  for (std::size_t i = 0; i < proved.open_mm2.size(); ++i) {
    EXPECT_GE(proved.open_mm2[i], 0.0);
    EXPECT_LE(proved.open_mm2[i], coarse.areas[i]);
  }
  return {covered(coarse), 1.0 - area_of(proved.open_mm2) / area_of(coarse.areas), covered(fine)};
}

CoverLimits usual_limits(const FaceSamples& samples) {
  return {kTolerance, 1e-4 * area_of(samples.areas), 60 * samples.points.size(), 1'000'000};
}

TEST(CoverSearch, ProvesNoMoreThanThereIs) {
  const int trials = kSanitized ? 4 : 12;  // each outline once
  int between = 0;
  for (int trial = 0; trial < trials; ++trial) {
    Random random(static_cast<std::uint64_t>(300 + trial));
    const Tool tool = brute::random_tool(random, 16.0);
    const SweptVolume volume(tool, pass(random, 0.02 * (trial % 4), tool.radial.at(8.0).r));
    Face face = test::plane_face("F1", 20.0, 10.0);
    if (trial % 3 == 1) face.loops = {test::circle({0.5, 0.5}, 0.42), test::circle({0.55, 0.4}, 0.1)};
    if (trial % 3 == 2) face.loops = {test::polygon({{0.1, 0.1}, {0.95, 0.2}, {0.4, 0.9}})};
    const FaceSamples coarse = sample_face(face, 0.4, true), fine = sample_face(face, 0.06, true);
    const Coverage c = coverage_of(volume, *make_shape(face), coarse, fine, usual_limits(coarse));
    EXPECT_LE(c.proved, c.fine + 1e-3) << trial;  // of the areas of cells on the border
    EXPECT_GE(c.proved, c.fine - 0.02) << trial;  // the limits, of samples as coarse as these
    between += c.fine > 0.05 && c.fine < 0.95 ? 1 : 0;
  }
  EXPECT_GE(4 * between, trials) << "some are meant to be covered in part";
}

TEST(CoverSearch, MeshesAndCurvedFaces) {
  if (kThreadSanitized) GTEST_SKIP() << "the same loop as over a plane";
  Random random(5);
  const Tool tool = brute::random_tool(random, 16.0);
  const SweptVolume volume(tool, pass(random, 0.04, tool.radial.at(8.0).r));
  const TriangleMesh mesh = plane_mesh();
  const FaceSamples coarse = sample_mesh("M", mesh, 0.4, true), fine = sample_mesh("M", mesh, 0.06, true);
  const Coverage c = coverage_of(volume, *make_shape(mesh), coarse, fine, usual_limits(coarse));
  EXPECT_LE(c.proved, c.fine + 2e-4);
  EXPECT_GE(c.proved, c.fine - 0.01);
  EXPECT_GT(c.proved, 0.02);

  // The inside of a tube, and one stick that stands in a corner of it: covered is a strip along the line of contact.
  const Face tube = test::quarter_cylinder("F1", 6.0, 10.0);
  Tool stick;
  stick.radial = RadialFunction::spline(20.0, Eigen::VectorXd::Constant(6, 2.0));
  const Vec3 foot = 4.0 * Vec3(std::sqrt(0.5), std::sqrt(0.5), 0.0) - 5.0 * Vec3::UnitZ();
  const SweptVolume standing(stick, {{{1, "flank", "", {{foot, Vec3::UnitZ()}}}}});
  const FaceSamples samples = sample_face(tube, 0.3, true);
  const Coverage t =
      coverage_of(standing, *make_shape(tube), samples, sample_face(tube, 0.02, true), usual_limits(samples));
  EXPECT_LE(t.proved, t.fine + 1e-3);
  EXPECT_GE(t.proved, t.fine - 0.005);
  EXPECT_GT(t.proved, 0.05);
}

/// Passes of a ball of this radius along a plane of 20 x 10, side by side; `lean`: of every other one of them.
Path passes_beside_each_other(int count, double radius, double first, double apart, double lean) {
  Path path;
  for (int pass = 0; pass < count; ++pass) {
    Strip& strip = path.strips.emplace_back();
    for (int k = 0; k <= 44; ++k)
      strip.poses.push_back(
          {Vec3(-1.0 + 0.5 * k, radius, first + apart * pass), Vec3(0.2, 1.0, lean * (pass % 2)).normalized()});
  }
  return path;
}

TEST(CoverSearch, PassesThatAreNarrowerThanACellProveItTogether) {
  // Passes of a tip of radius 0.5 over a plane, 0.2 mm apart, upright on it; the sample's cells are five of them wide.
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCone, 8.0, Eigen::Vector2d(0.5, 0.1));
  const Path path = passes_beside_each_other(51, 0.5, 0.0, 0.2, 0.1);
  const SweptVolume volume(tool, path);
  const Face face = test::plane_face("F1", 20.0, 10.0);
  const FaceSamples coarse = sample_face(face, 1.0, true), fine = sample_face(face, 0.06, true);
  CoverLimits limits = usual_limits(coarse);
  limits.evaluations = 700 * coarse.points.size();
  const Coverage c = coverage_of(volume, *make_shape(face), coarse, fine, limits);
  EXPECT_GE(c.fine, 0.999);
  EXPECT_GE(c.proved, 0.95);  // 0.81 where each cell only asks the pass of the one before
}

/// Passes of a tip of radius 2 beside each other, whose crest is nearly as high as the tolerance: no ball alone is near it from both
/// sides, and cells would have to be cut until they are as narrow as what is missing.
TEST(CoverSearch, ACrestIsProvedByBothPassesBesideIt) {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCone, 8.0, Eigen::Vector2d(2.0, 0.1));
  // Of crests of 0.95 of the tolerance.
  const double apart = 2.0 * std::sqrt(0.95 * kTolerance * (4.0 - 0.95 * kTolerance));
  const Path path = passes_beside_each_other(21, 2.0, -0.05, apart, 0.0);
  const SweptVolume volume(tool, path);
  const Face face = test::plane_face("F1", 20.0, 10.0);
  const FaceSamples coarse = sample_face(face, 0.4, true), fine = sample_face(face, 0.06, true);
  CoverLimits limits = usual_limits(coarse);
  limits.evaluations = 8 * coarse.points.size();
  const Coverage c = coverage_of(volume, *make_shape(face), coarse, fine, limits);
  EXPECT_GE(c.fine, 0.999);
  EXPECT_GE(c.proved, 0.99);
}

/// A budget for a quarter of what the next cut makes cuts a quarter of the cells, and proves as much of them.
TEST(CoverSearch, ABudgetThatEndsInsideACutIsSpentAllTheSame) {
  Random random(8);
  const Tool tool = brute::random_tool(random, 16.0);
  const SweptVolume volume(tool, pass(random, 0.0, tool.radial.at(8.0).r));
  const Face face = test::plane_face("F1", 20.0, 10.0);
  const FaceSamples samples = sample_face(face, 0.8, true);
  const auto f = swept_distances(volume, samples, 1e300);
  CoverLimits limits = usual_limits(samples);
  std::vector<double> open;
  for (const std::size_t halves : {0, 1, 2, 3}) {  // of a ball a sample
    limits.evaluations = halves * samples.points.size() / 2;
    const ProvedCover cover = search_cover(volume, *make_shape(face), samples, f, limits);
    EXPECT_LE(cover.evaluations, limits.evaluations);
    open.push_back(area_of(cover.open_mm2));
  }
  for (std::size_t k = 1; k < open.size(); ++k) EXPECT_LT(open[k], open[k - 1]) << k << " halves of a ball a sample";
}

TEST(CoverSearch, ABudgetIsSpentToItsEnd) {
  Tool tool;
  tool.radial = RadialFunction::spline(20.0, Eigen::VectorXd::Constant(6, 2.0));
  Path path;  // between passes across the face, what is left nearly reaches the tolerance
  for (int i = 0; i < 24; ++i)
    path.strips.push_back({i + 1,
                           "flank",
                           "F1",
                           {{Vec3(-1.0 + i, 2.0, -3.0), Vec3::UnitZ()}, {Vec3(-1.0 + i, 2.0, -2.5), Vec3::UnitZ()}}});
  const SweptVolume volume(tool, path);
  const Face face = test::plane_face("F1", 20.0, 0.3);
  const FaceSamples samples = sample_face(face, 0.9, true);
  const auto distances = swept_distances(volume, samples, 1e300);
  CoverLimits limits = usual_limits(samples);
  const ProvedCover all = search_cover(volume, *make_shape(face), samples, distances, limits);
  ASSERT_GT(all.evaluations, samples.points.size()) << "there must be something to cut";
  limits.evaluations = all.evaluations;
  EXPECT_EQ(search_cover(volume, *make_shape(face), samples, distances, limits).open_mm2, all.open_mm2);
  limits.evaluations = all.evaluations / 4;
  EXPECT_GT(area_of(search_cover(volume, *make_shape(face), samples, distances, limits).open_mm2),
            area_of(all.open_mm2));
}

/// The plane of 20 x 10 with knots along u in clusters, as lofts through many sections have them.
Face plane_of_many_knots() {
  Face face = test::plane_face("F1", 20.0, 10.0);
  BSplineSurface& s = face.surface;
  s.knots_u = {0.0, 0.0};
  for (int section = 1; section < 60; ++section)
    for (int k = 0; k < 4; ++k) s.knots_u.push_back(section / 60.0 + 1e-8 * k * (k + 1));
  s.knots_u.insert(s.knots_u.end(), {1.0, 1.0});
  s.poles.clear();
  s.count_u = static_cast<int>(s.knots_u.size()) - 2;
  for (int i = 1; i <= s.count_u; ++i)
    for (double z : {0.0, 10.0}) s.poles.emplace_back(20.0 * s.knots_u[static_cast<std::size_t>(i)], 0.0, z);
  return face;
}

TEST(CoverSearch, KnotsInsideACellCostNothing) {
  Random random(9);
  const Tool tool = brute::random_tool(random, 16.0);
  const SweptVolume volume(tool, pass(random, 0.02, tool.radial.at(8.0).r));
  const Face plain = test::plane_face("F1", 20.0, 10.0), knotty = plane_of_many_knots();
  std::vector<double> open;
  for (const Face* face : {&plain, &knotty}) {
    const FaceSamples samples = sample_face(*face, 0.4, true);
    CoverLimits limits = usual_limits(samples);
    limits.evaluations = 8 * samples.points.size();
    const auto f = swept_distances(volume, samples, 1e300);
    open.push_back(area_of(search_cover(volume, *make_shape(*face), samples, f, limits).open_mm2));
  }
  EXPECT_LT(open[0], 120.0) << "most of it is covered";
  EXPECT_LT(open[1], 1.1 * open[0]) << "of a grid of samples that differs";
}

TEST(CoverSearch, WhatTheLimitsForbidIsNotProved) {
  Random random(6);
  const Tool tool = brute::random_tool(random, 16.0);
  const SweptVolume volume(tool, pass(random, 0.03, tool.radial.at(8.0).r));
  const Face face = test::plane_face("F1", 20.0, 10.0);
  const FaceSamples samples = sample_face(face, 0.4, true);
  CoverLimits limits = usual_limits(samples);
  const auto f = swept_distances(volume, samples, 1e300);
  const double all = area_of(search_cover(volume, *make_shape(face), samples, f, limits).open_mm2);
  limits.evaluations = 0;
  EXPECT_GT(area_of(search_cover(volume, *make_shape(face), samples, f, limits).open_mm2), all);
}

TEST(CoverSearch, SameBitsForOneAndTwoThreads) {
  Random random(7);
  const Tool tool = brute::random_tool(random, 16.0);
  const SweptVolume volume(tool, pass(random, 0.03, tool.radial.at(8.0).r));
  const Face face = test::plane_face("F1", 20.0, 10.0);
  const FaceSamples samples = sample_face(face, 0.3, true);
  const auto f = swept_distances(volume, samples, 1e300);
  const int threads = thread_count();
  std::vector<std::vector<double>> open;
  for (int n : {1, 2}) {
    set_thread_count(n);
    open.push_back(search_cover(volume, *make_shape(face), samples, f, usual_limits(samples)).open_mm2);
  }
  set_thread_count(threads);
  EXPECT_EQ(open[0], open[1]);
}

}  // namespace
}  // namespace flank::internal::verify
