#include "flank/bound/free_bound.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "flank/example.h"
#include "flank/target.h"
#include "rotor37_file.h"

namespace flank::internal {
namespace {

/// A tool leaves an exact envelope without error, so a bound for its radii must be none.
TEST(FreeBound, OfAnExactEnvelopeIsNone) {
  for (const char* name : {"envelope-cone-1", "envelope-barrel-1", "envelope-hyperbolic-1", "envelope-spline-1"}) {
    const Example example = make_example(name);
    for (const Face& face : example.faces) {
      const auto target = make_target({face});
      const double radius = example.truth->tool.radial.smallest();
      const BallBound bound = ball_bound(*target, {.faces = {target.get()}},
                                         {.radius_mm = radius, .spacing_mm = std::sqrt(target->area() / 300.0)}, {});
      EXPECT_LE(bound.bound_mm, 2e-6 * target->diagonal()) << name;
    }
  }
}

BoundJob blisk_blade() {
  BoundJob job;
  job.part.file = test::rotor37_file("rotor37-blisk");
  job.part.faces = "F9";
  job.points = 60;
  job.gap = 0.2;
  return job;
}

TEST(FreeBound, OfABladeOnItsHubIsAtTheFoot) {
  ASSERT_TRUE(asks_for_free_tool(blisk_blade()));
  const FreeBound result = run_free_bound(blisk_blade(), {});
  ASSERT_TRUE(result.complete);
  ASSERT_EQ(result.targets.size(), 1u);
  const FreeBoundTarget& target = result.targets.front();
  EXPECT_NEAR(target.radius_mm, 0.01 * target.diagonal_mm, 1e-9);
  EXPECT_GT(result.bound_mm(), 0.0);
  EXPECT_LT(result.bound_mm(), target.radius_mm);
  EXPECT_GE(target.bound.found_mm, result.bound_mm());
  const nlohmann::json json = nlohmann::json::parse(free_bound_json(result));
  EXPECT_EQ(json["schema"], "openflank/free-bound/1");
  EXPECT_EQ(json["least_error"], result.bound_mm());
  EXPECT_EQ(json["targets"][0]["sites"], target.bound.sites);
  EXPECT_NE(free_bound_text(result).find("every such tool"), std::string::npos) << free_bound_text(result);
}

TEST(FreeBound, OfTheBladeAloneIsNone) {
  BoundJob job = blisk_blade();
  job.ignore_faces = "S1";
  const FreeBound result = run_free_bound(job, {});
  EXPECT_EQ(result.bound_mm(), 0.0);
  EXPECT_NE(free_bound_text(result).find("nothing is proved"), std::string::npos) << free_bound_text(result);
}

TEST(FreeBound, GrowsWithTheSmallestRadius) {
  BoundJob job = blisk_blade();
  job.radius_min_mm = 0.5;
  const double thin = run_free_bound(job, {}).bound_mm();
  job.radius_min_mm = 2.0;
  EXPECT_GT(run_free_bound(job, {}).bound_mm(), thin);
}

}  // namespace
}  // namespace flank::internal
