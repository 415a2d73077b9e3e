#include "flank/studio/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

#include "flank/error.h"

extern char** environ;

namespace flank::internal {
namespace {

constexpr int kSignalled = 128;
constexpr std::chrono::milliseconds kLook{10};

/// When a process began, from the 22nd field of its line in /proc; 0 if it is not there or only waits to be buried.
std::uint64_t begin_of(pid_t process) {
  std::ifstream stream("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  if (!std::getline(stream, line)) return 0;
  // The second field, a name in parentheses, may hold anything.
  const std::size_t name_end = line.rfind(')');
  if (name_end == std::string::npos) return 0;
  std::istringstream rest(line.substr(name_end + 1));
  std::string word;
  constexpr int kState = 3, kBegin = 22;
  for (int field = kState; field <= kBegin && rest >> word; ++field)
    if (field == kState && word == "Z") return 0;
  return rest ? std::strtoull(word.c_str(), nullptr, 10) : 0;
}

std::string read_some(const std::string& file, std::size_t most) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(most, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(most));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  return text;
}

int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status); }

/// A folder for what one child says, gone afterwards.
class Scratch {
 public:
  explicit Scratch(const std::string& folder) : folder_(folder + "/" + kScratch + "XXXXXX") {
    if (::mkdtemp(folder_.data()) == nullptr) throw InternalError(folder_ + ": cannot be made");
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] std::string file(const char* name) const { return folder_ + "/" + name; }

 private:
  std::string folder_;
};

}  // namespace

Child start_child(const ChildWords& words) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addchdir_np(&files, words.folder.c_str());
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, words.out.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, words.err.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  // Our sockets are not for it.
  posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t held;
  sigemptyset(&held);
  if (words.holds_interrupt) sigaddset(&held, SIGINT);
  posix_spawnattr_setsigmask(&attributes, &held);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
  std::vector<std::string> copy = words.words;
  copy.insert(copy.begin(), words.program);
  std::vector<char*> pointers;
  for (std::string& word : copy) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  Child child;
  const int failure = posix_spawn(&child.process, words.program.c_str(), &files, &attributes, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  if (failure != 0) throw InternalError(words.program + ": cannot be started (" + std::strerror(failure) + ")");
  child.begun = begin_of(child.process);
  return child;
}

bool is_running(const Child& child) {
  return child.process > 0 && begin_of(child.process) == child.begun && child.begun;
}

std::optional<int> exit_of(const Child& child) {
  int status = 0;
  const pid_t ended = ::waitpid(child.process, &status, WNOHANG);
  if (ended == child.process) return code_of(status);
  if (ended == 0 || is_running(child)) return {};
  return -1;
}

void signal_child(const Child& child, int signal) {
  if (is_running(child)) ::kill(child.process, signal);
}

Said run_child(const std::string& program, const std::vector<std::string>& words, const std::string& folder,
               const ShortLimits& limits, const std::atomic<bool>& ended) {
  const Scratch scratch(folder);
  const Child child = start_child({program, words, folder, scratch.file("out"), scratch.file("err")});
  const auto begin = std::chrono::steady_clock::now();
  std::optional<int> code;
  while (!(code = exit_of(child))) {
    const std::chrono::duration<double> age = std::chrono::steady_clock::now() - begin;
    // Its whole group: the command has a child of its own that reads CAD files.
    if (ended || age.count() > limits.seconds) ::kill(-child.process, SIGKILL);
    std::this_thread::sleep_for(kLook);
  }
  return {*code, read_some(scratch.file("out"), limits.bytes), read_some(scratch.file("err"), limits.bytes)};
}

std::string crash_text(int exit_code) {
  if (exit_code >= kSignalled)
    return fmt::format("the command was ended by signal {}; its finished steps are kept", exit_code - kSignalled);
  if (exit_code < 0) return "the command ended while the studio was not running";
  return exit_code > 3 ? "internal error of the command" : "";
}

}  // namespace flank::internal
