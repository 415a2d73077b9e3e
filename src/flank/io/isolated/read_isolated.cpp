#include "flank/io/isolated/read_isolated.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/personality.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <vector>

#include "flank/base/stopping.h"
#include "flank/error.h"
#include "flank/io/isolated/part_bytes.h"
#include "flank/io/isolated/reader_message.h"

extern char** environ;

namespace flank::internal {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSecondsAtLeast = 10.0, kSecondsPerMegabyte = 30.0;  // of processor time
/// Bytes of address space: the kernel's libraries alone take a third of the first.
constexpr double kMemoryAtLeast = 1.5e9, kMemoryPerByte = 100.0;
/// The limit is on processor time, which a busy machine gives slowly; by the clock, a child may take so many times as much.
constexpr double kClockPerProcessor = 30.0;
/// One that is asleep for so long, and asks for no processor, sleeps for ever.
constexpr double kSleepSeconds = 60.0;

/// Closes at the end of its life.
struct Descriptor {
  int number = -1;
  ~Descriptor() { close(); }
  void close() {
    if (number >= 0) ::close(number);
    number = -1;
  }
};

/// While this lives, programs that are started get the same addresses each time, so that what a damaged file makes the
/// kernel do is the same each time. Where the system does not allow that, it stays as it was.
class SameAddresses {
 public:
  SameAddresses() : before_(::personality(0xffffffff)) {
    if (before_ >= 0) ::personality(static_cast<unsigned long>(before_) | ADDR_NO_RANDOMIZE);
  }
  ~SameAddresses() {
    if (before_ >= 0) ::personality(static_cast<unsigned long>(before_));
  }
  SameAddresses(const SameAddresses&) = delete;
  SameAddresses& operator=(const SameAddresses&) = delete;

 private:
  int before_;
};

/// Starts the child with the pipe as its descriptor 3 and nothing on the others.
pid_t start(std::vector<std::string> words, int pipe) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, 2, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, pipe, kReaderPipe);
  pid_t child = -1;
  const SameAddresses same;  // until the child is started, which inherits the setting
  // The program itself under another word: it needs not be found, and is of the same version.
  const int failure = ::posix_spawn(&child, "/proc/self/exe", &files, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failure != 0) throw InternalError(std::string("cannot start the reader of CAD files: ") + std::strerror(failure));
  return child;
}

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Whether a process sleeps, by the letter in /proc/PID/stat that follows its name: one that runs, waits for a processor or the disk, or was
/// stopped by somebody does not.
bool is_asleep(pid_t process) {
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string line;
  std::getline(file, line);
  // The name is in parentheses and may hold any characters.
  const std::size_t name = line.rfind(") ");
  return name != std::string::npos && line.compare(name + 2, 1, "S") == 0;
}

/// Tells a child that sleeps for ever from one that waits for a processor.
class Pulse {
 public:
  explicit Pulse(pid_t child) : child_(child), known_(::clock_getcpuclockid(child, &clock_) == 0) {}
  [[nodiscard]] bool stopped() {
    timespec used{};
    if (!known_ || ::clock_gettime(clock_, &used) != 0) return false;
    const bool progress = used.tv_sec != used_.tv_sec || used.tv_nsec != used_.tv_nsec;
    if (progress || !is_asleep(child_)) {
      used_ = used;
      since_ = Clock::now();
    }
    return seconds_since(since_) > kSleepSeconds;
  }

 private:
  pid_t child_;
  clockid_t clock_{};
  bool known_;
  timespec used_{};
  Clock::time_point since_ = Clock::now();
};

/// Why no more is read of what a child writes.
enum class Over { kNot, kBytes, kAsleep, kClock };

/// All that the child writes; nothing more once it takes more than `patience` by the clock, sleeps, or wrote more than `most` bytes.
std::string receive(int pipe, pid_t child, double patience, double most, Over& over) {
  constexpr int kLookMs = 100;
  const auto begin = Clock::now();
  Pulse pulse(child);
  std::string bytes;
  std::array<char, 1 << 16> block;
  while (true) {
    // Looked at every kLookMs at least: a child that writes nothing is noticed as well, and so is a request to stop.
    stop_here();
    over = static_cast<double>(bytes.size()) > most ? Over::kBytes
           : pulse.stopped()                        ? Over::kAsleep
           : seconds_since(begin) > patience        ? Over::kClock
                                                    : Over::kNot;
    if (over != Over::kNot) return bytes;
    pollfd wait{pipe, POLLIN, 0};
    if (::poll(&wait, 1, kLookMs) <= 0) continue;
    const ssize_t got = ::read(pipe, block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return bytes;
    bytes.append(block.data(), static_cast<std::size_t>(got));
  }
}

/// The child's status; a child that is not waited for would remain as a zombie.
int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

[[noreturn]] void refuse_slow(const std::string& file, double seconds) {
  throw InputError(
      fmt::format("{}: reading it takes more than {:g} s; it is damaged or large; set another limit by `read_limit`",
                  file, seconds));
}

[[noreturn]] void refuse_late(const std::string& file, double seconds) {
  throw InputError(
      fmt::format("{}: reading it has not ended after {:g} s by the clock, in which it got less than {:g} s of a "
                  "processor; try again when the machine is less busy, or set another limit by `read_limit`",
                  file, kClockPerProcessor * seconds, seconds));
}

[[noreturn]] void refuse_large(const std::string& file, double bytes) {
  throw InputError(fmt::format("{}: reading it takes more than {:.1f} GB of memory; it is damaged, export it again",
                               file, 1e-9 * bytes));
}

[[noreturn]] void refuse_crash(const std::string& file, int status) {
  throw InputError(fmt::format("{}: the CAD kernel breaks down on it ({} {}); it is damaged, export it again", file,
                               WIFSIGNALED(status) ? "signal" : "exit",
                               WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status)));
}

}  // namespace

double default_seconds(double bytes) { return kSecondsAtLeast + kSecondsPerMegabyte * 1e-6 * bytes; }

Part read_cad_isolated(const std::string& file, const std::string& format, const std::optional<std::string>& unit,
                       const ReadLimits& limits) {
  std::error_code ignored;
  const auto size = static_cast<double>(std::filesystem::file_size(file, ignored));
  const double seconds = limits.seconds.value_or(default_seconds(ignored ? 0.0 : size));
  // Damaged counts in a file can ask for any amount: bounded by what a sound file of this size may need.
  const double memory = kMemoryAtLeast + kMemoryPerByte * (ignored ? 0.0 : size);
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw InternalError(std::string("cannot start the reader of CAD files: ") + std::strerror(errno));
  Descriptor from{ends[0]}, to{ends[1]};
  const pid_t child = start({"flank", kReadCadCommand, file, format, unit.value_or(""), fmt::format("{}", seconds),
                             fmt::format("{:.0f}", memory)},
                            to.number);
  // Ours, or the end of the pipe would never come when the child is gone.
  to.close();
  Over over = Over::kNot;
  std::string bytes;
  try {
    bytes = receive(from.number, child, kClockPerProcessor * seconds, memory, over);
  } catch (...) {
    ::kill(child, SIGKILL);
    (void)wait_for(child);
    throw;
  }
  if (over != Over::kNot) ::kill(child, SIGKILL);
  const int status = wait_for(child);
  stop_here();  // a signal to all that a terminal runs ends the child, too
  // In this order: a child that was killed by us has a signal too, and that is not its fault.
  if (over == Over::kBytes) refuse_large(file, memory);
  if (over == Over::kClock) refuse_late(file, seconds);
  if (over == Over::kAsleep || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)) refuse_slow(file, seconds);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || bytes.empty()) refuse_crash(file, status);
  // The first byte says what the rest is: a part, a message for the user, or one about a bug.
  const std::string_view text = std::string_view(bytes).substr(1);
  if (bytes[0] == kReaderPart) return decode_part(text);
  if (bytes[0] == kReaderMemory) refuse_large(file, memory);
  if (bytes[0] == kReaderRefuses) throw InputError(std::string(text));
  throw InternalError("reading " + file + ": " + std::string(text));
}

}  // namespace flank::internal
