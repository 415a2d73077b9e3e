// Streams that are closed or full, and signals.
#include <signal.h>

#include <chrono>
#include <thread>

#include "cli/cli_fixture.h"

namespace flank::cli {
namespace {

/// The exit code of a command line of the shell, in which $FLANK is the command.
int shell(const std::string& line) {
  const int status = std::system(("FLANK='" FLANK_BINARY "'; " + line).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

TEST_F(Cli, StandardOutputThatIsFullOrClosedIsExitThree) {
  EXPECT_EQ(shell("\"$FLANK\" tool cylinder:radius=3 2>/dev/null >/dev/full"), 3);
  EXPECT_EQ(shell("\"$FLANK\" tool cylinder:radius=3 2>/dev/null >&-"), 3);
  EXPECT_EQ(shell("\"$FLANK\" --help 2>/dev/null >/dev/full"), 3);
}

TEST_F(Cli, AReaderThatHasSeenEnoughCostsNoMessage) {
  EXPECT_EQ(shell("(sleep 0.2; exec \"$FLANK\" --help-all) 2>'" + path("said") + "' | true"), 0);
  EXPECT_EQ(read_file(path("said")), "");
}

TEST_F(Cli, StandardErrorThatIsFullOrClosedCostsTheMessageOnly) {
  EXPECT_EQ(shell("\"$FLANK\" inspect nothing.step 2>/dev/full"), 3);
  EXPECT_EQ(shell("\"$FLANK\" inspect nothing.step 2>&-"), 3);
  EXPECT_EQ(shell("\"$FLANK\" polish 2>&-"), 2);
}

TEST_F(Cli, WhicheverStreamsAreClosedASoundPartIsRead) {
  const std::string blade = make_blade();
  const std::string open[3] = {"", " >/dev/null", " 2>/dev/null"}, shut[3] = {" <&-", " >&-", " 2>&-"};
  for (unsigned closed = 0; closed < 8; ++closed) {
    std::string streams;
    for (unsigned k = 0; k < 3; ++k) streams += (closed >> k & 1u) != 0 ? shut[k] : open[k];
    // Only what could not be printed is a fault.
    EXPECT_EQ(shell("\"$FLANK\" inspect '" + blade + "'" + streams), (closed & 2u) != 0 ? 3 : 0) << streams;
    const std::string made = path("made" + std::to_string(closed) + ".step");
    EXPECT_EQ(shell("\"$FLANK\" example ruled-blade --quiet -o '" + made + "'" + streams), 0) << streams;
    EXPECT_EQ(read_file(made).substr(0, 12), "ISO-10303-21") << streams;
  }
}

TEST_F(Cli, ALimitOnTheSizeOfFilesIsAMessage) {
  const std::string err = path("err.txt"), large = path("large.step");
  EXPECT_EQ(shell("ulimit -f 4; \"$FLANK\" example twisted-blade --quiet -o '" + large + "' 2>'" + err + "'"), 3);
  EXPECT_NE(read_file(err).find("large.step"), std::string::npos) << read_file(err);
  EXPECT_FALSE(fs::exists(large));
}

TEST_F(Cli, SignalsStopAndKeepTheBestSoFar) {
  if (kSanitized) GTEST_SKIP() << "whole searches take minutes";
  const std::string blade = make_blade();
  for (const char* name : {"TERM", "HUP", "INT"}) {
    // A file of its own: what an earlier one has said must not be taken for this one's best so far.
    const std::string out = path(name), err = out + ".txt";
    // Once there is a best so far, however busy the machine is.
    const int code = shell("\"$FLANK\" fit '" + blade + "' --face F1 --tolerance 1e-4 --progress json -o '" + out +
                           "' >/dev/null 2>'" + err + "' & p=$!; n=0; until grep -q '\"best\":{' '" + err +
                           "' || [ $n -gt 600 ]; do sleep 0.1; n=$((n+1)); done; kill -" + name + " $p; wait $p");
    EXPECT_EQ(code, 1) << read_file(err);
    EXPECT_NE(read_file(err).find(std::string("stopped by SIG") + name), std::string::npos) << read_file(err);
    EXPECT_TRUE(fs::exists(out + "/manifest.json"));
  }
}

}  // namespace
}  // namespace flank::cli
