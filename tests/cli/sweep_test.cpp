// flank sweep: plans that are refused by their line, the same bytes for any number of processes, what is kept.
#include <sys/file.h>

#include <chrono>
#include <csignal>
#include <map>
#include <thread>

#include "cli/cli_fixture.h"

namespace flank::cli {
namespace {

class SweepCli : public Cli {
 protected:
  /// A plan beside its part.
  [[nodiscard]] std::string plan(const std::string& text) const {
    write_file(root_ / "plan.toml", text);
    return path("plan.toml");
  }
  [[nodiscard]] std::string good_plan(const std::string& more = "") const {
    (void)make_side();
    return plan(
        "schema = \"openflank/sweep-plan/1\"\ncommand = \"cover\"\npart = \"side.step\"\nfaces = [\"F1\"]\n"
        "tools = [\"cylinder:radius=6\", \"cylinder:radius=5\"]\n" +
        more + "[options]\ntolerance_mm = 2.5\nstrips = 1\naxis_length_mm = 45\nside = \"-\"\n");
  }
  /// Every file below a folder.
  [[nodiscard]] static std::map<std::string, std::string> files(const fs::path& folder) {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) all[entry.path().lexically_relative(folder).string()] = read_file(entry.path());
    return all;
  }
  /// Names of files that are not the same in both; the files themselves are too long to be shown.
  [[nodiscard]] static std::string different(const std::map<std::string, std::string>& a,
                                             const std::map<std::string, std::string>& b) {
    std::string names;
    for (const auto& [name, text] : a)
      if (!b.contains(name) || b.at(name) != text) names += name + " ";
    for (const auto& [name, text] : b)
      if (!a.contains(name)) names += name + " ";
    return names;
  }
  void expect_plan_refused(const std::string& text, const std::string& what) const {
    expect_refused({"sweep", plan(text), "-o", path("out")}, 3, what);
    EXPECT_FALSE(fs::exists(root_ / "out"));
  }
};

constexpr const char* kHead = "schema = \"openflank/sweep-plan/1\"\ncommand = \"cover\"\npart = \"blade.step\"\n";

TEST_F(SweepCli, APlanIsRefusedByItsLineBeforeAnythingRuns) {
  (void)make_blade();
  const std::string head = kHead;
  const std::string tools = "tools = [\"cylinder:radius=5\"]\n", faces = "faces = [\"F1\"]\n";
  expect_plan_refused(head + "faces = [\"F1\",\n \"F9\"]\n" + tools, "plan.toml: line 5, column 2: faces: ");
  expect_plan_refused(head + faces + "tools = [\"cylinder:radius=5\",\n\"egg\"]\n",
                      "plan.toml: line 6, column 1: tools: ");
  expect_plan_refused(head + faces + "tools = [\"free\"]\n", "is for fit");
  expect_plan_refused(head + faces + "tools = [\"none.json\"]\n", "line 5");
  expect_plan_refused(head + faces + tools + "[options]\ntolerence_mm = 1\n",
                      "line 7, column 16: tolerence_mm: is not a field of cover");
  expect_plan_refused(head + faces + tools + "[options]\ntolerance_mm = -1\n",
                      "line 7, column 16: tolerance_mm: -1: expected a length > 0 mm");
  expect_plan_refused(head + faces + tools + "[options]\nfaces = \"F1\"\n", "is set by the plan for each task");
  expect_plan_refused(head + faces + tools + "[variants.fine]\nstrips = \"many\"\n", "line 7, column 10: strips: many");
  expect_plan_refused(head + faces + tools + "[variants.\"../out\"]\n", "letters, digits");
  expect_plan_refused(head + faces + tools + "colour = 1\n", "line 6, column 1: unknown key \"colour\"");
  expect_plan_refused(head + faces + "tools = []\n", "a list of texts");
  expect_plan_refused(head + "faces = [\"F1\", \"F1\"]\n" + tools, "is given twice");
  expect_plan_refused("command = \"sing\"\n", "schema");
  expect_plan_refused("schema = \n", "line 1");
  expect_refused({"sweep", path("none.toml"), "-o", path("out")}, 3, "none.toml: cannot be read");
}

TEST_F(SweepCli, TheSameBytesForAnyNumberOfProcesses) {
  if (kSanitized) GTEST_SKIP() << "whole covers, several times; one task's death and refusals are tested there";
  const std::string file = good_plan("[variants.coarse]\n[variants.fine]\ntolerance_mm = 1.5\n");
  const Outcome one = flank({"sweep", file, "-o", path("one"), "--processes", "1", "--json"});
  ASSERT_TRUE(one.exit_code == 0 || one.exit_code == 1) << one.err;
  const std::map<std::string, std::string> kept = files(root_ / "one");
  // Results name their own folder, so the other run goes to the same place.
  fs::remove_all(root_ / "one");
  const Outcome four = flank({"sweep", file, "-o", path("one"), "--processes", "4", "--json"});
  EXPECT_EQ(four.out, one.out);
  EXPECT_EQ(different(files(root_ / "one"), kept), "");
  for (const char* name : {"sweep.json", "sweep.csv", "sweep.html", "F1-1-coarse/tool.json", "F1-2-fine/verify.json"})
    EXPECT_TRUE(kept.contains(name)) << name;
  const auto table = nlohmann::json::parse(kept.at("sweep.json"));
  ASSERT_EQ(table["tasks"].size(), 4u);
  EXPECT_EQ(table["tasks"][1]["folder"], "F1-1-fine");
  EXPECT_EQ(table["tasks"][2]["tool"], "cylinder:radius=5");
  EXPECT_EQ(table["complete"], true);
  const auto summary = nlohmann::json::parse(kept.at("F1-2-fine/summary.json"));
  EXPECT_EQ(table["tasks"][3]["coverage_reachable"], summary["coverage_reachable"]);
  EXPECT_EQ(summary["tolerance"], 1.5);
  if (kept.contains("F1-1-coarse/report.html")) {
    EXPECT_NE(kept.at("sweep.html").find("href=\"F1-1-coarse/report.html\""), std::string::npos);
  }
}

TEST_F(SweepCli, ResumeKeepsWhatIsWholeAndWasAskedForAlike) {
  if (kSanitized) GTEST_SKIP() << "whole covers, several times; one task's death and refusals are tested there";
  const std::string file = good_plan();
  const Outcome first = flank({"sweep", file, "-o", path("out")});
  const std::map<std::string, std::string> all = files(root_ / "out");
  // One result is damaged, the other is as it was.
  const auto time = [&](const char* name) { return fs::last_write_time(root_ / "out" / name); };
  fs::remove(root_ / "out/F1-2/path.json");
  const auto before = time("F1-1/tool.json"), lost = time("F1-2/tool.json");
  const Outcome second = flank({"sweep", file, "-o", path("out"), "--resume"});
  EXPECT_EQ(second.exit_code, first.exit_code);
  EXPECT_EQ(different(files(root_ / "out"), all), "");
  EXPECT_EQ(time("F1-1/tool.json"), before);
  EXPECT_GT(time("F1-2/tool.json"), lost);
  // Another tolerance is another task.
  std::string text = read_file(file);
  text.replace(text.find("2.5"), 3, "2.6");
  write_file(file, text);
  (void)flank({"sweep", file, "-o", path("out"), "--resume"});
  EXPECT_GT(time("F1-1/tool.json"), before);
}

/// Whether a process holds the folder of a result.
bool is_held(const fs::path& folder) {
  const int number = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (number < 0) return false;
  const bool held = ::flock(number, LOCK_EX | LOCK_NB) != 0;
  ::close(number);
  return held;
}

TEST_F(SweepCli, TheTasksOfAKilledSweepEndWithItAndResumeWorksAtOnce) {
  const std::string file = good_plan();
  std::string err = path("streams/killed.txt");
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_addopen(&streams, 2, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  std::vector<std::string> words{FLANK_BINARY, "sweep", file, "-o", path("out"), "--processes", "1", "--quiet"};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t sweep = 0;
  ASSERT_EQ(posix_spawn(&sweep, FLANK_BINARY, &streams, nullptr, argv.data(), environ), 0);
  posix_spawn_file_actions_destroy(&streams);
  int status = 0;
  while (!is_held(root_ / "out/F1-1") && ::waitpid(sweep, &status, WNOHANG) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const bool was_running = is_held(root_ / "out/F1-1");
  ::kill(sweep, SIGKILL);
  ::waitpid(sweep, &status, 0);
  EXPECT_TRUE(was_running);
  // The next run finds nobody there: only the time in which the system takes a killed process down is waited for.
  const auto begun = std::chrono::steady_clock::now();
  while (is_held(root_ / "out/F1-1") && std::chrono::steady_clock::now() - begun < std::chrono::seconds(20))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_FALSE(is_held(root_ / "out/F1-1"));
  EXPECT_FALSE(fs::exists(root_ / "out/F1-1/manifest.json")) << "it was ended, not waited for";
  if (kSanitized) return;
  const Outcome on = flank({"sweep", file, "-o", path("out"), "--processes", "2", "--resume", "--json"});
  EXPECT_LE(on.exit_code, 1) << on.err;
  for (const auto& task : nlohmann::json::parse(on.out)["tasks"])
    EXPECT_TRUE(task["status"] == "meets the request" || task["status"] == "falls short") << task;
}

TEST_F(SweepCli, ATaskThatTakesTooLongIsToldAndTheOthersAreThere) {
  const std::string file = good_plan("retries = 1\ntimeout_s = 0.001\n");
  const Outcome outcome = flank({"sweep", file, "-o", path("out"), "--json"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  const auto table = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(table["tasks"][0]["status"], "timed out");
  EXPECT_EQ(table["tasks"][0]["message"], "took more than 0.001 s");
  EXPECT_EQ(table["pass"], false);
  EXPECT_NE(read_file(root_ / "out/sweep.csv").find("F1-1,F1,cylinder:radius=6,,timed out,"), std::string::npos);
}

}  // namespace
}  // namespace flank::cli
