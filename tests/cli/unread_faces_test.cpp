// A face that is in the file and cannot be read: no command passes as long as nobody says that it may be entered.
#include "cli/cli_fixture.h"

namespace flank::cli {
namespace {

/// The cavity's two walls; of the second one the file has no surface.
std::string without_second_wall(const std::string& file) {
  std::string text = read_file(file);
  const std::size_t face = text.find("ADVANCED_FACE", text.find("ADVANCED_FACE") + 1);
  const std::size_t border = text.find('#', face), list = text.find("),#", face) + 2;
  const auto reference = [&](std::size_t at) {
    return text.substr(at, text.find_first_not_of("0123456789", at + 1) - at);
  };
  return text.replace(list, reference(list).size(), reference(border));
}

TEST_F(Cli, AFaceThatCannotBeReadIsAReasonUnlessItIsIgnored) {
  if (kSanitized) GTEST_SKIP() << "whole searches take minutes";
  const std::string part = path("cavity.step"), out = path("out");
  ASSERT_EQ(flank({"example", "cavity", "-o", part}).exit_code, 0);
  ASSERT_EQ(flank({"fit", part, "--face", "F1", "--tolerance", "0.5", "--quiet", "-o", out}).exit_code, 0);
  const std::string damaged = path("damaged.step");
  std::ofstream(damaged) << without_second_wall(part);
  const Outcome listed = flank({"inspect", damaged});
  EXPECT_EQ(listed.exit_code, 0);
  EXPECT_NE(listed.out.find("F2    not read"), std::string::npos) << listed.out;
  const Outcome judged = flank({"verify", out, "--part", damaged});
  EXPECT_EQ(judged.exit_code, 1);
  EXPECT_NE(judged.out.find("F2 is not checked"), std::string::npos) << judged.out;
  const auto verdict = nlohmann::json::parse(read_file(out + "/verify.json"));
  EXPECT_FALSE(verdict.at("pass").get<bool>());
  EXPECT_EQ(verdict.at("reasons")[0].at("figure"), "unread_faces");
  EXPECT_EQ(verdict.at("unread_faces")[0].at("face"), "F2");
  EXPECT_EQ(flank({"fit", damaged, "--face", "F2", "--tolerance", "0.5", "-o", path("none")}).exit_code, 3);
  // The job of the folder is not about it when its own words say so.
  auto job = nlohmann::json::parse(read_file(out + "/job.json"));
  job["ignore_faces"] = "F2";
  fs::remove(out + "/manifest.json");
  std::ofstream(out + "/job.json") << job.dump();
  EXPECT_EQ(flank({"verify", out, "--part", damaged}).exit_code, 0);
}

}  // namespace
}  // namespace flank::cli
