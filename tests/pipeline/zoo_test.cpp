// Parts that the methods were not tuned on, where $FLANK_DATA has them: no crash, and no result worse than a simpler one.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "flank/run.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

std::string zoo_part(const std::string& name) {
  const char* folder = std::getenv("FLANK_DATA");
  const std::filesystem::path file =
      (folder ? std::filesystem::path(folder) : std::filesystem::path(FLANK_SOURCE_DIR) / "../shared/data") / "zoo" /
      name;
  return std::filesystem::exists(file) ? file.string() : std::string();
}

FitJob job_of(const std::string& file, double tolerance_mm) {
  FitJob job;
  job.part.file = file;
  job.tolerance_mm = tolerance_mm;
  job.strips = 1;
  return job;
}

TEST(Zoo, ACapThatAFewSeeDoesNotDriveAToolOffABlade) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer";
  const std::string file = zoo_part("hecc_main_blade.step");
  if (file.empty()) GTEST_SKIP() << "FLANK_DATA has no zoo/hecc_main_blade.step";
  const Result all = run_fit(job_of(file, 0.05));
  EXPECT_GE(all.verify.coverage, 0.98);
  EXPECT_LE(all.verify.gouge_mm, 0.05);
  EXPECT_LE(all.verify.overcut_mm, 0.05);
  EXPECT_LT(all.largest_c, 1.0);
  FitJob fewer = job_of(file, 0.05);
  fewer.obstacles.ignore_faces = "F6";
  EXPECT_GE(run_fit(fewer).verify.coverage, all.verify.coverage - 0.005);
}

TEST(Zoo, AFitThatLosesItsWayOnAScrewRotorEndsWithAResult) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer";
  const std::string file = zoo_part("screw_male_rotor_4lobe.step");
  if (file.empty()) GTEST_SKIP() << "FLANK_DATA has no zoo/screw_male_rotor_4lobe.step";
  const Result result = run_fit(job_of(file, 0.25));
  EXPECT_GT(result.verify.coverage, 0.3);
}

}  // namespace
}  // namespace flank::internal
