// The command that asks for a job, as a report shows it. That it asks for the same job again is a test of the command.
#include "flank/job/command_line.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

TEST(CommandLine, SaysWhatDiffersFromTheDefaults) {
  FitJob fit;
  fit.part.file = "parts/blade.step";
  EXPECT_EQ(command_line(fit), "flank fit parts/blade.step --face F1");
  fit.tool.spec = "cone:radius=2,angle=3";
  fit.tolerance_mm = 0.1;
  fit.strips = 3;
  fit.part.side = -1;
  fit.avoid = false;
  fit.obstacles.shank_length_mm = 30.0;
  fit.obstacles.holder = "30:10,70:10";
  fit.obstacles.fixtures = {"vice.step", "my clamp.stl"};
  fit.obstacles.clearance_mm = 0.5;
  EXPECT_EQ(command_line(fit),
            "flank fit parts/blade.step --face F1 --side=- --tool cone:radius=2,angle=3 --tolerance 0.1 --strips 3 "
            "--shank-length 30 --holder 30:10,70:10 --fixture vice.step --fixture 'my clamp.stl' --clearance 0.5 "
            "--avoid off");
  CoverJob cover;
  cover.part.file = "blade.step";
  cover.tool.spec = "catalogue";
  cover.strategy = "curves";
  cover.seed = 7;
  cover.most_strips = 4;
  cover.choice.feed_mm_min = 800.0;
  EXPECT_EQ(command_line(cover),
            "flank cover blade.step --face F1 --tool catalogue --strategy curves --seed 7 --strips 4 --feed 800");
  VerifyJob verify;
  verify.folder = "out";
  verify.tolerance_mm = 0.02;
  EXPECT_EQ(command_line(verify), "flank verify out --tolerance 0.02");
}

TEST(CommandLine, QuotesForAShell) {
  EXPECT_EQ(shell_quoted("a/b.step"), "a/b.step");
  EXPECT_EQ(shell_quoted(""), "''");
  EXPECT_EQ(shell_quoted("a b"), "'a b'");
  EXPECT_EQ(shell_quoted("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_quoted("$HOME"), "'$HOME'");
  EXPECT_EQ(shell_quoted("~"), "'~'");
}

TEST(CommandLine, CanHideFolders) {
  FitJob job;
  job.part.file = "/home/me/blade.step";
  job.tool.spec = "/home/me/tool.json";
  job.guide = "/home/me/guide.txt";
  job.obstacles.holder = "30:10,70:10";
  job.obstacles.fixtures = {"/home/me/vice.step"};
  const std::string text = command_line(without_folders(job));
  EXPECT_EQ(text.find("/home"), std::string::npos) << text;
  EXPECT_EQ(
      text,
      "flank fit blade.step --face F1 --tool tool.json --guide guide.txt --holder 30:10,70:10 --fixture vice.step");
}

TEST(AskedFor, SaysItWithUnits) {
  FitJob job;
  job.tolerance_mm = 0.1;
  job.tool.axis_length_mm = 20.0;
  job.strips = 3;
  job.obstacles.fixtures = {"a", "b"};
  EXPECT_EQ(asked_for(job), (std::vector<std::string>{"tolerance 0.1 mm", "axis length 20 mm", "strips 3", "fixtures a",
                                                      "fixtures b"}));
}

}  // namespace
}  // namespace flank::internal
