/// Commands that are stopped by a signal.
#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "cli/cli_fixture.h"

namespace flank::cli {

class StoppedCli : public Cli {
 protected:
  struct Ended {
    int status = 0;
    double seconds = 0.0;  ///< from the signal to the end; processor time of others counts
    std::string err;
  };

  /// Runs the command and sends it the signal once its messages hold `stage` (it may have ended before).
  [[nodiscard]] Ended stopped_at(const std::vector<std::string>& arguments, const std::string& stage,
                                 int signal) const {
    const std::string err = (root_ / "streams/stop.txt").string();
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, 2, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    std::vector<std::string> words = arguments;
    words.insert(words.begin(), FLANK_BINARY);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_t child = 0;
    EXPECT_EQ(posix_spawn(&child, FLANK_BINARY, &files, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&files);
    Ended ended;
    while (read_file(err).find(stage) == std::string::npos && ::waitpid(child, &ended.status, WNOHANG) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    ::kill(child, signal);
    ::waitpid(child, &ended.status, 0);
    ended.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    ended.err = read_file(err);
    return ended;
  }
};

}  // namespace flank::cli
