#include "flank/io/path/engagement_json.h"

#include <gtest/gtest.h>

#include "flank/error.h"

namespace flank::internal {
namespace {

Path two_strips() {
  const Pose pose{Vec3::Zero(), Vec3::UnitZ()};
  Path path;
  path.strips.push_back({1, "front", "F1", {pose, pose}});
  path.strips.push_back({2, "back", "F1", {pose}});
  return path;
}

TEST(EngagementJson, ReadsBackWhatItWroteToAHundredthOfADegree) {
  const PathEngagement written{{0.0, 1.0471975511965976}, {0.5}};
  const PathEngagement read = engagement_from_json(engagement_to_json(written), "engagement.json", two_strips());
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0][0], 0.0);
  EXPECT_NEAR(read[0][1], written[0][1], 1e-4);
  EXPECT_NEAR(read[1][0], 0.5, 1e-4);
  EXPECT_EQ(engagement_to_json(read), engagement_to_json(written));
}

TEST(EngagementJson, ReadsArcsBackToATenthOfADegree) {
  const PathArcs written{{0.0, 5.0, 10.0},
                         {{{}, {{0, -0.5, 0.25}, {2, -1.0, -0.9}, {2, 0.1, 1.2}}}, {{{1, 0.0, 0.7}}}}};
  const std::string text = engagement_to_json({{0.0, 1.1}, {0.7}}, written);
  const PathArcs read = arcs_from_json(text, "engagement.json", two_strips());
  EXPECT_EQ(read.heights, written.heights);
  ASSERT_EQ(read.strips.size(), 2u);
  ASSERT_EQ(read.strips[0][1].size(), 3u);
  EXPECT_EQ(read.strips[0][1][1].ring, 2);
  EXPECT_NEAR(read.strips[0][1][2].to, 1.2, 1e-3);
  EXPECT_EQ(engagement_to_json(engagement_from_json(text, "engagement.json", two_strips()), read), text);
  EXPECT_TRUE(arcs_from_json(engagement_to_json({{0.0, 1.1}, {0.7}}), "", two_strips()).heights.empty());
}

TEST(EngagementJson, RefusesArcsOfRingsThatAreNone) {
  const auto refused = [](const std::string& arcs) {
    try {
      (void)arcs_from_json(R"({"schema": "openflank/engagement/1", "units": "degrees", "strips": [[1, 2], [3]],
                               "heights": [0, 5], "arcs": )" +
                               arcs + "}",
                           "engagement.json", two_strips());
    } catch (const InputError&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(refused("[[[], [0, -5, 5, 1, 3, 4]], [[]]]"));
  for (const char* arcs : {"[[[], [2, -5, 5]], [[]]]", "[[[], [0.5, -5, 5]], [[]]]", "[[[], [0, 5, -5]], [[]]]",
                           "[[[], [1, 0, 1, 0, 0, 1]], [[]]]", "[[[], [0, 1]], [[]]]", "[[[]], [[]]]", "[[[], []]]"})
    EXPECT_TRUE(refused(arcs)) << arcs;
}

TEST(EngagementJson, RefusesWithThePlace) {
  const auto message = [](const std::string& strips) -> std::string {
    try {
      (void)engagement_from_json(
          R"({"schema": "openflank/engagement/1", "units": "degrees", "strips": )" + strips + "}", "engagement.json",
          two_strips());
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message("[[1, 2]]").find("strips"), std::string::npos);
  EXPECT_NE(message("[[1, 2], [3, 4]]").find("strips[1]"), std::string::npos);
  EXPECT_NE(message("[[1, -2], [3]]").find("strips[0][1]"), std::string::npos) << message("[[1, -2], [3]]");
  EXPECT_EQ(message("[[1, 2], [3]]"), "");
}

}  // namespace
}  // namespace flank::internal
