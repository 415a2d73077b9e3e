// Damaged CAD files, wrong kinds of files, names of any bytes: exit 3 with one line, or a right answer.
#include <sys/stat.h>

#include <chrono>

#include "cli/cli_fixture.h"
#include "shared_data.h"

namespace flank::cli {
namespace {

class CliDamaged : public Cli {
 protected:
  [[nodiscard]] std::string blade_with(const std::string& from, const std::string& to) const {
    std::string text = read_file(make_blade());
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    write_file(root_ / "damaged.step", text);
    return path("damaged.step");
  }
};

TEST_F(CliDamaged, NumbersThatWouldBeReadInPart) {
  for (const char* number : {"(0x1p5,", "(--3.,", "(nan,", "(1.E400,", "(,"})
    expect_refused({"inspect", blade_with("(0.,", number)}, 3, "damaged.step, line ");
}

TEST_F(CliDamaged, WhatCrashesOrHangsTheKernelIsRefused) {
  FLANK_REAL_PART(folder, "bad");
  int tried = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string kind = entry.path().extension();
    if (!entry.is_regular_file() || kind == ".md") continue;
    SCOPED_TRACE(entry.path());
    const bool mesh = kind == ".obj" || kind == ".ply";
    std::vector<std::string> words{"inspect", entry.path()};
    const std::vector<std::string> more =
        mesh ? std::vector<std::string>{"--unit", "mm"} : std::vector<std::string>{"--read-limit", "1"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = flank(words);
    ++tried;
    if (entry.path().filename().string().find("ngon_concave") != std::string::npos) {
      EXPECT_EQ(outcome.exit_code, 0);
      EXPECT_NE(outcome.out.find(" 55.00 "), std::string::npos) << outcome.out;
      continue;
    }
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_EQ(messages(outcome).size(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find(entry.path().filename().string()), std::string::npos) << outcome.err;
  }
  EXPECT_GT(tried, 20);
}

TEST_F(CliDamaged, TheReadLimitIsKept) {
  FLANK_REAL_PART(part, "bad/brepA_0230_flip3.brep");
  expect_refused({"inspect", part, "--read-limit", "0.5"}, 3, "--read-limit");
  expect_refused({"inspect", part, "--read-limit", "0"}, 2, "--read-limit");
}

TEST_F(CliDamaged, PipesAndDevicesAreRefused) {
  ASSERT_EQ(::mkfifo(path("pipe.step").c_str(), 0600), 0);
  expect_refused({"inspect", path("pipe.step")}, 3, "pipe");
  expect_refused({"inspect", "/dev/zero"}, 3, "device");
  expect_refused({"tool", "cylinder:radius=3", "-o", path("pipe.step")}, 3, "pipe");
}

TEST_F(CliDamaged, NoNameOfAFileReachesTheTerminalAsItIs) {
  const Outcome outcome = flank({"inspect", path("a\x1b[31m\rb.step")});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.err.find_first_of("\x1b\r"), std::string::npos);
  EXPECT_NE(outcome.err.find("a\\x1b[31m\\x0db.step"), std::string::npos) << outcome.err;
}

TEST_F(CliDamaged, NamesNeedNotBeUtf8) {
  const std::string odd = path("bl\xff.step");
  fs::copy_file(make_blade(), odd);
  const Outcome table = flank({"inspect", odd});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_NE(table.out.find("bl\\xff.step"), std::string::npos) << table.out;
  const Outcome text = flank({"inspect", odd, "--json"});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_TRUE(nlohmann::json::accept(text.out));
}

TEST_F(CliDamaged, AnAxisOfNoLengthIsRefused) {
  expect_refused({"fit", make_blade(), "--face", "F1", "--axis-length", "1e-300", "-o", path("out")}, 2,
                 "--axis-length");
  const Outcome outcome =
      flank({"fit", path("blade.step"), "--face", "F1", "--axis-length", "1e-6", "-o", path("out")});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
}

}  // namespace
}  // namespace flank::cli
