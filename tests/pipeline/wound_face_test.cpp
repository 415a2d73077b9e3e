// Threads: half a turn of them is searched, and what is found goes with their screw.
#include "flank/pipeline/search/wound_face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/fit/coverage.h"
#include "flank/pipeline/search/fit_search.h"
#include "flank/setup/targets.h"
#include "sanitized.h"
#include "seed/sheet.h"

namespace flank::internal {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi, kLead = 8.0;  // mm a turn

/// The flank of a thread about z, 3 mm wide: u goes across, v along. `wave`: mm by which it goes up and down along the way.
auto thread_of(double turns, double wave = 0.0) {
  return [=](double u, double v) {
    const double angle = kTurn * turns * (v - 0.5), r = 9.0 + 3.0 * u;
    return Vec3(r * std::cos(angle), r * std::sin(angle),
                kLead * angle / kTurn + 0.9 * u + wave * std::sin(3.0 * angle));
  };
}

auto setup_of(double turns, double wave = 0.0) {
  flank::internal::Setup setup;
  setup.part.faces = {testing::sheet(thread_of(turns, wave), 5, 8 + static_cast<int>(32 * turns))};
  setup.part.surface_types = {"B-spline"};
  setup.targets = {0};
  setup.tolerance_mm = 0.01;
  return setup;
}

TEST(WoundFace, IsOneOfMoreThanATurn) {
  const auto wound = find_wound_face(setup_of(3.0));
  ASSERT_TRUE(wound);
  EXPECT_NEAR(wound->turns(), 3.0, 1e-3);
  EXPECT_NEAR(std::abs(wound->motion.slide.dot(wound->motion.turn)) / wound->motion.turn.squaredNorm(), kLead / kTurn,
              1e-3);
  EXPECT_NEAR(wound->first, -wound->last, 1e-3 * wound->last) << "time begins in the middle";
  EXPECT_FALSE(find_wound_face(setup_of(0.9)));
}

TEST(WoundFace, StaysWhereItIs) {
  EXPECT_TRUE(find_wound_face(setup_of(3.0, 0.001)));
  EXPECT_FALSE(find_wound_face(setup_of(3.0, 0.05))) << "a wave of five tolerances";
}

TEST(WoundFace, HalfATurnStandsForItAndTheRestIsChecked) {
  const auto whole = setup_of(3.0);
  const auto wound = find_wound_face(whole);
  ASSERT_TRUE(wound);
  const auto half = half_turn_of(whole, *wound);
  ASSERT_EQ(half.part.faces.size(), 3u);
  EXPECT_EQ(half.checks, (std::vector<int>{1, 2}));
  const double area = make_targets(whole).front().target->area();
  EXPECT_NEAR(make_targets(half).front().target->area(), area / 6.0, 0.01 * area);
}

TEST(WoundFace, TheMotionGoesOverAllOfIt) {
  if (kSanitized) GTEST_SKIP() << "a whole fit takes minutes under a sanitizer";
  const auto setup = setup_of(3.0);
  FitJob job;
  job.tolerance_mm = setup.tolerance_mm;
  job.part.side = +1;
  const FitSearch search = search_fit(job, setup, parse_tool_spec("free"), {});
  ASSERT_TRUE(search.wound_face);
  ASSERT_FALSE(search.fit.motions.empty());
  const Target& whole = *search.machined().front().target;
  const CoverageEstimate estimate =
      estimate_coverage(whole.samples(0.5), search.motions_of(search.fit), search.fit.tool, *job.tolerance_mm, 600);
  EXPECT_GE(estimate.at_tolerance, 0.99);
  EXPECT_LE(estimate.overcut_mm, *job.tolerance_mm);
}

}  // namespace
}  // namespace flank::internal
