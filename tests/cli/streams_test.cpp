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

TEST_F(Cli, StandardErrorThatIsFullOrClosedCostsTheMessageOnly) {
  EXPECT_EQ(shell("\"$FLANK\" inspect nothing.step 2>/dev/full"), 3);
  EXPECT_EQ(shell("\"$FLANK\" inspect nothing.step 2>&-"), 3);
  EXPECT_EQ(shell("\"$FLANK\" polish 2>&-"), 2);
}

TEST_F(Cli, SignalsStopAndKeepTheBestSoFar) {
  if (kSanitized) GTEST_SKIP() << "whole searches take minutes";
  const std::string blade = make_blade();
  for (const char* name : {"TERM", "HUP", "INT"}) {
    const std::string out = path(name), err = path("err.txt");
    const int code = shell("\"$FLANK\" fit '" + blade + "' --face F1 --tolerance 1e-4 --quiet -o '" + out + "' 2>'" +
                           err + "' & p=$!; sleep 2; kill -" + name + " $p; wait $p");
    EXPECT_EQ(code, 1) << read_file(err);
    EXPECT_NE(read_file(err).find(std::string("stopped by SIG") + name), std::string::npos) << read_file(err);
    EXPECT_TRUE(fs::exists(out + "/manifest.json"));
  }
}

}  // namespace
}  // namespace flank::cli
