// What programs ask the command for: defaults, fields, progress and faces as JSON.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/cli_fixture.h"

namespace flank::cli {
namespace {

using Json = nlohmann::json;

class ForPrograms : public Cli {};

TEST_F(ForPrograms, ADryRunTellsTheDefaultsAndWritesNothing) {
  const std::string blade = make_blade();
  const Outcome dry = flank({"fit", blade, "--dry-run", "--json"});
  ASSERT_EQ(dry.exit_code, 0) << dry.err;
  const Json told = Json::parse(dry.out);
  EXPECT_EQ(told.at("faces"), "F1");
  EXPECT_GT(told.at("tolerance"), 0.0);
  EXPECT_LT(told.at("radius_min"), told.at("radius_max"));
  EXPECT_GT(told.at("reach_radius"), 0.0);
  ASSERT_EQ(told.at("sides").size(), 1u) << "the blade is a sheet";
  EXPECT_FALSE(fs::exists(path("out")));
  const Json given = Json::parse(flank({"fit", blade, "--dry-run", "--json", "--tolerance=0.1", "--side=-",
                                        "--reach-radius=2.5", "--radius-max=9"})
                                     .out);
  EXPECT_EQ(given.at("tolerance"), 0.1);
  EXPECT_EQ(given.at("reach_radius"), 2.5);
  EXPECT_EQ(given.at("radius_max"), 9.0);
  EXPECT_EQ(given.at("sides")[0].at("side"), "-");
  const Outcome text = flank({"fit", blade, "--dry-run"});
  EXPECT_NE(text.out.find("would machine  F1"), std::string::npos) << text.out;
}

TEST_F(ForPrograms, WithoutADryRunAFolderIsNeeded) {
  expect_refused({"fit", make_blade(), "--tolerance=0.1"}, 2, "--output is required");
}

TEST_F(ForPrograms, ProgressIsALineOfJsonEachTime) {
  const Outcome fit = flank(
      {"fit", make_cone(), "-o", path("out"), "--tolerance=0.05", "--effort=quick", "--progress=json", "--quiet"});
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  std::istringstream lines(fit.err);
  double share = 0.0;
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const Json told = Json::parse(line);
    EXPECT_GE(told.at("share"), share) << line;
    share = told.at("share");
    EXPECT_TRUE(told.at("stage").is_string() && told.contains("eta_s") && told.contains("best")) << line;
  }
  EXPECT_GT(count, 2);
  EXPECT_EQ(share, 1.0);
}

TEST_F(ForPrograms, FacesComeWithTheirTriangles) {
  const std::string blade = make_blade();
  ASSERT_EQ(flank({"inspect", blade, "--view", path("faces.json")}).exit_code, 0);
  const Json faces = Json::parse(read_file(path("faces.json")));
  EXPECT_EQ(faces.at("schema"), "openflank/faces/1");
  EXPECT_EQ(faces.at("file"), "blade.step") << "where it lay is nobody's business";
  EXPECT_EQ(faces.at("bodies").size(), faces.at("faces").size());
  EXPECT_EQ(faces.at("bodies")[0].at("face"), "F1");
  EXPECT_GT(faces.at("bodies")[0].at("triangles"), 10);
  const Json table = Json::parse(flank({"inspect", blade, "--json"}).out);
  EXPECT_EQ(faces.at("faces"), table.at("faces"));
}

TEST_F(ForPrograms, TheFieldsOfACommandArePrinted) {
  EXPECT_EQ(Json::parse(flank({"fields", "fit"}).out).at("schema"), "openflank/fields/1");
  expect_refused({"fields", "sweep"}, 2, "must be fit, cover");
}

}  // namespace
}  // namespace flank::cli
