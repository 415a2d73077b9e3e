#include "flank/path_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "flank/error.h"
#include "flank/io/path/path_csv.h"
#include "io/path/path_samples.h"

namespace flank::internal {
namespace {

template <class Read>
std::string refusal(const std::string& text, Read read) {
  try {
    (void)read(text, "p.file");
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(PathJson, ReadsBackExactly) {
  const Path path = awkward_path();
  EXPECT_TRUE(same(path_from_json(path_to_json(path), "p.json"), path));
  EXPECT_TRUE(same(path_from_json(path_to_json(Path{}), "p.json"), Path{}));
}

TEST(PathJson, IsValidJsonOfTheDocumentedForm) {
  const nlohmann::json j = nlohmann::json::parse(path_to_json(awkward_path()));
  EXPECT_EQ(j.at("schema"), "openflank/path/1");
  EXPECT_EQ(j.at("units"), "mm");
  ASSERT_EQ(j.at("strips").size(), 3u);
  EXPECT_EQ(j.at("strips").at(1).at("id"), 7);
  EXPECT_EQ(j.at("strips").at(0).at("poses").at(3), nlohmann::json({-0.0, 1.0 / 3.0, 2.0, 0.0, 0.0, 1.0}));
}

TEST(PathJson, LayersAreWrittenWhereThereAreAny) {
  Path path = awkward_path();
  EXPECT_EQ(path_to_json(path).find("layer"), std::string::npos);
  path.strips[1].layer = 3;
  const Path read = path_from_json(path_to_json(path), "p.json");
  EXPECT_EQ(read.strips[0].layer, 0);
  EXPECT_EQ(read.strips[1].layer, 3);
}

TEST(PathJson, RoundedAxesAreNormalised) {
  const Path path = path_from_json(
      R"({"schema":"openflank/path/1","strips":[{"id":1,"poses":[[0,0,0,0.7071,0,0.7071]]}]})", "p.json");
  EXPECT_NEAR(path.strips[0].poses[0].axis.norm(), 1.0, 1e-15);
  EXPECT_EQ(path.strips[0].kind, "flank");
}

TEST(PathJson, BadFilesAreRefusedByName) {
  const std::string head = R"({"schema":"openflank/path/1","strips":)";
  const std::vector<std::pair<std::string, std::string>> corpus = {
      {"", "not valid JSON"},
      {R"({"schema":"openflank/tool/1"})", "accepted: \"openflank/path/1\""},
      {R"({"schema":"openflank/path/1"})", "\"strips\" is missing"},
      {R"({"schema":"openflank/path/1","strips":[],"unit":"mm"})", "unknown key \"unit\""},
      {head + "{}}", "strips: must be an array"},
      {head + "[3]}", "strips[0]: must be an object"},
      {head + R"([{"id":1,"poses":[[1,2,3,0,0,1]]},[3]]})", "strips: every strip must be an object"},
      {R"({"strips":[{"id":1.5}],"schema":"openflank/tool/1"})", "accepted: \"openflank/path/1\""},
      {head + R"([{"id":1,"id":2,"poses":[[1,2,3,0,0,1]]}]})", "key \"id\" occurs twice"},
      {head + R"([{"poses":[]}]})", "strips[0]: \"id\" is missing"},
      {head + R"([{"id":1.5,"poses":[]}]})", "strips[0].id: must be a whole number"},
      {head + R"([{"id":1,"poses":[]}]})", "strips[0].poses: expected at least one"},
      {head + R"([{"id":1,"poses":[[1,2,3]]}]})", "strips[0].poses[0]: has 3 entries; must have 6"},
      {head + R"([{"id":1,"poses":[[1,2,3,0,0,1],[1,2,"x",0,0,1]]}]})", "strips[0].poses[1][2]"},
      {head + R"([{"id":1,"poses":[[1,2,3,0,0,2]]}]})", "strips[0].poses[0]: the axis vector"},
      {head + R"([{"id":1,"poses":[[1,2,3,0,0,0]]}]})", "has length 0"},
      {head + R"([{"id":1,"kind":2,"poses":[[1,2,3,0,0,1]]}]})", "strips[0].kind: must be a text"},
      {head + R"([{"id":1,"layer":0,"poses":[[1,2,3,0,0,1]]}]})", "strips[0].layer: must be 1 or more"},
      {head + R"([{"id":1,"layer":-1,"poses":[[1,2,3,0,0,1]]}]})", "strips[0].layer: must be 1 or more"},
      {head + R"([{"id":1,"pose":[]}]})", "unknown key \"pose\""},
      {head + R"([{"id":1,"poses":[[1,2,3,0,0,1]]},{"id":1,"poses":[[1,2,3,0,0,1]]}]})", "id 1 is used twice"}};
  for (const auto& [text, expected] : corpus) {
    const std::string message = refusal(text, path_from_json);
    EXPECT_EQ(message.rfind("p.file: ", 0), 0u) << message;
    EXPECT_NE(message.find(expected), std::string::npos) << message << "\n for " << text;
  }
}

TEST(PathCsv, ReadsBackExactly) {
  Path path = awkward_path();
  path.strips[1].kind = "with \"quotes\"\nand lines";
  EXPECT_TRUE(same(path_from_csv(path_to_csv(path), "p.csv"), path));
}

TEST(PathCsv, BadTablesAreRefusedByLine) {
  const std::string head = "strip,kind,face,x,y,z,i,j,k\n";
  const std::vector<std::pair<std::string, std::string>> corpus = {
      {"", "must be \"strip,kind"},
      {"x,y,z\n", "line 1"},
      {head + "1,flank,F1,0,0,0,0,0\n", "line 2: has 8 columns"},
      {head + "1,flank,F1,0,0,0,0,0,1\n1,flank,F1,0,0,zero,0,0,1\n", "line 3: \"zero\" is not a finite number"},
      {head + "1,flank,F1,0,0,nan,0,0,1\n", "not a finite number"},
      {head + "1.5,flank,F1,0,0,0,0,0,1\n", "whole number"},
      {head + "1,flank,F1,0,0,0,0,0,1.5\n", "length 1.5"},
      {head + "1,\"flank,F1,0,0,0,0,0,1\n", "quote is not closed"},
      {head + "1,a,F1,0,0,0,0,0,1\n2,a,F1,0,0,0,0,0,1\n1,a,F1,0,0,0,0,0,1\n",
       "line 4: pass 1 continues after another one"}};
  for (const auto& [text, expected] : corpus) {
    const std::string message = refusal(text, path_from_csv);
    EXPECT_EQ(message.rfind("p.file: ", 0), 0u) << message;
    EXPECT_NE(message.find(expected), std::string::npos) << message << "\n for " << text;
  }
}

}  // namespace
}  // namespace flank::internal
