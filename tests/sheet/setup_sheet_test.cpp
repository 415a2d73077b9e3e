// The sheet says what the program and the folders say, and its verdict is theirs.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "flank/error.h"
#include "flank/example.h"
#include "flank/io/text/json_input.h"
#include "flank/job/job_json.h"
#include "flank/path_file.h"
#include "flank/results/acceptance.h"
#include "flank/results/verify_json.h"
#include "flank/sheet/part_drawing.h"
#include "flank/sheet/sheet_page.h"
#include "flank/tool_file.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMachine = "fanuc-ac";

void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

/// Part, tool, path and verdict of an example whose tool is known, and its program.
class Folder {
 public:
  Folder() : root_(fs::path(::testing::TempDir()) / ("flank_sheet_" + std::to_string(::getpid()))) {
    fs::create_directories(root_ / "blade");
    const Example example = make_example("envelope-cone-1", {.relative_accuracy = 1e-6});
    (void)write_example(example, (root_ / "part.step").string());
    FitJob job;
    job.part.file = (root_ / "part.step").string();
    job.tolerance_mm = 0.02;
    job.judge.sample_mm = 2.5;
    write(root_ / "blade/job.json", job_to_json(job));
    Tool tool = example.truth->tool;
    tool.name = "cone <4>";
    const double top = meridian_point(tool.radial, tool.radial.axis_length()).x();
    tool.shank = {{top, 5.0}, {top + 30.0, 5.0}};
    write_tool(tool, (root_ / "blade/tool.json").string());
    write_path(example.truth->path, (root_ / "blade/path.json").string());
    judge({});
    PostJob post;
    post.folder = (root_ / "blade").string();
    post.machine = kMachine;
    post.feed_mm_min = 1000.0;
    post.spindle_rpm = 5000.0;
    post.force = true;
    write(root_ / "part.nc", run_post(post).program);
    stick_out_ = tool.radial.at(0.0).r + top + 30.0;
  }
  ~Folder() { fs::remove_all(root_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// A verdict as `flank verify` leaves one.
  void judge(const Acceptance& acceptance) const {
    VerifyReport report;
    report.tolerance_mm = 0.02;
    write(root_ / "blade/verify.json", verify_to_json(report, acceptance));
  }
  [[nodiscard]] SheetJob job() const {
    return {{(root_ / "blade").string()}, (root_ / "part.nc").string(), kMachine, std::nullopt};
  }
  [[nodiscard]] double stick_out() const { return stick_out_; }

 private:
  fs::path root_;
  double stick_out_ = 0.0;
};

const Folder& folder() {
  static const Folder kFolder;
  return kFolder;
}

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

TEST(SetupSheet, SaysWhatTheProgramSays) {
  folder().judge({});
  const SetupSheet sheet = make_setup_sheet(folder().job());
  EXPECT_EQ(sheet.program, "part.nc");
  EXPECT_EQ(sheet.machine, kMachine);
  EXPECT_EQ(sheet.work_offset, 1);
  ASSERT_EQ(sheet.operations.size(), 1U);
  EXPECT_EQ(sheet.operations[0].tool_number, 1);
  EXPECT_EQ(sheet.operations[0].spindle_rpm, 5000.0);
  EXPECT_GT(sheet.operations[0].minutes, 0.01);
  EXPECT_LE(sheet.operations[0].feed_high, 1000.0 * 1.5);
  EXPECT_GT(sheet.operations[0].feed_low, 0.0);
  ASSERT_EQ(sheet.tools.size(), 1U);
  EXPECT_NEAR(sheet.tools[0].stick_out_mm, folder().stick_out(), 1e-6);
  const std::string page = sheet_html(sheet);
  for (const char* words :
       {"part.nc", "part.step", "T1", "fanuc-ac", "Clamping", "lies on the table", "G54", "cone &lt;4&gt;"})
    EXPECT_TRUE(has(page, words)) << words;
}

TEST(SetupSheet, HasTheVerdictOfTheFolder) {
  folder().judge({});
  EXPECT_TRUE(make_setup_sheet(folder().job()).verdict.pass());
  EXPECT_TRUE(has(sheet_html(make_setup_sheet(folder().job())), ">MEETS THE REQUEST<"));
  Acceptance no;
  add_reason(no, Figure::kGouge, "F88 is cut by 1.5 mm");
  add_caution(no, Figure::kBodyUnknown, "no holder was given");
  folder().judge(no);
  const SetupSheet sheet = make_setup_sheet(folder().job());
  EXPECT_FALSE(sheet.verdict.pass());
  const std::string page = sheet_html(sheet);
  EXPECT_TRUE(has(page, "<div class=\"verdict no\">DOES NOT MEET THE REQUEST"));
  EXPECT_TRUE(has(page, "<p class=\"reason\">F88 is cut by 1.5 mm"));
  EXPECT_TRUE(has(page, "<p class=\"caution\">CAUTION: no holder was given"));
  EXPECT_FALSE(has(page, ">MEETS THE REQUEST<"));
}

TEST(SetupSheet, NeedsNothingFromElsewhere) {
  std::string page = sheet_html(make_setup_sheet(folder().job()));
  for (std::size_t at = 0; (at = page.find("xmlns=\"http://www.w3.org/2000/svg\"", at)) != std::string::npos;)
    page.erase(at, 34);
  for (const char* other : {"http:", "https:", "<script", "<link", "url("}) EXPECT_FALSE(has(page, other)) << other;
}

TEST(SetupSheet, WithoutAProgramSaysSo) {
  SheetJob job = folder().job();
  job.nc.reset();
  const SetupSheet sheet = make_setup_sheet(job);
  EXPECT_FALSE(sheet.placed);
  EXPECT_TRUE(has(sheet_html(sheet), "no program was given"));
}

TEST(SetupSheet, RefusesAProgramOfOtherOperations) {
  SheetJob job = folder().job();
  job.folders.push_back(job.folders.front());
  EXPECT_THROW((void)make_setup_sheet(job), InputError);
  job = folder().job();
  job.machine.reset();
  EXPECT_THROW((void)make_setup_sheet(job), UsageError);
}

TEST(PartDrawing, HasThePartWhereItIsClamped) {
  const std::string file = (fs::path(folder().job().folders.front()).parent_path() / "part.step").string();
  const Part part = read_part(file, "mm");
  WorkSetup place;
  place.translation = Vec3(10.0, 20.0, 30.0);
  const PartDrawing as_it_is(part, {0}, {}), moved(part, {0}, place);
  EXPECT_LT((moved.box().low - as_it_is.box().low - place.translation).norm(), 1e-9);
  EXPECT_LT((moved.box().high - as_it_is.box().high - place.translation).norm(), 1e-9);
  EXPECT_TRUE(has(moved.svg(DrawnFrom::kFront), "class=\"target\""));
  EXPECT_FALSE(has(moved.svg(DrawnFrom::kAbove), "class=\"clamp\""));
}

}  // namespace
}  // namespace flank::internal
