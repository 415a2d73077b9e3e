// Parts that the methods were not tuned on, where $FLANK_DATA has them: no crash, and no result worse than a simpler one.
#include <gtest/gtest.h>

#include "flank/run.h"
#include "sanitized.h"
#include "shared_data.h"

namespace flank::internal {
namespace {

FitJob job_of(const std::string& file, double tolerance_mm) {
  FitJob job;
  job.part.file = file;
  job.tolerance_mm = tolerance_mm;
  job.strips = 1;
  return job;
}

TEST(Zoo, ACapThatAFewSeeDoesNotDriveAToolOffABlade) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer";
  FLANK_REAL_PART(file, "zoo/hecc_main_blade.step");
  // The cap alone: the other faces take six times as long, and are not what drove it off.
  FitJob job = job_of(file, 0.05);
  job.obstacles.check_faces = "F6";
  const Result beside = run_fit(job);
  EXPECT_GE(beside.verify.coverage, 0.98);
  EXPECT_LE(beside.verify.gouge_mm, 0.05);
  EXPECT_LE(beside.verify.overcut_mm, 0.05);
  EXPECT_LT(beside.largest_c, 1.0);
  job.avoid = false;
  EXPECT_GE(run_fit(job).verify.coverage, beside.verify.coverage - 0.005);
}

TEST(Zoo, ALobeOfAScrewRotorIsDoneInThreeStripsOfOneStiffTool) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer";
  FLANK_REAL_PART(file, "zoo/screw_male_rotor_4lobe.step");
  FitJob job = job_of(file, 0.25);
  job.strips = 3;
  const Result result = run_fit(job);
  EXPECT_TRUE(result.acceptance().pass());
  EXPECT_GE(result.verify.coverage_reachable, 0.99);
  EXPECT_LT(result.largest_c, 1.0);
  EXPECT_GE(result.tool.radial.smallest(), 1.5) << "no rod";
}

}  // namespace
}  // namespace flank::internal
