#include "flank/tool_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "flank/base/random.h"
#include "flank/error.h"

namespace flank::internal {
namespace {

std::string refusal(const std::string& text) {
  try {
    (void)tool_from_json(text, "t.json");
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

Tool odd_tool(ToolFamily family, std::initializer_list<double> list) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(list.size()));
  int i = 0;
  for (const double x : list) v[i++] = x;
  Tool tool;
  tool.radial = RadialFunction(family, 20.0 + 1.0 / 3.0, v);
  tool.name = "a \"quoted\" name, \xc3\xa4\n";
  tool.shank = {{20.5, 4.0 / 7.0}, {41.0 / 3.0 + 20.0, 6.0}};
  tool.holder = {{40.0, 10.0}, {60.0, 10.1}};
  return tool;
}

void expect_same(const Tool& a, const Tool& b) {
  EXPECT_EQ(a.radial.family(), b.radial.family());
  EXPECT_EQ(a.radial.axis_length(), b.radial.axis_length());
  ASSERT_EQ(a.radial.parameter_count(), b.radial.parameter_count());
  for (int k = 0; k < a.radial.parameter_count(); ++k) EXPECT_EQ(a.radial.parameters()[k], b.radial.parameters()[k]);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.shank, b.shank);
  EXPECT_EQ(a.holder, b.holder);
}

TEST(ToolJson, EveryFamilyReadsBackExactly) {
  const double third = 1.0 / 3.0;
  for (const Tool& tool :
       {odd_tool(ToolFamily::kCylinder, {4 + third}), odd_tool(ToolFamily::kCone, {2 + third, 0.1 * third}),
        odd_tool(ToolFamily::kBarrel, {85 + third, 5 + third, 7 * third}),
        odd_tool(ToolFamily::kLens, {5 + third, 5 - third}),
        odd_tool(ToolFamily::kTaperedBarrel, {250 + third, 5 + third, 0.2 * third}),
        odd_tool(ToolFamily::kHyperbolic, {3 + third, 0.02 * third, 0.004 * third}),
        odd_tool(ToolFamily::kPower, {8 + third, 1.5, 1 + third, 2.3}),
        odd_tool(ToolFamily::kSpline, {3, 3 + third, 3.9, 4.2, 4 + third, 4.1})})
    expect_same(tool_from_json(tool_to_json(tool), "t.json"), tool);
}

TEST(ToolJson, IsValidJsonOfTheDocumentedForm) {
  const nlohmann::json j = nlohmann::json::parse(tool_to_json(odd_tool(ToolFamily::kCone, {2, 0.05})));
  EXPECT_EQ(j.at("schema"), "openflank/tool/1");
  EXPECT_EQ(j.at("units"), "mm");
  EXPECT_EQ(j.at("family"), "cone");
  EXPECT_EQ(j.at("parameters").at("radius"), 2.0);
  EXPECT_EQ(j.at("parameters").at("angle_rad"), 0.05);
  ASSERT_EQ(j.at("samples").size(), 201u);
  EXPECT_EQ(j.at("samples").back().at(0), 20.0 + 1.0 / 3.0);
  EXPECT_EQ(j.at("holder").size(), 2u);
}

TEST(ToolJson, ManyCoefficientsGetManySamples) {
  Tool tool;
  tool.radial = RadialFunction::spline(50.0, Eigen::VectorXd::Constant(203, 5.0));
  EXPECT_EQ(nlohmann::json::parse(tool_to_json(tool)).at("samples").size(), 801u);
}

/// What another program would do: keep the samples, drop what it does not understand.
TEST(ToolJson, SamplesAloneSuffice) {
  for (const Tool& tool : {odd_tool(ToolFamily::kCylinder, {4}), odd_tool(ToolFamily::kCone, {2, 0.03}),
                           odd_tool(ToolFamily::kBarrel, {85, 5, 7}), odd_tool(ToolFamily::kBarrel, {40, 8, 3}),
                           odd_tool(ToolFamily::kHyperbolic, {3, 0.02, 0.004}),
                           odd_tool(ToolFamily::kSpline, {3, 3.4, 3.9, 4.2, 4.4, 4.1, 4.2, 4.0, 4.4, 4.8, 5.0})}) {
    nlohmann::json j = nlohmann::json::parse(tool_to_json(tool));
    j.erase("parameters");
    j.erase("family");
    const Tool read = tool_from_json(j.dump(), "t.json");
    EXPECT_EQ(read.radial.family(), ToolFamily::kSpline);
    for (int i = 0; i <= 1000; ++i) {
      const double s = tool.radial.axis_length() * i / 1000;
      EXPECT_NEAR(read.radial.at(s).r, tool.radial.at(s).r, 2e-9);
      EXPECT_NEAR(read.radial.at(s).d1, tool.radial.at(s).d1, 1e-7);
    }
  }
}

/// Samples rounded to micrometres must not turn the meridian to noise.
TEST(ToolJson, RoundedSamplesGiveASmoothTool) {
  const Tool tool = odd_tool(ToolFamily::kBarrel, {85, 5, 7});
  nlohmann::json j = nlohmann::json::parse(tool_to_json(tool));
  j.erase("parameters");
  for (auto& sample : j["samples"]) sample[1] = std::round(sample[1].get<double>() * 1000.0) / 1000.0;
  const Tool read = tool_from_json(j.dump(), "t.json");
  EXPECT_TRUE(check_legitimacy(read.radial).legitimate);
  for (double s = 0.0; s <= tool.radial.axis_length(); s += 0.1)
    EXPECT_NEAR(read.radial.at(s).r, tool.radial.at(s).r, kToolSplineErrorMm);
}

TEST(ToolJson, ShankByDiameterStandsOnTheFlank) {
  const Tool tool = tool_from_json(
      R"({"schema":"openflank/tool/1","axis_length":20,"family":"cylinder","parameters":{"radius":4},
          "shank":{"diameter":8,"length":30}})",
      "t.json");
  ASSERT_EQ(tool.shank.size(), 2u);
  EXPECT_EQ(tool.shank[0], Vec2(20, 4));
  EXPECT_EQ(tool.shank[1], Vec2(50, 4));
}

struct Bad {
  const char* text;
  const char* expected;
};

/// Every line of this corpus is refused with a message that names the file and the key.
TEST(ToolJson, BadFilesAreRefusedByName) {
  const std::vector<Bad> corpus = {
      {"", "not valid JSON"},
      {"tool", "not valid JSON"},
      {"{\"schema\": ", "line 1"},
      {"[]", "must be a JSON object"},
      {"null", "must be a JSON object"},
      {"{}", "no \"schema\""},
      {R"({"schema":7})", "schema: must be a text"},
      {R"({"schema":"openflank/path/1"})", "openflank/tool/1"},
      {R"({"schema":"openflank/tool/2"})", "accepted: \"openflank/tool/1\""},
      {R"({"schema":"openflank/tool/1","units":"in"})", "units: is \"in\""},
      {R"({"schema":"openflank/tool/1"})", "\"axis_length\" is missing"},
      {R"({"schema":"openflank/tool/1","axis_length":"20"})", "axis_length: must be a number"},
      {R"({"schema":"openflank/tool/1","axis_length":-20})", "must be > 0"},
      {R"({"schema":"openflank/tool/1","axis_length":1e999})", "not valid JSON"},
      {R"({"schema":"openflank/tool/1","axis_length":NaN})", "not valid JSON"},
      {R"({"schema":"openflank/tool/1","axis_length":20})", "\"samples\" is missing"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"lenght":20})", "unknown key \"lenght\""},
      {R"({"schema":"openflank/tool/1","axis_length":20,"axis_length":30,"samples":[]})", "occurs twice"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"samples":[]})", "at least 4"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"samples":{"0":1}})", "samples: must be an array"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"samples":[[0,4],[5,4],[5,4],[20,4]]})", "samples[2]"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"samples":[[0,4],[5,4,1],[6,4],[20,4]]})", "samples[1]: has 3"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"samples":[[0,4],[5,null],[6,4],[20,4]]})", "samples[1][1]"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"samples":[[0,4],[5,-4],[6,4],[20,4]]})", "r is -4"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"samples":[[0,4],[5,4],[6,4],[19,4]]})", "must run from 0"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"samples":[[0,4],[5,4],[6,9],[20,4]]})", "samples"},
      {R"({"schema":"openflank/tool/1","axis_length":10,"samples":[[0,30],[3,20],[5,15],[10,1]]})", "|r'| < 1"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"parameters":{"radius":4}})", "\"family\" is missing"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"family":"ball","parameters":{"radius":4}})",
       "accepted: cylinder"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"family":"cone","parameters":{"radius":4}})",
       "\"angle_rad\" is missing"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"family":"cylinder","parameters":{"radius":4,"angle":3}})",
       "parameters: unknown key \"angle\""},
      {R"({"schema":"openflank/tool/1","axis_length":20,"family":"cylinder","parameters":{"radius":-4}})",
       "the radius must be positive"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"family":"barrel","parameters":{"arc":2,"radius":5,"s0":10}})",
       "1 - r'^2 - r r''"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"family":"spline","parameters":{"coefficients":[1,2,3]}})",
       "coefficients: has 3"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"family":"cylinder","parameters":{"radius":4},"samples":[[0,4],[5,4],[6,4],[20,5]]})",
       "samples: they are up to 1 mm"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"family":"cylinder","parameters":{"radius":4},"name":3})",
       "name: must be"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"family":"cylinder","parameters":{"radius":4},"holder":[[0,1]]})",
       "holder: expected at least two"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"family":"cylinder","parameters":{"radius":4},"holder":[[5,1],[4,1]]})",
       "holder[1]: z must not decrease"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"family":"cylinder","parameters":{"radius":4},"shank":[[5,1]]})",
       "shank: must be an object"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"family":"cylinder","parameters":{"radius":4},"shank":{"diameter":8}})",
       "\"length\" is missing"},
      {R"({"schema":"openflank/tool/1","axis_length":20,"family":"cylinder","parameters":{"radius":4},"shank":{"d":8}})",
       "shank: unknown key \"d\""}};
  for (const Bad& bad : corpus) {
    const std::string message = refusal(bad.text);
    EXPECT_EQ(message.rfind("t.json: ", 0), 0u) << message << "\n for " << bad.text;
    EXPECT_NE(message.find(bad.expected), std::string::npos) << message << "\n for " << bad.text;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  EXPECT_NE(refusal(std::string(100000, '[')).find("t.json"), std::string::npos);
  EXPECT_NE(refusal(std::string("{\"schema\":\"openflank/tool/1\"\0}", 30)).find("t.json"), std::string::npos);
}

/// Damaged bytes never get past as anything but a tool or a one-line refusal.
TEST(ToolJson, DamagedFilesNeverCrash) {
  const std::string good = tool_to_json(odd_tool(ToolFamily::kSpline, {3, 3.3, 3.9, 4.2, 4.4}));
  Random random(11);
  for (int round = 0; round < 300; ++round) {
    std::string text = good;
    for (int k = 0; k < 3; ++k) text[random.next() % text.size()] = static_cast<char>(random.next() % 256);
    if (round % 3 == 0) text.resize(random.next() % text.size());
    try {
      EXPECT_TRUE(check_legitimacy(tool_from_json(text, "t.json").radial).legitimate);
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()).rfind("t.json", 0), 0u);
    }
  }
}

TEST(ToolJson, MissingFilesAreNamed) {
  try {
    (void)read_tool("/no/such/tool.json");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("/no/such/tool.json: no such file"), std::string::npos);
  }
}

TEST(ToolJson, NumbersThatAreNotFiniteAreNotWritten) {
  Tool tool;
  tool.radial = RadialFunction::spline(20.0, Eigen::VectorXd::Constant(5, NAN));
  EXPECT_THROW((void)tool_to_json(tool), InternalError);
}

}  // namespace
}  // namespace flank::internal
