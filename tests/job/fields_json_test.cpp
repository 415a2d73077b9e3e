// The table of fields as a form is made of it.
#include "flank/job/fields_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "flank/error.h"
#include "flank/job.h"

namespace flank::internal {
namespace {

using Json = nlohmann::json;

TEST(FieldsJson, HasEveryFieldOfTheTable) {
  for (const char* command : {"fit", "cover", "trochoid", "verify", "post", "design", "wheel"}) {
    const Json json = Json::parse(fields_json(command));
    const std::vector<JobField> fields = job_fields(command);
    ASSERT_EQ(json.at("fields").size(), fields.size()) << command;
    for (std::size_t k = 0; k < fields.size(); ++k) {
      EXPECT_EQ(json.at("fields")[k].at("name"), fields[k].name);
      EXPECT_EQ(json.at("fields")[k].at("option"), fields[k].option);
      EXPECT_EQ(json.at("fields")[k].at("help"), fields[k].help);
    }
  }
  EXPECT_THROW((void)fields_json("inspect"), UsageError);
}

TEST(FieldsJson, BasicFieldsAreThere) {
  for (const char* command : {"fit", "cover", "trochoid", "verify", "post", "design", "wheel"}) {
    std::size_t basic = 0;
    const Json all = Json::parse(fields_json(command));
    for (const Json& field : all.at("fields")) basic += field.at("basic").get<bool>() ? 1 : 0;
    EXPECT_EQ(basic, basic_fields(command).size()) << command << " has not all that its form begins with";
  }
  for (const char* command : {"fit", "cover", "trochoid", "post", "wheel"})
    EXPECT_EQ(basic_fields(command).size(), 8u) << command;
}

TEST(FieldsJson, SaysWhatAFormMustKnow) {
  const Json all = Json::parse(fields_json("fit"));
  const auto field = [&](const std::string& name) {
    for (const Json& one : all.at("fields"))
      if (one.at("name") == name) return one;
    return Json();
  };
  EXPECT_EQ(field("part").at("file"), true);
  EXPECT_EQ(field("part").at("needed"), true);
  EXPECT_EQ(field("tool").at("file"), "or text");
  EXPECT_EQ(field("tool").at("default"), "free");
  EXPECT_EQ(field("tolerance_mm").at("unit"), "mm");
  EXPECT_EQ(field("tolerance_mm").at("default"), nullptr);
  EXPECT_EQ(field("side").at("kind"), "sign");
  EXPECT_EQ(field("effort").at("choices"), Json({"quick", "normal", "thorough"}));
}

TEST(FieldsJson, ChoicesAreReadFromTheSentence) {
  EXPECT_EQ(choices_of("must be tapered or any"), (std::vector<std::string>{"tapered", "any"}));
  EXPECT_EQ(choices_of("expected a length > 0 mm"), std::vector<std::string>{});
  EXPECT_EQ(choices_of(""), std::vector<std::string>{});
}

}  // namespace
}  // namespace flank::internal
