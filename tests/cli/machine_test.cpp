// machine, post and verify --nc: from a result to a program and its verdict, and what is refused.
#include <fstream>

#include "cli/cli_fixture.h"

namespace flank::cli {
namespace {

using nlohmann::json;

std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(Cli, ListsAndShowsMachines) {
  const Outcome list = flank({"machine", "--list"});
  EXPECT_EQ(list.exit_code, 0);
  for (const char* name : {"linuxcnc-xyzac-trt", "fanuc-ac", "siemens-ac", "heidenhain-ac", "joint-ac"})
    EXPECT_NE(list.out.find(name), std::string::npos) << name;
  const json listed = json::parse(flank({"machine", "--list", "--json"}).out);
  for (const json& machine : listed.at("machines")) {
    const Outcome shown = flank({"machine", machine.at("name").get<std::string>(), "--json"});
    EXPECT_EQ(shown.exit_code, 0) << shown.err;
    EXPECT_EQ(json::parse(shown.out).at("joints").size(), 5u);
  }
  expect_refused({"machine"}, 2, "--list");
  expect_refused({"machine", "lathe"}, 3, "fanuc-ac");
  write_file(root_ / "bad.toml", "schema = \"openflank/machine/1\"\nname = 3\n");
  expect_refused({"machine", path("bad.toml")}, 3, "bad.toml: line 2, column 8: name");
}

class CliProgram : public Cli {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "needs a whole fit, which takes minutes under a sanitizer";
    Cli::SetUp();
  }
  static void TearDownTestSuite() { fs::remove_all(kept()); }
  /// The fit is that of all these tests: the first makes it, the others take a copy, with its part.
  void make_result() const {
    if (fs::exists(kept())) {
      fs::copy(kept(), root_, fs::copy_options::recursive);
      return;
    }
    const Outcome fit =
        flank({"fit", make_blade(), "--face", "F1", "--side", "+", "--tolerance", "0.1", "--quiet", "-o", path("fit")});
    ASSERT_EQ(fit.exit_code, 0) << fit.err;
    fs::create_directories(kept());
    fs::copy(path("fit"), kept() / "fit");
    fs::copy(path("blade.step"), kept());
  }
  [[nodiscard]] static fs::path kept() {
    return fs::path(::testing::TempDir()) / ("flank_cli_" + std::to_string(::getpid()) + "_program");
  }
  [[nodiscard]] std::vector<std::string> post(const std::string& machine) const {
    return {"post", path("fit"), "--machine", machine, "--spindle",
            "8000", "--feed",    "1000",      "-o",    path(machine + ".nc")};
  }
  [[nodiscard]] std::vector<std::string> verify(const std::string& machine) const {
    return {"verify", path("fit"), "--nc", path(machine + ".nc"), "--machine", machine};
  }
};

// The verdict of what a machine does is that of the path, on every machine that is shipped.
TEST_F(CliProgram, PostsAndJudgesForEveryMachine) {
  make_result();
  const json planned = json::parse(read_file(root_ / "fit/verify.json"));
  const std::string before = read_file(root_ / "fit/verify.json");
  for (const char* machine : {"linuxcnc-xyzac-trt", "linuxcnc-xyzbc-trt", "fanuc-ac", "siemens-ac", "heidenhain-ac",
                              "joint-ac", "joint-bc", "fanuc-head-table-bc", "heidenhain-head-head-ca"}) {
    SCOPED_TRACE(machine);
    const Outcome posted = flank(joined(post(machine), {"--json"}));
    ASSERT_EQ(posted.exit_code, 0) << posted.err << posted.out;
    const json told = json::parse(posted.out);
    EXPECT_LE(told.at("deviation_mm").get<double>(), 0.005 * 0.1);
    const Outcome judged = flank(joined(verify(machine), {"--json"}));
    EXPECT_EQ(judged.exit_code, 0) << judged.err << judged.out;
    const json verdict = json::parse(judged.out);
    // Links cut nothing: the figures are the path's, but for the deviation.
    EXPECT_NEAR(verdict.at("overcut_mm").get<double>(), planned.at("overcut_mm").get<double>(), 0.002);
    EXPECT_NEAR(verdict.at("coverage").get<double>(), planned.at("coverage").get<double>(), 0.002);
  }
  EXPECT_EQ(read_file(root_ / "fit/verify.json"), before) << "a program's verdict is not the folder's";
}

TEST_F(CliProgram, JudgesAProgramWithoutItsFolder) {
  make_result();
  ASSERT_EQ(flank(post("fanuc-ac")).exit_code, 0);
  const std::vector<std::string> alone = {
      "verify",           "--nc",   path("fanuc-ac.nc"),   "--machine",   "fanuc-ac", "--part",
      path("blade.step"), "--tool", path("fit/tool.json"), "--tolerance", "0.1"};
  EXPECT_EQ(flank(alone).exit_code, 0);
  expect_refused({"verify", "--nc", path("fanuc-ac.nc"), "--machine", "fanuc-ac"}, 2, "--part");
  expect_refused({"verify", path("fit"), "--nc", path("fanuc-ac.nc")}, 2, "--machine");
  expect_refused({"verify"}, 2, "DIR");
  // Another control's program, and one for joints.
  expect_refused({"verify", path("fit"), "--nc", path("fanuc-ac.nc"), "--machine", "heidenhain-ac"}, 3, "fanuc");
  expect_refused({"verify", path("fit"), "--nc", path("none.nc"), "--machine", "fanuc-ac"}, 3, "none.nc");
}

TEST_F(CliProgram, NamesLineAndAxisOfALimit) {
  make_result();
  ASSERT_EQ(flank(post("fanuc-ac")).exit_code, 0);
  std::string small = read_file(fs::path(FLANK_SOURCE_DIR) / "share/machines/fanuc-ac.toml");
  const std::size_t at = small.find("travel_mm = [-400.0, 400.0]");
  ASSERT_NE(at, std::string::npos);
  small.replace(at, 27, "travel_mm = [-0.01, 0.01]");
  write_file(root_ / "small.toml", small);
  const Outcome judged =
      flank({"verify", path("fit"), "--nc", path("fanuc-ac.nc"), "--machine", path("small.toml"), "--json"});
  EXPECT_EQ(judged.exit_code, 1) << judged.err;
  EXPECT_NE(judged.out.find("axis X would stand at"), std::string::npos) << judged.out;
  EXPECT_NE(judged.out.find("fanuc-ac.nc: line "), std::string::npos) << judged.out;
  const std::vector<std::string> far = joined(post("fanuc-ac"), {"--setup", "9000,0,0,0,0,0"});
  expect_refused(far, 3, "axis X would stand at");
  expect_refused(joined(post("fanuc-ac"), {"--setup", "9000,0"}), 2, "--setup");
  expect_refused({"post", path("fit"), "--machine", "lathe", "--dry", "-o", path("x.nc")}, 3, "--machine");
  expect_refused({"post", path("fit"), "--machine", "fanuc-ac", "--dry", "-o", path("fit/path.json")}, 3, "path.json");
}

// Outlines in the machine's file: what comes too near is named, by the post and by the judge of the program.
TEST_F(CliProgram, NamesWhatMeetsTheTable) {
  make_result();
  const Outcome good = flank(joined(post("fanuc-ac"), {"--json"}));
  ASSERT_EQ(good.exit_code, 0) << good.err << good.out;
  const std::string setup = json::parse(good.out).at("setup").get<std::string>();
  // A post beside the part, so high that the spindle must meet it.
  std::string blocked = read_file(fs::path(FLANK_SOURCE_DIR) / "share/machines/fanuc-ac.toml");
  blocked.replace(blocked.find("cylinder_mm"), blocked.find("radius_mm") - blocked.find("cylinder_mm"),
                  "cylinder_mm = [0.0, 0.0, -70.0, 0.0, 0.0, 400.0]\n");
  write_file(root_ / "blocked.toml", blocked);
  const Outcome posted = flank({"post", path("fit"), "--machine", path("blocked.toml"), "--setup", setup, "--dry", "-o",
                                path("blocked.nc"), "--json"});
  EXPECT_EQ(posted.exit_code, 1) << posted.err;
  EXPECT_FALSE(fs::exists(root_ / "blocked.nc")) << "a program that meets the table is left for somebody to run";
  EXPECT_NE(posted.out.find("the tool and table come within"), std::string::npos) << posted.out;
  const Outcome judged =
      flank({"verify", path("fit"), "--nc", path("fanuc-ac.nc"), "--machine", path("blocked.toml"), "--json"});
  EXPECT_EQ(judged.exit_code, 1) << judged.err;
  EXPECT_NE(judged.out.find("fanuc-ac.nc: line "), std::string::npos) << judged.out;
  EXPECT_NE(judged.out.find("machine_bodies"), std::string::npos) << judged.out;
}

// A spindle that stands still is asked for, and said.
TEST_F(CliProgram, NeedsSpindleAndFeedOrADryRun) {
  make_result();
  const std::vector<std::string> bare = {"post", path("fit"), "--machine", "fanuc-ac", "-o", path("bare.nc")};
  expect_refused(bare, 2, "--spindle, 1/min, and --feed, or --dry");
  expect_refused(joined(bare, {"--spindle", "8000"}), 2, "--feed");
  expect_refused(joined(bare, {"--feed", "1000"}), 2, "--spindle");
  expect_refused(joined(bare, {"--material", "titanium"}), 2, "--flutes");
  expect_refused(joined(bare, {"--flutes", "4"}), 2, "--material");
  expect_refused(joined(bare, {"--material", "cheese", "--flutes", "4"}), 2, "aluminium");
  expect_refused(joined(bare, {"--spindle", "0", "--feed", "1000"}), 2, "--spindle");
  expect_refused(joined(bare, {"--dry", "--spindle", "8000"}), 2, "--dry");
  EXPECT_FALSE(fs::exists(root_ / "bare.nc"));
  ASSERT_EQ(flank(joined(bare, {"--dry"})).exit_code, 0);
  const std::string dry = read_file(root_ / "bare.nc");
  EXPECT_NE(dry.find("(DRY RUN: THE SPINDLE STANDS STILL)"), std::string::npos) << dry.substr(0, 600);
  EXPECT_EQ(dry.find("M3\n"), std::string::npos);
  ASSERT_EQ(flank(joined(bare, {"--spindle", "8000", "--speed", "optimal"})).exit_code, 0);
  const std::string cuts = read_file(root_ / "bare.nc");
  EXPECT_NE(cuts.find("S8000 M3"), std::string::npos);
  EXPECT_EQ(cuts.find("DRY RUN"), std::string::npos);
}

// What a program's digits add counts: such a program is not written, and one that is forced says so. That it is told for every
// machine is tests/machine's.
TEST_F(CliProgram, DigitsThatAreTooFewAreNoProgram) {
  make_result();
  std::string coarse = read_file(fs::path(FLANK_SOURCE_DIR) / "share/machines/fanuc-ac.toml");
  const std::string digits = "length_decimals = 4";
  ASSERT_NE(coarse.find(digits), std::string::npos);
  coarse.replace(coarse.find(digits), digits.size(), "length_decimals = 0");
  write_file(root_ / "coarse.toml", coarse);
  std::vector<std::string> post = this->post("fanuc-ac");
  post[3] = path("coarse.toml");
  const Outcome refused = flank(joined(post, {"--json"}));
  EXPECT_EQ(refused.exit_code, 1) << refused.err;
  EXPECT_EQ(json::parse(refused.out).at("reasons").at(0).at("figure"), "rounding_mm") << refused.out;
  EXPECT_FALSE(fs::exists(root_ / "fanuc-ac.nc"));
  const Outcome forced = flank(joined(post, {"--force"}));
  EXPECT_EQ(forced.exit_code, 1) << forced.err;
  const std::string text = read_file(root_ / "fanuc-ac.nc");
  EXPECT_NE(text.find("DOES NOT MEET ITS REQUEST: "), std::string::npos) << text.substr(0, 800);
}

TEST_F(CliProgram, IsTheSameForAnyNumberOfThreads) {
  make_result();
  ASSERT_EQ(flank(joined(post("siemens-ac"), {"--threads", "1"})).exit_code, 0);
  const std::string one = read_file(root_ / "siemens-ac.nc");
  ASSERT_EQ(flank(joined(post("siemens-ac"), {"--threads", "2"})).exit_code, 0);
  EXPECT_EQ(read_file(root_ / "siemens-ac.nc"), one);
}

TEST_F(CliProgram, AsFastAsTheAxesCanIsFaster) {
  make_result();
  const json steady = json::parse(flank(joined(post("fanuc-ac"), {"--json"})).out);
  const json fast = json::parse(flank(joined(post("fanuc-ac"), {"--json", "--speed", "optimal"})).out);
  EXPECT_LT(fast.at("cutting_minutes").get<double>(), steady.at("cutting_minutes").get<double>());
}

}  // namespace
}  // namespace flank::cli
