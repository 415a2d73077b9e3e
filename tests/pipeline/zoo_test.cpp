// Parts that the methods were not tuned on, where $FLANK_DATA has them: no crash, and no result worse than a simpler one.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "flank/fit.h"
#include "flank/part.h"
#include "flank/run.h"
#include "flank/target.h"
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

TEST(Zoo, AFitThatLosesItsWayOnAScrewRotorEndsWithAResult) {
  if (kSanitized) GTEST_SKIP() << "minutes under a sanitizer";
  const std::string file = zoo_part("screw_male_rotor_4lobe.step");
  if (file.empty()) GTEST_SKIP() << "FLANK_DATA has no zoo/screw_male_rotor_4lobe.step";
  // One start and few samples, without the other faces: the whole job takes two minutes.
  const Part part = read_part(file);
  const auto target = make_target({part.faces.front()});
  FlankFitOptions options;
  options.tolerance_mm = 0.25;
  options.bounds = {0.01 * target->diagonal(), 0.15 * target->diagonal(), 0.95, 8.0, 0.1};
  options.sample_share = 1.0 / 20.0;
  options.kept_after_quick = options.kept_after_polish = 1;
  const FlankFitResult result = fit_automatic(*target, {}, options, {});
  EXPECT_TRUE(result.tool.parameters().allFinite());
  EXPECT_NE(result.status, FitStatus::kNotRun);
  EXPECT_GE(result.after.at_tolerance, result.before.at_tolerance) << "no worse than it began";
  EXPECT_GT(result.after.at_tolerance, 0.1);
}

}  // namespace
}  // namespace flank::internal
