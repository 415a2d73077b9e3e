// Feeds of programs along paths of real blades, which fits have left here: where passes begin and end, and by the load of a cut of even
// thickness.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "flank/example.h"
#include "flank/io/text/json_input.h"
#include "flank/job/job_json.h"
#include "flank/path_file.h"
#include "flank/pipeline/load/known_feeds.h"
#include "flank/run.h"
#include "flank/setup/read_setup.h"
#include "flank/tool_file.h"
#include "load_share.h"
#include "sanitized.h"
#include "shared_data.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

class PostFeeds : public TemporaryFolder {
 protected:
  PostFeeds() : TemporaryFolder("flank_post_feeds") {}
  /// The folder of a fit of face F1.
  [[nodiscard]] std::string folder_of(const std::string& fit, const std::string& part, double tolerance_mm) const {
    const fs::path folder = root_ / fit, stored = fs::path(FLANK_SOURCE_DIR) / "tests/pipeline/fits";
    fs::create_directories(folder);
    for (const char* name : {"path.json", "tool.json"}) fs::copy(stored / (fit + "." + name), folder / name);
    FitJob job;
    job.part.file = part;
    job.part.faces = "F1";
    job.tolerance_mm = tolerance_mm;
    std::ofstream(folder / "job.json") << job_to_json(job);
    return folder.string();
  }
};

/// The least mean feed over a tenth of a second of any pass, its first and its last one too, mm/min.
double slowest_tenth(const std::string& motion) {
  const nlohmann::json json = nlohmann::json::parse(motion);
  const std::vector<double> time = json.at("time_s"), feed = json.at("feed_mm_min");
  const std::vector<int> cutting = json.at("cutting");
  double least = 1e300;
  for (std::size_t k = 1; k < time.size(); ++k) {
    double seconds = 0.0, way = 0.0;
    for (std::size_t i = k; i < time.size() && cutting[i] != 0 && seconds < 0.1; ++i) {
      seconds += time[i] - time[i - 1];
      way += feed[i] * (time[i] - time[i - 1]);
    }
    if (seconds >= 0.1) least = std::min(least, way / seconds);
  }
  return least;
}

void expect_no_crawl(const std::string& folder) {
  constexpr double kFeed = 1000.0;
  for (const char* machine : {"siemens-ac", "linuxcnc-xyzac-trt"}) {
    PostJob job;
    job.folder = folder;
    job.machine = machine;
    job.feed_mm_min = kFeed;
    job.spindle_rpm = 8000.0;
    const PostOutcome outcome = run_post(job);
    ASSERT_FALSE(outcome.motion.empty());
    const double slowest = slowest_tenth(outcome.motion);
    EXPECT_GE(slowest, 0.5 * kFeed) << machine;
    ::testing::Test::RecordProperty(std::string(machine) + "_slowest_tenth_mm_min", std::to_string(slowest));
  }
}

/// Links were tangent to a pass in place and not in direction: the tool crawled at 3 % of the feed where a pass begins.
TEST_F(PostFeeds, NoTenthOfASecondOfACompressorBladeIsBelowHalf) {
  if (kSanitized) GTEST_SKIP() << "OperationsProgram has the code";
  FLANK_REAL_PART(part, "r37_blade.step");
  expect_no_crawl(folder_of("r37_f1", part, 0.1));
}

TEST_F(PostFeeds, NoTenthOfASecondOfAnImpellerBladeIsBelowHalf) {
  if (kSanitized) GTEST_SKIP() << "OperationsProgram has the code";
  FLANK_REAL_PART(part, "kj66_impeller.step");
  expect_no_crawl(folder_of("kj66_f1", part, 0.02));
}

/// Of a cut that takes 0.2 mm off the faces of a job.
void expect_shorter_by_load(const FitJob& job, const Tool& tool, const Path& path, double share) {
  std::vector<std::string> notes;
  const Setup setup = read_setup(job.part, job.obstacles, job.tolerance_mm, notes);
  test::expect_shorter_by_load(tool, path, engaged_arcs({}, 0.2, setup, tool, path), share);
}

void expect_shorter_by_load(const std::string& folder, double share) {
  const FitJob job = std::get<FitJob>(job_from_json(read_file(folder + "/job.json"), folder));
  expect_shorter_by_load(job, read_tool(folder + "/tool.json"), read_path(folder + "/path.json"), share);
}

TEST_F(PostFeeds, ByTheLoadAFaceOfOnePassTakesLessThanAtAnEvenFeedOfTheSamePeak) {
  if (kSanitized) GTEST_SKIP() << "PathLoads has the code";
  const Example example = make_example("twisted-blade", {});
  const std::string part = (root_ / "part.step").string();
  (void)write_example(example, part);
  FitJob job;
  job.part.file = part;
  job.tolerance_mm = 0.3;
  const Result result = run_fit(job);
  expect_shorter_by_load(job, result.tool, result.path, 0.95);
}

TEST_F(PostFeeds, ByTheLoadACompressorBladeTakesLessThanAtAnEvenFeedOfTheSamePeak) {
  if (kSanitized) GTEST_SKIP() << "PathLoads has the code";
  FLANK_REAL_PART(part, "r37_blade.step");
  expect_shorter_by_load(folder_of("r37_f1", part, 0.1), 0.95);
}

TEST_F(PostFeeds, ByTheLoadAnImpellerBladeTakesLessThanAtAnEvenFeedOfTheSamePeak) {
  if (kSanitized) GTEST_SKIP() << "PathLoads has the code";
  FLANK_REAL_PART(part, "kj66_impeller.step");
  expect_shorter_by_load(folder_of("kj66_f1", part, 0.02), 0.85);
}

}  // namespace
}  // namespace flank::internal
