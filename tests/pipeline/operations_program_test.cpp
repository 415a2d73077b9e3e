// Programs of several tools and of turned copies: judged operation by operation as strictly as a program of one, and together.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>

#include "flank/error.h"
#include "flank/example.h"
#include "flank/io/cad/write_step.h"
#include "flank/job/job_json.h"
#include "flank/path_file.h"
#include "flank/pipeline/folder/turned_copies.h"
#include "flank/pipeline/folder/wheel_plan.h"
#include "flank/pipeline/program/operation_words.h"
#include "flank/run.h"
#include "flank/tool_file.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMachine = "fanuc-ac";

void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

/// A face and the same face turned by half a turn, its own tool in two folders under two names: two tools for people and for files.
class Folders {
 public:
  Folders() : root_(fs::path(::testing::TempDir()) / ("flank_operations_" + std::to_string(::getpid()))) {
    const Example example = make_example("envelope-cone-1", {.relative_accuracy = 1e-6});
    const std::vector<Pose>& poses = example.truth->path.strips.front().poses;
    const Pose& middle = poses[poses.size() / 2];
    const Face& face = example.faces.front();
    const BSplineSurface& s = face.surface;
    const Vec3 on_face = s.value(0.5 * (s.u_first() + s.u_last()), 0.5 * (s.v_first() + s.v_last()));
    // Behind the face, where the tool is not.
    axis_.direction = middle.axis;
    axis_.point =
        on_face + 60.0 * (on_face - middle.tip - middle.axis * middle.axis.dot(on_face - middle.tip)).normalized();
    Face other = face;
    for (Vec3& pole : other.surface.poles) pole = copy_turn(axis_, 2, 2) * pole;
    fs::create_directories(root_);
    write_step((root_ / "part.step").string(), {face, other});
    make("first", *example.truth, "first tool");
    make("second", *example.truth, "second tool");
  }
  ~Folders() { fs::remove_all(root_); }
  Folders(const Folders&) = delete;
  Folders& operator=(const Folders&) = delete;

  [[nodiscard]] PostJob post() const {
    PostJob job;
    job.folder = (root_ / "first").string();
    job.more_folders = {(root_ / "second").string()};
    job.machine = kMachine;
    job.feed_mm_min = 1000.0;
    job.spindle_rpm = 5000.0;
    job.operations = {"2:name=second,spindle=7000,length=110"};
    return job;
  }
  [[nodiscard]] PostJob copies() const {
    PostJob job = post();
    job.copies = 2;
    job.copy_axis = copy_axis_text(axis_);
    return job;
  }
  /// The same as the folder of a wheel: both halves by two operations, of which the whole has the path.
  [[nodiscard]] std::string wheel() const {
    const fs::path folder = root_ / "wheel";
    if (fs::exists(folder)) return folder.string();
    fs::create_directories(folder / "ops");
    for (const char* name : {"job.json", "tool.json"}) fs::copy(root_ / "first" / name, folder / name);
    fs::copy(root_ / "first", folder / "ops/20-side");
    fs::copy(root_ / "first", folder / "ops/30-floor");
    const Vec3 &p = axis_.point, &d = axis_.direction;
    const auto step = [](const char* id, const char* kind) {
      return fmt::format(R"({{"id": "{0}", "kind": "{1}", "folder": "ops/{0}-{1}", "copies": 2, "done": true}})", id,
                         kind);
    };
    write(
        folder / "plan.json",
        fmt::format(R"({{"schema": "openflank/plan/1", "axis": {{"point_mm": [{}, {}, {}], "direction": [{}, {}, {}]}},
                      "copies": 2, "sectors": 2, "whole": true, "most_engagement_deg": 180, "operations": [{}, {}]}})",
                    p.x(), p.y(), p.z(), d.x(), d.y(), d.z(), step("20", "side"), step("30", "floor")));
    Path sector = read_path((root_ / "first/path.json").string());
    sector.strips.push_back(sector.strips.front());
    write_path(all_copies(sector, *read_wheel_plan(folder.string()), 2), (folder / "path.json").string());
    return folder.string();
  }
  [[nodiscard]] VerifyJob verify(const std::string& text) const {
    write(root_ / "p.nc", text);
    VerifyJob job;
    job.folder = (root_ / "first").string();
    job.more_folders = {(root_ / "second").string()};
    job.nc.file = (root_ / "p.nc").string();
    job.nc.machine = kMachine;
    return job;
  }

 private:
  void make(const char* name, ExampleTruth truth, const char* tool) const {
    const fs::path folder = root_ / name;
    fs::create_directories(folder);
    FitJob job;
    job.part.file = (root_ / "part.step").string();
    job.tolerance_mm = 0.02;
    job.judge.sample_mm = 2.5;
    write(folder / "job.json", job_to_json(job));
    truth.tool.name = tool;
    write_tool(truth.tool, (folder / "tool.json").string());
    write_path(truth.path, (folder / "path.json").string());
  }

  fs::path root_;
  CopyAxis axis_;
};

const Folders& folders() {
  static const Folders kFolders;
  return kFolders;
}

/// Reasons against a program, or why it is refused; samples prove nothing of what lies between them, and that is left out.
std::string complaint(const VerifyJob& job) {
  try {
    std::string all;
    for (const Shortfall& reason : run_verify(job).acceptance.reasons)
      if (reason.figure != "overcut_bound_mm" && reason.figure != "gouge_bound_mm")
        all += reason.figure + ": " + reason.text + "\n";
    return all;
  } catch (const InputError& e) {
    return std::string("refused: ") + e.what();
  }
}
std::string complaint(const std::string& text) { return complaint(folders().verify(text)); }

/// Replaces what is found first behind a place; throws where there is none.
std::string replaced(std::string text, const std::string& behind, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(behind), at = place == std::string::npos ? place : text.find(from, place);
  if (at == std::string::npos)
    throw std::logic_error(from + " is not behind " + behind + " in\n" + text.substr(0, 2000));
  return text.replace(at, from.size(), to);
}

TEST(OperationsProgram, OfTwoToolsPassesAndTellsOfEach) {
  const PostOutcome posted = run_post(folders().post());
  ASSERT_EQ(posted.operations.size(), 2U);
  EXPECT_EQ(posted.operations[0].tool_number, 1);
  EXPECT_EQ(posted.operations[1].tool_number, 2);
  EXPECT_EQ(posted.operations[1].name, "second");
  EXPECT_DOUBLE_EQ(posted.operations[1].spindle_rpm, 7000.0);
  EXPECT_NEAR(posted.minutes, posted.operations[0].minutes + posted.operations[1].minutes, 1e-12);
  EXPECT_EQ(complaint(posted.program), "") << posted.program.substr(0, 1500);
  const Verification judged = run_verify(folders().verify(posted.program));
  ASSERT_EQ(judged.operations.size(), 2U);
  EXPECT_GT(judged.operations[1].report.coverage, 0.9);
}

TEST(OperationsProgram, SpoiltInOneOperationDoesNotPass) {
  if (kSanitized) GTEST_SKIP() << "many judgements";
  const std::string text = run_post(folders().post()).program, second = "(OPERATION 2 OF 2";
  const auto why = [&](const char* from, const char* to) { return complaint(replaced(text, second, from, to)); };
  EXPECT_NE(why("T2 M6\n", "\n").find("tool_number:"), std::string::npos);
  EXPECT_NE(why("T2 M6", "T1 M6").find("tool_number:"), std::string::npos);
  EXPECT_NE(why("G43.4 H2", "G43.4 H1").find("tool_length:"), std::string::npos);
  EXPECT_NE(why("G54", "G55").find("work_offset:"), std::string::npos);
  EXPECT_NE(why("S7000 M3\n", "\n").find("spindle:"), std::string::npos);
  EXPECT_NE(why("(SETUP ", "(SETUP 1").find("setup:"), std::string::npos);
  EXPECT_NE(why("(OPERATION 2 OF 2", "(OPERATION 1 OF 2").find("refused:"), std::string::npos);
  EXPECT_NE(why("(OPERATION 2 OF 2 SECOND)\n", "").find("refused:"), std::string::npos);
  // Every reason says of which operation it is.
  EXPECT_NE(why("T2 M6", "T1 M6").find("operation 2 of 2"), std::string::npos);
}

TEST(OperationsProgram, IsOfItsFoldersInTheirOrder) {
  if (kSanitized) GTEST_SKIP() << "many judgements";
  const std::string text = run_post(folders().post()).program;
  VerifyJob job = folders().verify(text);
  job.more_folders.clear();
  EXPECT_NE(complaint(job).find("refused:"), std::string::npos);
  job = folders().verify(text);
  job.more_folders.push_back(job.folder);
  EXPECT_NE(complaint(job).find("refused:"), std::string::npos);
  // A program of one, for two folders.
  PostJob one = folders().post();
  one.more_folders.clear();
  one.operations.clear();
  EXPECT_NE(complaint(run_post(one).program).find("refused:"), std::string::npos);
}

TEST(OperationsProgram, OfTurnedCopiesPasses) {
  const PostOutcome posted = run_post(folders().copies());
  ASSERT_EQ(posted.operations.size(), 4U);
  EXPECT_EQ(posted.operations[1].copy, 2);
  EXPECT_EQ(posted.operations[1].tool_number, 1);
  EXPECT_EQ(complaint(posted.program), "") << posted.program.substr(0, 1500);
}

TEST(OperationsProgram, OfCopiesThatAreNotTurnedAsTheySayDoesNotPass) {
  if (kSanitized) GTEST_SKIP() << "many judgements";
  const std::string text = run_post(folders().copies()).program;
  // The first copy's moves in the place of the second one's: the second half of the part is left as it is.
  const std::size_t first = text.find("N1 "), second = text.find("(OPERATION 2 OF 4"), two = text.find("N2 "),
                    third = text.find("(OPERATION 3 OF 4");
  const std::string same =
      text.substr(0, two) + "N2 " + text.substr(first + 3, second - first - 3) + text.substr(third);
  EXPECT_NE(complaint(same).find("program_path:"), std::string::npos) << complaint(same);
  EXPECT_NE(complaint(replaced(text, "OPERATION 2 OF 4", "COPY 2 OF 2", "COPY 1 OF 2")).find("refused:"),
            std::string::npos);
}

TEST(OperationsProgram, OfAWheelIsJudgedAsAWhole) {
  PostJob post = folders().post();
  post.folder = folders().wheel();
  post.more_folders.clear(), post.operations.clear();
  const PostOutcome posted = run_post(post);
  ASSERT_EQ(posted.operations.size(), 4U);
  const auto judged = [&](const std::string& text) {
    VerifyJob job = folders().verify(text);
    job.folder = folders().wheel();
    job.more_folders.clear();
    return job;
  };
  EXPECT_EQ(complaint(judged(posted.program)), "") << posted.program.substr(0, 1500);
  if (kSanitized) return;
  // A half that is left out, or run in rapid.
  const std::string &text = posted.program, second = "(OPERATION 2 OF 4";
  const std::size_t begin = text.find(second), end = text.find("(OPERATION 3 OF 4");
  EXPECT_NE(complaint(judged(text.substr(0, begin) + text.substr(end))).find("refused:"), std::string::npos);
  EXPECT_NE(complaint(judged(replaced(text, second, "G1 ", "G0 "))).find("operation 2 of 4"), std::string::npos);
}

TEST(OperationsProgram, TellsOnceWhatIsSoOfEveryOperation) {
  PostJob job = folders().post();
  job.folder = folders().wheel(), job.more_folders.clear(), job.operations.clear();
  job.machine = "linuxcnc-xyzac-trt";
  const PostOutcome posted = run_post(job);
  const auto tells = [](const std::string& note) {
    return note.find("LinuxCNC stops at the end") != std::string::npos;
  };
  EXPECT_EQ(std::count_if(posted.notes.begin(), posted.notes.end(), tells), 1);
  const auto one = std::find_if(posted.notes.begin(), posted.notes.end(), tells);
  ASSERT_NE(one, posted.notes.end());
  EXPECT_TRUE(one->starts_with("LinuxCNC")) << *one;
}

TEST(OperationsProgram, AxesAreWrittenWithoutExponents) {
  const CopyAxis axis{Vec3(-4e-16, 9.5e-5, 15.652), Vec3(-1e-17, 0.0, 1.0)};
  EXPECT_EQ(copy_axis_text(axis), "0,0.000095,15.652,0,0,1");
  EXPECT_EQ(parse_copy_axis(copy_axis_text(axis)).point.y(), 9.5e-5);
}

TEST(OperationsProgram, OfAPartThatIsNotTheSameWhenTurnedIsRefused) {
  PostJob job = folders().copies();
  job.copies = 3;
  EXPECT_THROW((void)run_post(job), InputError);
  job = folders().copies();
  job.copy_axis = "0,0,0,0,0,1";
  EXPECT_THROW((void)run_post(job), InputError);
  job.copy_axis = "0,0,0,0,0,0";
  EXPECT_THROW((void)run_post(job), UsageError);
  job = folders().post();
  job.copy_axis = "0,0,0,0,0,1";
  EXPECT_THROW((void)run_post(job), UsageError);
}

TEST(OperationsProgram, HasANumberForEachTool) {
  PostJob job = folders().post();
  job.operations = {"1:tool=5", "2:tool=5"};
  EXPECT_THROW((void)run_post(job), UsageError);
  // The same tool twice is one.
  job = folders().post();
  job.more_folders = {job.folder};
  job.operations = {"1:tool=5"};
  const PostOutcome posted = run_post(job);
  EXPECT_EQ(posted.operations[0].tool_number, 5);
  EXPECT_EQ(posted.operations[1].tool_number, 5);
}

TEST(OperationWords, SayWhatWouldBeAccepted) {
  const std::vector<OperationWords> words = parse_operations({"2:name=a b,tool=7,flutes=3", "1:feed=800"}, 2);
  EXPECT_EQ(words[1].name, "a b");
  EXPECT_EQ(words[1].tool, 7);
  EXPECT_EQ(words[1].flutes, 3);
  EXPECT_EQ(words[0].feed_mm_min, 800.0);
  for (const char* wrong :
       {"", "3:tool=1", "0:tool=1", "1", "1:tool", "1:tool=1.5", "1:speed=3", "1:length=-4", "1:name="})
    EXPECT_THROW((void)parse_operations({wrong}, 2), UsageError) << wrong;
}

}  // namespace
}  // namespace flank::internal
