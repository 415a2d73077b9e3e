// job.json: what is written reads back, every field is in it, and what is wrong is refused by name.
#include "flank/job/job_json.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "flank/error.h"
#include "flank/job/command_line.h"
#include "job/random_jobs.h"

namespace flank::internal {
namespace {

using nlohmann::json;

std::string refusal(const std::string& text) {
  try {
    (void)job_from_json(text, "job.json");
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).rfind("job.json: ", 0), 0u) << e.what();
    return e.what();
  }
  return "accepted";
}

/// A job of the least that is needed, changed.
std::string changed(const std::string& key, const json& value) {
  json job = {{"schema", "openflank/job/1"}, {"part", "/a.step"}, {"faces", "F1"}, {"tolerance", 0.1}};
  if (value.is_null())
    job.erase(key);
  else
    job[key] = value;
  return job.dump();
}

template <class Job>
class JobJson : public testing::Test {};
using Jobs = testing::Types<FitJob, CoverJob, TrochoidJob>;
TYPED_TEST_SUITE(JobJson, Jobs);

TYPED_TEST(JobJson, ReadsBackAsItWas) {
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    TypeParam job = jobs::random_job<TypeParam>(random);
    // Names of files are cleaned when they are made absolute, and JSON is UTF-8.
    visit_fields(job, [](const FieldInfo& info, auto& value) {
      if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>) {
        if (info.spelling == Spelling::kFile) value = "/parts/a b.step";
      }
    });
    job.obstacles.fixtures.assign(job.obstacles.fixtures.size(), "/vice's jaw.step");
    const auto ascii = [](std::string& text) {
      for (char& c : text)
        if (static_cast<unsigned char>(c) > 127) c = 'u';
    };
    visit_fields(job, [&](const FieldInfo&, auto& value) {
      using Value = std::decay_t<decltype(value)>;
      if constexpr (std::is_same_v<Value, std::string>) ascii(value);
      if constexpr (std::is_same_v<Value, std::optional<std::string>>) {
        if (value) ascii(*value);
      }
    });
    const PlanJob back = job_from_json(job_to_json(job), "job.json");
    ASSERT_TRUE(std::holds_alternative<TypeParam>(back));
    // A guide's or catalogue's random name may hold "//" or "/./"; its cleaned form reads back as itself.
    EXPECT_EQ(job_to_json(back), job_to_json(job));
    EXPECT_EQ(std::get<TypeParam>(back).tolerance_mm, job.tolerance_mm);
    EXPECT_EQ(std::get<TypeParam>(back).obstacles, job.obstacles);
    EXPECT_EQ(std::get<TypeParam>(back).tool, job.tool);
    EXPECT_EQ(std::get<TypeParam>(back).judge, job.judge);
  }
}

TYPED_TEST(JobJson, AChangeOfAnyFieldShowsInTheFileAndInTheCommand) {
  const std::string usual = job_to_json(TypeParam{}), command = command_line(TypeParam{});
  std::size_t count = 0;
  const TypeParam usual_job;
  visit_fields(usual_job, [&](const FieldInfo&, const auto&) { ++count; });
  for (std::size_t changed_field = 0; changed_field < count; ++changed_field) {
    TypeParam job;
    Random random(5);
    std::size_t k = 0;
    std::string key;
    visit_fields(job, [&](const FieldInfo& info, auto& value) {
      if (k++ != changed_field) return;
      key = info.key;
      for (const auto before = value; value == before;) jobs::randomise(info, value, random);
      using Value = std::decay_t<decltype(value)>;
      if constexpr (std::is_same_v<Value, std::string>) {
        if (!info.accepted.text) value = "/plain";
      }
      if constexpr (std::is_same_v<Value, std::optional<std::string>>) {
        if (!info.accepted.text) value = "/plain";
      }
      if constexpr (std::is_same_v<Value, std::vector<std::string>>) value = {"/plain"};
    });
    EXPECT_NE(job_to_json(job), usual) << key;
    EXPECT_TRUE(json::parse(job_to_json(job)).contains(key)) << key;
    EXPECT_NE(command_line(job), command) << key;
  }
}

TEST(JobFile, NamesFilesByAbsolutePaths) {
  FitJob job;
  job.part.file = "parts/../blade.step";
  job.obstacles.fixtures = {"vice.step"};
  const json written = json::parse(job_to_json(job));
  EXPECT_EQ(written.at("part"), (std::filesystem::current_path() / "blade.step").string());
  EXPECT_EQ(written.at("fixtures").at(0), (std::filesystem::current_path() / "vice.step").string());
  EXPECT_FALSE(written.contains("guide")) << "what was not asked for is not in the file";
}

TEST(JobFile, NamesToolsByAbsolutePathsWhereTheyAreFiles) {
  const std::filesystem::path file = "job_json_test_tool.json";
  std::ofstream(file) << "{}";
  FitJob job;
  job.part.file = "blade.step";
  job.tool.spec = file.string();
  const json written = json::parse(job_to_json(job));
  EXPECT_EQ(written.at("tool"), std::filesystem::absolute(file).string());
  std::filesystem::remove(file);
  job.tool.spec = "cone:radius=2.5,angle=3";
  EXPECT_EQ(json::parse(job_to_json(job)).at("tool"), job.tool.spec);
}

TEST(JobFile, FilesOfEarlierVersionsRead) {
  const char* fit =
      R"({"schema": "openflank/job/1", "units": "mm", "command": "fit", "part": "/a.step", "faces": "F1,F3",
    "side": -1, "tool": "barrel", "start": "0,0,0,0,0,9", "strips": 0, "tolerance": 0.05, "axis_length": 20.0,
    "radius_min": 2.0, "radius_max": 9.0, "slope_max": 0.9, "coverage": 0.9, "sample": 0.5, "reach_radius": 1.5,
    "check_faces": "F5", "avoid": false, "shank_radius": 4.0, "shank_length": 30.0, "holder": "30:10,70:10",
    "clearance": 0.5, "fixtures": ["/vice.step"]})";
  const PlanJob plan = job_from_json(fit, "job.json");
  const FitJob& job = std::get<FitJob>(plan);
  EXPECT_EQ(job.part.side, -1);
  EXPECT_EQ(job.strips, 0);
  EXPECT_EQ(job.radius.max_mm, 9.0);
  EXPECT_EQ(job.obstacles.shank_length_mm, 30.0);
  EXPECT_EQ(job.obstacles.fixtures, std::vector<std::string>{"/vice.step"});
  EXPECT_FALSE(job.avoid);
  const char* cover =
      R"({"schema": "openflank/job/1", "units": "mm", "command": "cover", "part": "/a.step", "faces": "F1",
    "tool": "cylinder:radius=5", "strips": 1, "tolerance": 0.05, "axis_length": 20.0, "slope_max": 0.95,
    "coverage": 0.95, "avoid": true})";
  const PlanJob old = job_from_json(cover, "job.json");
  EXPECT_EQ(std::get<CoverJob>(old).tool.spec, "cylinder:radius=5");
  EXPECT_FALSE(std::get<CoverJob>(old).most_strips) << "a fit's field, which meant nothing";
}

TEST(JobFile, RefusesWhatIsWrongByItsName) {
  EXPECT_EQ(refusal(changed("units", "mm")), "accepted");
  EXPECT_NE(refusal(changed("units", "in")).find("units: is \"in\"; expected \"mm\""), std::string::npos);
  for (const char* key : {"part", "faces"})
    EXPECT_NE(refusal(changed(key, nullptr)).find(std::string(key) + ": is missing"), std::string::npos);
  EXPECT_NE(refusal(changed("tolerence", 0.1)).find("tolerence: unknown key"), std::string::npos);
  EXPECT_NE(refusal(changed("strategy", "grow")).find("strategy: unknown key"), std::string::npos) << "of a cover";
  EXPECT_NE(refusal(changed("tolerance", "0.1")).find("tolerance: expected a number"), std::string::npos);
  EXPECT_NE(refusal(changed("tolerance", -0.1)).find("tolerance_mm -0.1"), std::string::npos);
  EXPECT_NE(refusal(changed("strips", 1.5)).find("strips: expected a whole number"), std::string::npos);
  EXPECT_NE(refusal(changed("strips", 1e12)).find("strips: expected a whole number"), std::string::npos);
  EXPECT_NE(refusal(changed("side", 2)).find("side"), std::string::npos);
  EXPECT_NE(refusal(changed("fixtures", "vice.step")).find("fixtures: "), std::string::npos);
  EXPECT_NE(refusal(changed("schema", "openflank/path/1")).find("openflank/job/1"), std::string::npos);
  EXPECT_NE(refusal(changed("command", "polish")).find("fit, cover or trochoid"), std::string::npos);
  EXPECT_NE(refusal("{\"schema\": ").find("not a job file"), std::string::npos);
  EXPECT_NE(refusal("[]").find("schema"), std::string::npos);
}

// No text makes it do anything but read or refuse.
TEST(JobFile, RefusesDamagedFiles) {
  Random random(17);
  const std::string whole = job_to_json(jobs::random_job<FitJob>(random, 0.0));
  for (std::size_t length = 0; length + 2 < whole.size(); length += 3)
    EXPECT_NE(refusal(whole.substr(0, length)), "accepted") << length;
  for (int k = 0; k < 500; ++k) {
    std::string text = whole;
    text[static_cast<std::size_t>(random.uniform() * 0.999 * static_cast<double>(text.size()))] =
        "\"{}[]:,0-e.x"[static_cast<std::size_t>(random.uniform() * 11.99)];
    (void)refusal(text);
  }
}

}  // namespace
}  // namespace flank::internal
