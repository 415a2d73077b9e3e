// What a cavity's program leaves on purpose, by a replay of its own in a fine stock: nothing of the planner, and no grown tool.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/example.h"
#include "flank/results/view.h"
#include "flank/run.h"
#include "flank/target.h"
#include "flank/verify/stock/replay.h"
#include "load_share.h"
#include "sanitized.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

constexpr double kAllowance = 0.2, kOffBy = 0.05, kCell = 0.15;

class CavityAllowance : public TemporaryFolder {
 protected:
  CavityAllowance() : TemporaryFolder("flank_cavity_allowance") {}
};

/// What is left on the faces where the program comes as near as is wanted, mm.
struct Left {
  double least = 1e300, most = -1e300;
  std::size_t places = 0;
};

/// What a replay of the program leaves on faces, at their samples that are wanted. All is material there, not the blank alone, which may end
/// before a wall.
template <class Wanted>
Left left_on(const std::vector<Face>& walls, const Result& result, const Wanted& wanted) {
  std::vector<FaceSamples> samples;
  Box3 box;
  for (const Face& wall : walls) {
    samples.push_back(sample_face(wall, 0.7, true));
    for (const Vec3& p : samples.back().points) box.add(p);
  }
  box.low.array() -= 1.0;
  box.high.array() += 1.0;
  verify::DexelStock stock(box, {}, kCell);
  (void)verify::replay(stock, result.tool.radial, result.path, {.circles = 0});
  Left left;
  for (const FaceSamples& face : samples)
    for (const Vec3& p : face.points) {
      const std::optional<double> depth = wanted(p) ? stock.distance(p) : std::nullopt;
      if (!depth) continue;
      left.least = std::min(left.least, *depth);
      left.most = std::max(left.most, *depth);
      ++left.places;
    }
  return left;
}

/// Where the program comes as near to the sides as is wanted.
Left left_on_sides(const Example& cavity, const Result& result, double tolerance_mm) {
  const SweptVolume volume(result.tool, result.path);
  return left_on({cavity.faces[0], cavity.faces[1]}, result,
                 [&](const Vec3& p) { return std::abs(volume.distance(p, 1.0).f - kAllowance) <= tolerance_mm; });
}

/// Before the wall across the end, where the tool fits in between the sides: a tenth of a radius off the corners, and over as much of the
/// height as the flank has there whatever its axis leans.
Left left_before_end(const Example& cavity, const Result& result, double depth_mm) {
  const double radius = result.tool.radial.largest();
  const std::unique_ptr<Target> one = make_target({cavity.faces[0]}), other = make_target({cavity.faces[1]});
  return left_on({cavity.faces[2]}, result, [&](const Vec3& p) {
    const Vec3 centre = p - (radius + kAllowance) * Vec3::UnitX();
    const double clear =
        std::min((one->closest(centre).point - centre).norm(), (other->closest(centre).point - centre).norm());
    return std::abs(p.z()) < 0.4 * depth_mm && clear > 1.1 * radius + kAllowance;
  });
}

/// How near the tool as it is comes to a face, mm.
double nearest_to(const Face& face, const Result& result) {
  const SweptVolume volume(result.tool, result.path);
  double least = 1e300;
  for (const SweptDistance& d : swept_distances(volume, sample_face(face, 0.7, false), 1e300))
    least = std::min(least, d.f);
  return least;
}

TEST_F(CavityAllowance, IsLeftOnItsWallsAndBeforeItsEnd) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer";
  ExampleOptions options;
  options.cavity = {.width_mm = 14.0, .depth_mm = 12.0, .length_mm = 20.0, .twist_deg = 0.0, .hollow_mm = 0.0};
  options.cavity.end_wall = true;
  const Example cavity = make_example("cavity", options);
  const std::string file = (root_ / "cavity.step").string();
  (void)write_example(cavity, file);
  TrochoidJob job;
  job.part.file = file;
  job.part.allowance_mm = kAllowance;
  job.tolerance_mm = 0.05;
  const Result result = run_trochoid(job);
  ASSERT_FALSE(result.path.strips.empty());
  EXPECT_TRUE(result.acceptance().pass());
  EXPECT_DOUBLE_EQ(result.verify.allowance_mm, kAllowance);
  const Left left = left_on_sides(cavity, result, 0.05);
  EXPECT_GT(left.places, 500u);
  EXPECT_GE(left.least, kAllowance - kOffBy);
  EXPECT_LE(left.most, kAllowance + kOffBy);
  // A wall less than a radius beyond the sides' ends was taken for one right there.
  const Left before_end = left_before_end(cavity, result, options.cavity.depth_mm);
  EXPECT_GT(before_end.places, 20u);
  EXPECT_GE(before_end.least, kAllowance - kOffBy);
  EXPECT_LE(before_end.most, kAllowance + kOffBy);
  EXPECT_GE(nearest_to(cavity.faces[2], result), kAllowance - kOffBy) << "in its corners, too";
  test::expect_shorter_by_load(result.tool, result.path, result.drawings->arcs, 0.6);
}

}  // namespace
}  // namespace flank::internal
