// The command that a report shows asks for the same job again: through a real shell and the command's own parser.
#include "job_options.h"

#include "cli/cli_fixture.h"
#include "flank/job/bound_fields.h"
#include "flank/job/command_line.h"
#include "flank/job/design_fields.h"
#include "job/random_jobs.h"
#include "messages.h"

namespace flank::cli {
namespace {

using internal::Random;

class JobOptions : public Cli {
 protected:
  /// The words that a shell makes of a command, without "flank" and the command's name.
  [[nodiscard]] std::vector<std::string> words_of(const std::string& command) const {
    const Outcome echo =
        run_program("/bin/sh", {"-c", "flank() { shift; printf '%s\\0' \"$@\"; }; " + command}, root_ / "streams");
    EXPECT_EQ(echo.exit_code, 0) << echo.err;
    std::vector<std::string> words;
    for (std::size_t at = 0; at < echo.out.size();) {
      words.push_back(echo.out.substr(at, echo.out.find('\0', at) - at));
      at += words.back().size() + 1;
    }
    return words;
  }

  template <class Job>
  [[nodiscard]] Job parsed(std::vector<std::string> words) const {
    CLI::App app;
    Job job;
    (void)add_job_options(app, job);
    std::reverse(words.begin(), words.end());
    app.parse(words);
    return job;
  }

  template <class Job>
  void expect_the_same_again() const {
    Random random(23);
    for (int k = 0; k < 60; ++k) {
      Job job = internal::jobs::random_job<Job>(random, k % 3 == 0 ? 1.0 : 0.3);
      // Of several words the first is the folder.
      if constexpr (std::is_same_v<Job, VerifyJob>)
        if (job.folder.empty()) job.more_folders.clear();
      const std::string command = internal::command_line(job);
      EXPECT_EQ(parsed<Job>(words_of(command)), job) << command;
    }
  }
};

TEST_F(JobOptions, AFitIsTheSameAgain) { expect_the_same_again<FitJob>(); }
TEST_F(JobOptions, ACoverIsTheSameAgain) { expect_the_same_again<CoverJob>(); }
TEST_F(JobOptions, AVerifyIsTheSameAgain) { expect_the_same_again<VerifyJob>(); }
TEST_F(JobOptions, APostIsTheSameAgain) { expect_the_same_again<PostJob>(); }
TEST_F(JobOptions, ADesignIsTheSameAgain) { expect_the_same_again<internal::DesignJob>(); }
TEST_F(JobOptions, ABoundIsTheSameAgain) { expect_the_same_again<internal::BoundJob>(); }
TEST_F(JobOptions, ACorrectionIsTheSameAgain) { expect_the_same_again<internal::CorrectJob>(); }
TEST_F(JobOptions, ARedesignIsTheSameAgain) { expect_the_same_again<internal::RedesignJob>(); }
TEST_F(JobOptions, AWheelIsTheSameAgain) { expect_the_same_again<WheelRequest>(); }

TEST_F(JobOptions, ADiameterIsTwiceARadius) {
  const auto job = parsed<FitJob>({"blade.step", "--shank-length", "30", "--shank-diameter", "8"});
  EXPECT_EQ(job.obstacles.shank_radius_mm, 4.0);
  EXPECT_THROW((void)parsed<FitJob>({"blade.step", "--shank-radius", "4", "--shank-diameter", "8"}), CLI::ParseError);
}

TEST_F(JobOptions, MessagesNameOptions) {
  CLI::App app;
  CoverJob job;
  const FlagNames flags = add_job_options(app, job);
  EXPECT_EQ(in_flags(UsageError("tolerance_mm", "expected a length > 0 mm"), flags),
            "--tolerance: expected a length > 0 mm");
  EXPECT_EQ(in_flags(UsageError("faces", "F9", "no such face"), flags), "--face F9: no such face");
  EXPECT_EQ(in_flags(UsageError("tool", "a family needs `axis_length_mm`, or `nothing` and `fixtures`"), flags),
            "--tool: a family needs --axis-length, or `nothing` and --fixture");
  EXPECT_EQ(in_flags(InputError("the tolerance_mm of a file: no field of ours"), flags),
            "the tolerance_mm of a file: no field of ours");
  EXPECT_EQ(in_flags(InputError("a lone ` and no end"), flags), "a lone ` and no end");
}

TEST_F(JobOptions, SeedIsAcceptedOnlyIfItMeansSomething) {
  const std::string blade = make_blade();
  expect_refused({"fit", blade, "--seed", "3", "-o", path("out")}, 2, "--seed");
  expect_refused({"inspect", blade, "--seed", "3"}, 2, "--seed");
  expect_refused(
      {"cover", blade, "--tool", "cylinder:radius=5", "--axis-length", "20", "--seed", "3", "-o", path("out")}, 2,
      "--seed: needs --strategy curves");
  EXPECT_EQ(flank({"example", "twisted-blade", "--seed", "3", "-o", path("again.step")}).exit_code, 0);
}

}  // namespace
}  // namespace flank::cli
