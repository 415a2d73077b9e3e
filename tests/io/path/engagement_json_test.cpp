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
