// Damaged job files and holder outlines: finite values, or a refusal that names the file.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <variant>

#include "flank/job/job_json.h"
#include "flank/setup/tool_body.h"
#include "mutations.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

FitJob full_job() {
  FitJob job;
  job.part = {"/parts/blade.step", "mm", "F1,F3", {}, -1};
  job.tool = {"barrel:arc=85,radius=5,s0=7", 40.5};
  job.radius = {2.25, 9.75, 0.75, 6.5, "any", 0.25, 60.5};
  job.obstacles = {{}, {}, "given", 4.5, 30.25, "0:10,30:12.5", {"/parts/vice.stl"}, "cm", 0.75};
  job.judge = {0.9, 0.8, 0.375, 3.5, 12.0};
  job.tolerance_mm = 0.0125;
  job.start = "0,0,5,0,0,45";
  job.guide = "/parts/guide.txt";
  job.strips = 3;
  job.avoid = false;
  return job;
}

bool finite(const std::optional<double>& value) { return !value || std::isfinite(*value); }

/// The numbers that fit and cover have in common.
template <class Job>
bool sound_request(const Job& job) {
  return finite(job.tolerance_mm) && std::isfinite(job.judge.least_coverage) && finite(job.judge.sample_mm) &&
         finite(job.judge.reach_radius_mm) && finite(job.tool.axis_length_mm) &&
         finite(job.obstacles.shank_radius_mm) && finite(job.obstacles.shank_length_mm) &&
         finite(job.obstacles.clearance_mm);
}

bool sound(const FitJob& job) {
  return sound_request(job) && std::isfinite(job.radius.slope_max) && finite(job.radius.min_mm) &&
         finite(job.radius.max_mm);
}
bool sound(const CoverJob& job) {
  return sound_request(job) && std::isfinite(job.choice.feed_mm_min) && std::isfinite(job.choice.rapid_mm_min) &&
         finite(job.strip_price);
}
bool sound(const PlanJob& plan) {
  return std::visit([](const auto& job) { return sound(job); }, plan);
}

TEST(JobMutations, EveryFieldComesBack) {
  const FitJob job = full_job();
  const PlanJob back = job_from_json(job_to_json(job), "job.json");
  EXPECT_EQ(std::get<FitJob>(back), job);
  EXPECT_EQ(job_to_json(back), job_to_json(job));
}

TEST(JobMutations, JobsAreReadOrRefused) {
  const MutationCount count = mutate(job_to_json(full_job()), "job.json", 1,
                                     [](const std::string& text) { return sound(job_from_json(text, "job.json")); });
  EXPECT_GT(count.read, kMutants / 20);
  EXPECT_GT(count.refused, kMutants / 10);
}

class HolderFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    file_ = fs::path(::testing::TempDir()) / ("flank_holder_" + std::to_string(::getpid()) + ".txt");
  }
  void TearDown() override { fs::remove(file_); }
  std::vector<Vec2> read(const std::string& text) const {
    std::ofstream(file_, std::ios::binary) << text;
    return holder_profile(file_.string());
  }
  /// Finite, not negative, two points or more, z not falling.
  static bool sound(const std::vector<Vec2>& profile) {
    for (std::size_t i = 0; i < profile.size(); ++i)
      if (!profile[i].allFinite() || profile[i].minCoeff() < 0.0 || (i > 0 && profile[i].x() < profile[i - 1].x()))
        return false;
    return profile.size() >= 2;
  }

  fs::path file_;
};

TEST_F(HolderFiles, OutlinesAreReadOrRefused) {
  const std::string good = "# z radius\n0 10.5\n12.25,10.5 # a step\n12.25:14\r\n\n30;14\n45.5\t9\n";
  ASSERT_EQ(read(good).size(), 5u);
  const MutationCount count =
      mutate(good, file_.string(), 2, [&](const std::string& text) { return sound(read(text)); });
  EXPECT_GT(count.read, kMutants / 20);
  EXPECT_GT(count.refused, kMutants / 10);
}

TEST_F(HolderFiles, OutlinesOfJsonAreReadOrRefused) {
  const std::string good = "[[0, 10.5],\n [12.25, 10.5],\n [12.25, 14],\n [45.5, 9]]\n";
  const std::vector<Vec2> wanted{{0, 10.5}, {12.25, 10.5}, {12.25, 14}, {45.5, 9}};
  EXPECT_EQ(read(good), wanted);
  const MutationCount count =
      mutate(good, file_.string(), 3, [&](const std::string& text) { return sound(read(text)); });
  EXPECT_GT(count.read, kMutants / 20);
  EXPECT_GT(count.refused, kMutants / 10);
}

TEST(HolderProfile, WordsOnTheCommandLineAreReadOrRefused) {
  EXPECT_EQ(holder_profile("0:10,30:12.5"), (std::vector<Vec2>{{0, 10}, {30, 12.5}}));
  const MutationCount count = mutate("0:10,30:12.5,30.25:14,60:9", "holder", 4, [](const std::string& text) {
    if (text.find(':') == std::string::npos) return true;  // the name of a file
    for (const Vec2& p : holder_profile(text))
      if (!p.allFinite()) return false;
    return true;
  });
  EXPECT_GT(count.read, kMutants / 20);
}

TEST(HolderProfile, AnOutlineOfManyPointsMayBeLongerThanANameOfAFile) {
  std::string words = "0:10";
  for (int i = 1; i < 500; ++i) words += "," + std::to_string(i) + ":10.125";
  EXPECT_EQ(holder_profile(words).size(), 500u);
  ObstacleRequest job;
  job.holder = words;
  EXPECT_NO_THROW(check_obstacles(job, nullptr));
}

TEST(ObstacleCheck, AFixtureWithANameTooLongForAFileIsNoSuchFile) {
  ObstacleRequest job;
  job.fixtures = {std::string(5000, 'x') + ".stl"};
  try {
    check_obstacles(job, nullptr);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("no such fixture"), std::string::npos);
  }
}

}  // namespace
}  // namespace flank::internal
