/// Children of the studio: the command itself, started again for every piece of work.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace flank::internal {

/// A process that may outlive us: a number alone may belong to another one by then.
struct Child {
  pid_t process = 0;        ///< 0: none
  std::uint64_t begun = 0;  ///< when, in the kernel's ticks since the machine started
};

/// What a child is given, and where what it says goes.
struct ChildWords {
  std::string program;
  std::vector<std::string> words;  ///< without the program's name
  std::string folder;              ///< where it runs
  std::string out, err;            ///< files for its streams; what was there is kept, and more added
  /// An interrupt waits until the child can answer it: until then it would end the child, and what it was to keep.
  bool holds_interrupt = false;
};

/// Starts a child in a session of its own: signals of a terminal do not reach it, and it goes on if we are killed. Throws InternalError.
[[nodiscard]] Child start_child(const ChildWords& words);

/// Whether this very process still runs.
[[nodiscard]] bool is_running(const Child& child);

/// The exit code once it has ended, 128 + signal if a signal ended it; nothing while it runs. Of a process that somebody else
/// started nobody learns it: -1.
[[nodiscard]] std::optional<int> exit_of(const Child& child);

/// Sends a signal to the process, if it is still this one.
void signal_child(const Child& child, int signal);

/// How the folders begin in which run_child keeps what a child says.
inline constexpr const char* kScratch = ".said-";

/// What a short child said.
struct Said {
  int exit_code = -1;  ///< 128 + signal if a signal ended it, also ours after the time
  std::string out, err;
};

/// How long a short child may take, and how much it may say.
struct ShortLimits {
  double seconds = 3600.0;
  std::size_t bytes = std::size_t{1} << 20;  ///< of each stream; what is more is thrown away
};

/// Runs a child to its end, or until `ended` is true: nobody waits for the answer any more.
[[nodiscard]] Said run_child(const std::string& program, const std::vector<std::string>& words,
                             const std::string& folder, const ShortLimits& limits, const std::atomic<bool>& ended);

/// "refused by the kernel", "crashed (signal 11)": what an exit code means to people; empty for 0 to 3.
[[nodiscard]] std::string crash_text(int exit_code);

}  // namespace flank::internal
