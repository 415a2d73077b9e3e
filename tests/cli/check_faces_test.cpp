// Which other faces count, and what entering one means.
#include "cli/cli_fixture.h"
#include "shared_data.h"

namespace flank::cli {
namespace {

using nlohmann::json;

TEST_F(Cli, RefusesCheckFacesThatAreNone) {
  const std::vector<std::string> fit{"fit", make_blade(), "--face", "F1", "-o", path("out")};
  const auto refused = [&](std::vector<std::string> more, const std::string& what) {
    SCOPED_TRACE(what);
    std::vector<std::string> words = fit;
    words.insert(words.end(), more.begin(), more.end());
    expect_refused(words, 2, what);
  };
  refused({"--check-faces", "F7"}, "the part has one face, F1");
  refused({"--ignore-faces", "hub"}, "--ignore-faces hub");
  refused({"--check-faces", "F1"}, "F1 is machined");
  refused({"--ignore-faces", "F1"}, "F1 is machined");
  refused({"--avoid", "perhaps"}, "--avoid");
}

class CliCheckFaces : public Cli {
 protected:
  void SetUp() override {
    if (kSanitized)
      GTEST_SKIP() << "a whole fit takes minutes under a sanitizer; its parts are tested there one by one";
    Cli::SetUp();
  }
  [[nodiscard]] json file(const std::string& name) const { return json::parse(read_file(root_ / "out" / name)); }
};

// Without regard to the rest of the impeller the tool runs into it: F1 stands on the hub.
TEST_F(CliCheckFaces, EnteringAnotherFaceIsExitOneAndNamed) {
  FLANK_REAL_PART(part, "kj66_impeller.step");
  const Outcome fit = flank({"fit", part, "--face", "F1", "--tolerance", "0.05", "--avoid", "off", "-o", path("out")});
  EXPECT_EQ(fit.exit_code, 1) << fit.out << fit.err;
  const json whole = file("verify.json");
  EXPECT_FALSE(whole.at("pass"));
  EXPECT_EQ(whole.at("verdict"), "gouge");
  EXPECT_GT(whole.at("gouge_mm").get<double>(), 0.05);
  EXPECT_EQ(file("job.json").at("avoid"), false);
  EXPECT_EQ(file("summary.json").at("within"), false);
  std::string deepest;
  for (const json& f : whole.at("faces"))
    if (!f.at("target") && f.at("overcut_mm") == whole.at("gouge_mm")) deepest = f.at("face");
  const auto named = [&](const json& reason) {
    return reason.at("figure") == "gouge_mm" &&
           reason.at("text").get<std::string>().rfind(deepest + " is gouged by ", 0) == 0;
  };
  ASSERT_TRUE(std::any_of(whole.at("reasons").begin(), whole.at("reasons").end(), named)) << whole.at("reasons");
  EXPECT_NE(fit.out.find(deepest + " is gouged by "), std::string::npos) << fit.out;
  EXPECT_NE(fit.out.find("), pass 1"), std::string::npos) << fit.out;

  // The face entered alone: the same depth. A face that is not entered alone: pass, and it says what was left out.
  const Outcome alone = flank({"verify", path("out"), "--check-faces", deepest});
  EXPECT_EQ(alone.exit_code, 1);
  EXPECT_NE(alone.out.find(deepest + " is gouged by "), std::string::npos) << alone.out;
  EXPECT_EQ(file("verify.json").at("gouge_mm"), whole.at("gouge_mm"));
  EXPECT_EQ(file("verify.json").at("faces").size(), 2u);
  const Outcome elsewhere = flank({"verify", path("out"), "--check-faces", "F33"});
  EXPECT_EQ(elsewhere.exit_code, 0) << elsewhere.out;
  EXPECT_TRUE(file("verify.json").at("pass"));
  EXPECT_TRUE(file("verify.json").at("reasons").empty());
  EXPECT_NE(elsewhere.out.find("not checked"), std::string::npos) << elsewhere.out;
  ASSERT_EQ(flank({"verify", path("out"), "--ignore-faces", deepest}).exit_code, 1) << "the hub remains";
  const json remaining = file("verify.json");
  for (const json& f : remaining.at("faces")) EXPECT_NE(f.at("face"), deepest);
}

}  // namespace
}  // namespace flank::cli
