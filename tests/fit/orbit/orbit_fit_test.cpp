// A face that is screwed along itself: one strip, exact, from nothing.
#include "flank/fit/orbit/orbit_fit.h"

#include <gtest/gtest.h>

#include "flank/seed/ruled_start.h"
#include "sanitized.h"
#include "seed/screw_sheet.h"

namespace flank::internal {
namespace {

TEST(OrbitFit, CoversAScrewInOneStrip) {
  const auto target = testing::screw_target();
  const OrbitSection section(*target, Chart(*target), testing::screw_motion());
  ASSERT_TRUE(is_exact(section, 0.01));
  const Chart chart = orbit_chart(section);
  FlankFitOptions options;
  options.tolerance_mm = 0.01;
  options.bounds.largest = 8.0;
  options.bounds.slenderest = 8.0;
  RuledStart line;
  line.radius_mm = 4.0;
  const double length = 1.02 * longest_chord(chart, line);
  OrbitStart start;
  start.target = target.get();
  start.motions = {make_motion(chart, line, length, 12)};
  start.tool = RadialFunction::spline(length, Eigen::VectorXd::Constant(12, 4.0));
  for (int k = 0; k < 12; ++k) start.free_parameters.push_back(k);
  start.reachable = [](const SurfaceSample&) { return true; };
  const OrbitFit fit = orbit_fit(section, start, options);
  EXPECT_GE(fit.score, 0.98);
  ASSERT_EQ(fit.motions.size(), 1U);
  // The motion goes with the target: distances of the axis to it stay what they are.
  for (const double s : {0.25, 0.5, 0.75}) {
    const double first = target->closest(fit.motions[0].pose(0.35).at(s * length)).distance;
    const double second = target->closest(fit.motions[0].pose(0.6).at(s * length)).distance;
    EXPECT_NEAR(first, second, 2e-3);
  }
}

TEST(FitAutomatic, AScrewIsDoneInOneStripFromNothing) {
  if (kSanitized) GTEST_SKIP() << "a minute under a sanitizer; OrbitFit and the other fits run the same code";
  const auto target = testing::screw_target();
  FlankFitOptions options;
  options.tolerance_mm = 0.01;
  options.bounds.largest = 8.0;
  options.bounds.slenderest = 8.0;
  options.bounds.neck = 0.1;
  options.enough_coverage = 0.995;
  const FlankFitResult result = fit_automatic(*target, ToolModel{}, options, Progress{});
  EXPECT_EQ(result.status, FitStatus::kWithinTolerance);
  EXPECT_GE(result.after.at_tolerance, 0.995);
  EXPECT_LT(result.after.largest_c, 1.0);
}

}  // namespace
}  // namespace flank::internal
