// What a cavity's program leaves on purpose, by a replay of its own in a fine stock: nothing of the planner, and no grown tool.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/example.h"
#include "flank/results/view.h"
#include "flank/run.h"
#include "flank/verify/stock/replay.h"
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

Left left_on(const std::vector<Face>& walls, const Result& result, double tolerance_mm) {
  std::vector<FaceSamples> samples;
  Box3 box;
  for (const Face& wall : walls) {
    samples.push_back(sample_face(wall, 0.7, true));
    for (const Vec3& p : samples.back().points) box.add(p);
  }
  box.low.array() -= 1.0;
  box.high.array() += 1.0;
  verify::DexelStock stock(box, result.drawings->blank, kCell);
  (void)verify::replay(stock, result.tool.radial, result.path, {.circles = 0});
  const SweptVolume volume(result.tool, result.path);
  Left left;
  for (const FaceSamples& face : samples)
    for (const Vec3& p : face.points) {
      const std::optional<double> depth = stock.distance(p);
      if (!depth || std::abs(volume.distance(p, 1.0).f - kAllowance) > tolerance_mm) continue;
      left.least = std::min(left.least, *depth);
      left.most = std::max(left.most, *depth);
      ++left.places;
    }
  return left;
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
  const Left left = left_on({cavity.faces[0], cavity.faces[1]}, result, 0.05);
  EXPECT_GT(left.places, 500u);
  EXPECT_GE(left.least, kAllowance - kOffBy);
  EXPECT_LE(left.most, kAllowance + kOffBy);
  // Cycles end a step before the wall across the end: more is left there, and nowhere less.
  EXPECT_GE(nearest_to(cavity.faces[2], result), kAllowance - kOffBy);
}

}  // namespace
}  // namespace flank::internal
