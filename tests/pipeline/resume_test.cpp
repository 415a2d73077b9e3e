// A run that is stopped again and again, and goes on each time, ends with the bytes of one that was never stopped.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

#include "flank/base/sha256.h"
#include "flank/base/stopping.h"
#include "flank/error.h"
#include "flank/example.h"
#include "flank/io/cad/write_step.h"
#include "flank/manifest/result_folder.h"
#include "flank/pipeline/folder/resume_folder.h"
#include "flank/results/write_result.h"
#include "flank/run.h"
#include "flank/tool_file.h"
#include "sanitized.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

/// How a run is stopped: between its stages alone, or, as by a signal, within them, too.
enum class Stop { kBetween, kWithin };

/// Stops a run when it has asked so often whether it is to stop.
class Stopper {
 public:
  Stopper(int asked, Stop how) : left_(asked), how_(how) {}

  [[nodiscard]] Progress progress() {
    Progress progress;
    progress.cancelled = [this] {
      if (left_ > 0) --left_;
      if (left_ == 0 && how_ == Stop::kWithin && !within_) within_.emplace();
      return left_ == 0;
    };
    return progress;
  }

 private:
  int left_;
  Stop how_;
  std::optional<StopForTest> within_;
};

class Resume : public TemporaryFolder {
 protected:
  Resume() : TemporaryFolder("flank_resume") {}

  /// The example as a file, and its tool.
  std::string part(const std::string& name) {
    const Example example = make_example(name);
    write_step((root_ / "part.step").string(), example.faces);
    if (example.truth) std::ofstream(root_ / "truth.json") << tool_to_json(example.truth->tool);
    return (root_ / "part.step").string();
  }

  [[nodiscard]] std::string folder(const std::string& name) const { return (root_ / name).string(); }

  /// One run into the folder, on from what is there, and stopped when it has asked so often. Whether it was complete.
  template <class Job>
  bool run(Result (*work)(const Job&, const Progress&), const Job& job, const std::string& into, int asked, Stop how) {
    Stopper stopper(asked, how);
    Progress progress = stopper.progress();
    progress.journal =
        fs::exists(fs::path(folder(into)) / "resume.json") ? read_journal(folder(into)) : std::make_shared<Journal>();
    try {
      const Result result = work(job, progress);
      EXPECT_EQ(result.journal == nullptr, result.complete);
      write_result(result, folder(into));
      return result.complete;
    } catch (const Stopped&) {
      ResultFolder held(folder(into), ResultFolder::Use::kWrite);
      (void)write_steps(*progress.journal, job, held);
      return false;
    }
  }

  /// Stopped ever later, until it is done; how often it was stopped.
  template <class Job>
  int run_in_pieces(Result (*work)(const Job&, const Progress&), const Job& job, const std::string& into, Stop how) {
    constexpr int kMost = 60;
    int asked = 1;
    for (int stops = 0; stops < kMost; ++stops, asked += 1 + asked / 2)
      if (run(work, job, into, asked, how)) return stops;
    ADD_FAILURE() << "never done";
    return kMost;
  }

  void expect_same(const std::string& a, const std::string& b) const {
    for (const char* name : {"path.json", "tool.json", "verify.json", "path.cls", "job.json", "strips.step"}) {
      EXPECT_EQ(content(a + "/" + name), content(b + "/" + name)) << name;
      EXPECT_NE(content(a + "/" + name), "") << name;
    }
    EXPECT_FALSE(fs::exists(fs::path(folder(b)) / "resume.json")) << "a complete result has none";
  }

  template <class Job>
  void expect_same_in_pieces(Result (*work)(const Job&, const Progress&), const Job& job, Stop how, int least_stops) {
    write_result(work(job, {}), folder("whole"));
    EXPECT_GE(run_in_pieces(work, job, "pieces", how), least_stops);
    expect_same("whole", "pieces");
  }
};

FitJob small_fit(const std::string& part) {
  FitJob job;
  job.part.file = part;
  job.tolerance_mm = 0.2;
  job.tool.spec = "cone:radius=4";
  job.strips = 1;
  return job;
}

CoverJob small_cover(const std::string& part) {
  CoverJob job;
  job.part.file = part;
  job.tolerance_mm = 0.1;
  job.tool.spec = "cylinder:radius=6";
  job.tool.axis_length_mm = 45.0;
  return job;
}

TEST_F(Resume, AFitOfASheetGoesOn) {
  if (kSanitized) GTEST_SKIP() << "whole fits take minutes under a sanitizer";
  expect_same_in_pieces(run_fit, small_fit(part("envelope-cone-1")), Stop::kWithin, 3);
}

TEST_F(Resume, WhatIsLeftOfAStoppedFitIsJudgedBySamples) {
  if (kSanitized) GTEST_SKIP() << "the time that a verdict may take is short for a sanitizer";
  FitJob job = small_fit(part("envelope-cone-1"));
  job.part.side = +1;
  Stopper stopper(1, Stop::kWithin);
  const Result result = run_fit(job, stopper.progress());
  EXPECT_FALSE(result.complete);
  EXPECT_NE(result.verify.verdict, Verdict::kNotRun);
  EXPECT_EQ(result.verify.depth, DepthProof::kSampled);
  EXPECT_GT(result.verify.coverage, 0.0);
  EXPECT_FALSE(result.verify.faces.empty());
  EXPECT_FALSE(result.acceptance().pass());
}

TEST_F(Resume, AFitThatIsStoppedBetweenItsStagesGoesOn) {
  if (kSanitized) GTEST_SKIP() << "whole fits take minutes under a sanitizer";
  FitJob job = small_fit(part("envelope-cone-1"));
  job.part.side = +1;
  expect_same_in_pieces(run_fit, job, Stop::kBetween, 2);
}

TEST_F(Resume, AFitFromALineGoesOn) {
  if (kSanitized) GTEST_SKIP() << "whole fits take minutes under a sanitizer";
  // The axis of the truth's first pose.
  FitJob job = small_fit(part("envelope-barrel-2"));
  const Example example = make_example("envelope-barrel-2");
  const Pose pose = example.truth->path.strips.front().poses.front();
  const double length = example.truth->tool.radial.axis_length();
  job.tool.spec = "free";
  const auto text = [](const Vec3& p) {
    return std::to_string(p.x()) + "," + std::to_string(p.y()) + "," + std::to_string(p.z());
  };
  job.start = text(pose.tip) + "," + text(pose.at(length));
  job.part.side = +1;
  expect_same_in_pieces(run_fit, job, Stop::kWithin, 2);
}

TEST_F(Resume, ACoverGoesOn) {
  if (kSanitized) GTEST_SKIP() << "whole covers take minutes under a sanitizer";
  expect_same_in_pieces(run_cover, small_cover(part("elliptic-side")), Stop::kWithin, 3);
}

TEST_F(Resume, ACoverOfCurvesGoesOn) {
  if (kSanitized) GTEST_SKIP() << "whole covers take minutes under a sanitizer";
  CoverJob job = small_cover(part("elliptic-side"));
  job.strategy = "curves";
  job.part.side = -1;
  expect_same_in_pieces(run_cover, job, Stop::kBetween, 2);
}

TEST_F(Resume, ARankingGoesOn) {
  if (kSanitized) GTEST_SKIP() << "whole covers take minutes under a sanitizer";
  CoverJob job = small_cover(part("elliptic-side"));
  fs::create_directories(root_ / "catalogue");
  for (const double radius : {4.0, 5.0, 6.0}) {
    Tool tool;
    tool.radial = RadialFunction(ToolFamily::kCylinder, 45.0, Eigen::VectorXd::Constant(1, radius));
    std::ofstream(root_ / "catalogue" / (std::to_string(static_cast<int>(radius)) + ".json")) << tool_to_json(tool);
  }
  job.part.side = -1;
  job.tool = {"catalogue", {}};
  job.choice.catalogue = folder("catalogue");
  job.choice.finalists = 1;
  expect_same_in_pieces(run_cover, job, Stop::kWithin, 3);
  EXPECT_EQ(content("whole/ranking.json"), content("pieces/ranking.json"));
}

TEST_F(Resume, ACavityGoesOn) {
  if (kSanitized) GTEST_SKIP() << "whole cavities take minutes under a sanitizer";
  TrochoidJob job;
  job.part.file = part("cavity-barrel");
  job.tool.spec = folder("truth.json");
  job.tolerance_mm = 0.2;
  job.cycles.layers = 1;
  job.cycles.most_engagement_deg = 100.0;  // few cycles
  job.cycles.strategy = "plain";
  job.cycles.stock_cell_mm = 2.0;
  expect_same_in_pieces(run_trochoid, job, Stop::kWithin, 4);
}

TEST_F(Resume, StepsAloneTakeNoPlaceOfACompleteResult) {
  const std::string file = part("elliptic-side");
  Journal journal;
  ResultFolder held(folder("out"), ResultFolder::Use::kWrite);
  EXPECT_FALSE(write_steps(journal, small_cover(file), held)) << "of no run yet";
  const std::string hash(64, 'a');
  journal.begin({"1.0", hash, hash});
  EXPECT_FALSE(write_steps(journal, small_cover(file), held)) << "there are none";
  journal.add(0, {"grow", hash, {{1.0}, {}}});
  EXPECT_TRUE(write_steps(journal, small_cover(file), held));
  EXPECT_TRUE(write_steps(journal, small_cover(file), held)) << "again";
  EXPECT_EQ(journal_of(held)->steps().size(), 1u);
  held.replace({{"job.json", "{}"}}, *held.manifest());
  EXPECT_FALSE(write_steps(journal, small_cover(file), held));
  EXPECT_FALSE(fs::exists(root_ / "out/resume.json"));
}

/// What a fit leaves that was stopped once it had a start.
class StoppedFit : public Resume {
 protected:
  void SetUp() override {
    Resume::SetUp();
    if (kSanitized) GTEST_SKIP() << "a fit takes minutes under a sanitizer";
    job_ = small_fit(part("envelope-cone-1"));
    for (int asked = 2; !fs::exists(root_ / "out/resume.json"); asked += 2) {
      ASSERT_LT(asked, 40);
      ASSERT_FALSE(run(run_fit, job_, "out", asked, Stop::kWithin));
    }
  }

  [[nodiscard]] std::string refusal(const FitJob& job) const {
    Progress progress;
    try {
      progress.journal = read_journal(folder("out"));
      (void)run_fit(job, progress);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  void write(const std::string& file, const std::string& text) const {
    std::ofstream(fs::path(folder("out")) / file) << text;
  }

  FitJob job_;
};

TEST_F(StoppedFit, IsOfThisJobPartAndFolder) {
  FitJob other = job_;
  other.tolerance_mm = 0.11;
  EXPECT_NE(refusal(other).find("resume.json: is of another job"), std::string::npos) << refusal(other);
  const std::string before = content("out/resume.json");
  EXPECT_NE(before, "");
  std::ofstream(job_.part.file, std::ios::app) << "\n";
  EXPECT_NE(refusal(job_).find("resume.json: is of another part"), std::string::npos) << refusal(job_);
  fs::create_directories(folder("empty"));
  EXPECT_THROW((void)read_journal(folder("empty")), InputError);
  EXPECT_EQ(content("out/resume.json"), before);
}

TEST_F(StoppedFit, ThePartMayHaveMoved) {
  const std::string moved = folder("moved.step");
  fs::rename(job_.part.file, moved);
  FitJob job = job_;
  job.part.file = moved;
  Stopper at_once(1, Stop::kWithin);
  Progress progress = at_once.progress();
  progress.journal = read_journal(folder("out"));
  EXPECT_NO_THROW((void)run_fit(job, progress));
}

TEST_F(StoppedFit, AChangedJournalIsRefused) {
  const std::string before = content("out/resume.json");
  for (const std::string& damaged : {before.substr(0, before.size() / 2), before + " ", std::string()}) {
    write("resume.json", damaged);
    EXPECT_NE(refusal(job_).find("resume.json: is "), std::string::npos) << refusal(job_);
  }
}

/// Damage that the manifest names: somebody took trouble over it.
TEST_F(StoppedFit, ADamagedStepIsRefusedWithItsPlace) {
  std::string text = content("out/resume.json");
  const std::size_t numbers = text.find("\"numbers\":[") + 11;
  const std::size_t comma = text.find(',', numbers);
  const auto publish = [&](const std::string& damaged) {
    ResultFolder held(folder("out"), ResultFolder::Use::kWrite);
    held.add({{"resume.json", damaged}}, *held.manifest());
  };
  publish(text.substr(0, numbers) + "\"inf\"" + text.substr(comma));
  EXPECT_NE(refusal(job_).find("resume.json: step 1 ("), std::string::npos) << refusal(job_);
  publish(text.substr(0, numbers) + "NaN" + text.substr(comma));
  EXPECT_NE(refusal(job_).find("parse error"), std::string::npos) << refusal(job_);
  publish(text.substr(0, text.size() / 2));
  EXPECT_NE(refusal(job_).find("parse error"), std::string::npos) << refusal(job_);
}

TEST_F(StoppedFit, AStepOfOtherInputsIsDoneAgain) {
  std::string text = content("out/resume.json");
  const std::size_t inputs = text.find("\"inputs\":\"") + 10;
  text[inputs] = text[inputs] == '0' ? '1' : '0';
  {
    ResultFolder held(folder("out"), ResultFolder::Use::kWrite);
    held.add({{"resume.json", text}}, *held.manifest());
  }
  write_result(run_fit(job_, {}), folder("whole"));
  EXPECT_TRUE(run(run_fit, job_, "out", -1, Stop::kBetween));
  expect_same("whole", "out");
}

TEST_F(StoppedFit, ACompleteResultSaysWhetherAnythingIsLeft) {
  {
    const ResultFolder held(folder("out"), ResultFolder::Use::kRead);
    EXPECT_FALSE(is_finished(held, job_, {})) << "it was stopped";
  }
  EXPECT_TRUE(run(run_fit, job_, "out", -1, Stop::kBetween));
  const ResultFolder held(folder("out"), ResultFolder::Use::kRead);
  EXPECT_TRUE(is_finished(held, job_, {}));
  EXPECT_EQ(meets_request(held), content("out/summary.json").find("\"pass\": true") != std::string::npos);
  FitJob other = job_;
  other.strips = 5;
  EXPECT_THROW((void)is_finished(held, other, {}), InputError);
  EXPECT_THROW((void)is_finished(held, job_, {{"t.json", sha256("t")}}), InputError) << "a file that it did not read";
  const std::string path = content("out/path.json");
  write("path.json", path + "\n");
  EXPECT_THROW((void)is_finished(held, job_, {}), InputError) << "edited";
  fs::remove(root_ / "out/path.json");
  EXPECT_THROW((void)is_finished(held, job_, {}), InputError) << "gone";
  write("path.json", path);
  EXPECT_TRUE(is_finished(held, job_, {}));
  std::ofstream(job_.part.file, std::ios::app) << "\n";
  EXPECT_THROW((void)is_finished(held, job_, {}), InputError);
}

}  // namespace
}  // namespace flank::internal
