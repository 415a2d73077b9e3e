#include "flank/sweep/run_tasks.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <deque>
#include <string_view>
#include <thread>

#include "flank/error.h"
#include "flank/io/isolated/end_with_parent.h"

extern char** environ;

namespace flank::internal {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kLook{10};
/// For children that were told to end; their results are not kept.
constexpr std::chrono::milliseconds kPatience{500};
constexpr int kOurFault = 4;
constexpr int kSignalled = 128;

/// A task's process, in a group of its own, so that a signal of ours reaches its own children, too.
struct Running {
  std::size_t task = 0;
  int attempts_left = 0;
  pid_t process = 0;
  Clock::time_point begun;
  bool timed_out = false;
};

/// The environment of a child: ours, and whose end is its own.
std::vector<std::string> environment() {
  const std::string name = std::string(kEndsWithVariable) + "=";
  std::vector<std::string> all{name + std::to_string(::getpid())};
  for (char** entry = environ; *entry != nullptr; ++entry)
    if (!std::string_view(*entry).starts_with(name)) all.emplace_back(*entry);
  return all;
}

/// For functions of C, which take what they get as their own; valid as long as `words`.
std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> all;
  for (std::string& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

pid_t start(const std::string& program, const ChildTask& task) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addchdir_np(&files, task.folder.c_str());
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, 2, task.errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::vector<std::string> words = task.words;
  words.insert(words.begin(), program);
  std::vector<std::string> variables = environment();
  pid_t process = 0;
  const int failure =
      posix_spawn(&process, program.c_str(), &files, &attributes, pointers(words).data(), pointers(variables).data());
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  if (failure != 0) throw InternalError(program + ": cannot be started (" + std::strerror(failure) + ")");
  return process;
}

/// Ends what is still running when the loop is left by an exception.
struct Fleet {
  std::vector<Running> running;
  void tell(int signal) const {
    for (const Running& child : running) ::kill(-child.process, signal);
  }
  ~Fleet() {
    tell(SIGKILL);
    for (const Running& child : running) ::waitpid(child.process, nullptr, 0);
  }
};

/// Whether the process has ended, and how.
bool ended(const Running& child, ChildOutcome& outcome) {
  int status = 0;
  if (::waitpid(child.process, &status, WNOHANG) != child.process) return false;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
  outcome.timed_out = child.timed_out;
  return true;
}

}  // namespace

bool ChildOutcome::failed() const { return timed_out || exit_code == kOurFault || exit_code >= kSignalled; }

std::vector<ChildOutcome> run_tasks(const std::string& program, const std::vector<ChildTask>& tasks,
                                    const ChildLimits& limits,
                                    const std::function<void(std::size_t, const ChildOutcome&)>& done,
                                    const std::function<bool()>& cancelled) {
  std::vector<ChildOutcome> outcomes(tasks.size());
  std::deque<Running> waiting;
  for (std::size_t k = 0; k < tasks.size(); ++k) waiting.push_back({k, limits.retries, 0, {}, false});
  Fleet fleet;
  bool stopping = false;
  Clock::time_point stopped_at;
  while (!fleet.running.empty() || (!waiting.empty() && !stopping)) {
    if (!stopping && cancelled && cancelled()) {
      stopping = true;
      stopped_at = Clock::now();
      fleet.tell(SIGTERM);
    }
    // Their unfinished results are not kept: nothing is lost with a child that does not end.
    if (stopping && Clock::now() - stopped_at > kPatience) fleet.tell(SIGKILL);
    while (!stopping && !waiting.empty() && fleet.running.size() < static_cast<std::size_t>(limits.processes)) {
      Running next = waiting.front();
      waiting.pop_front();
      next.process = start(program, tasks[next.task]);
      next.begun = Clock::now();
      fleet.running.push_back(next);
    }
    for (std::size_t k = 0; k < fleet.running.size();) {
      Running& child = fleet.running[k];
      const std::chrono::duration<double> age = Clock::now() - child.begun;
      if (limits.timeout_s > 0.0 && age.count() > limits.timeout_s && !child.timed_out) {
        child.timed_out = true;
        ::kill(-child.process, SIGKILL);
      }
      ChildOutcome outcome;
      if (!ended(child, outcome)) {
        ++k;
        continue;
      }
      const Running past = child;
      fleet.running.erase(fleet.running.begin() + static_cast<std::ptrdiff_t>(k));
      if (stopping) continue;  // unfinished: as if it had not been begun
      if (outcome.failed() && past.attempts_left > 0) {
        waiting.push_back({past.task, past.attempts_left - 1, 0, {}, false});
      } else {
        outcomes[past.task] = outcome;
        if (done) done(past.task, outcome);
      }
    }
    std::this_thread::sleep_for(kLook);
  }
  return outcomes;
}

}  // namespace flank::internal
