#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <string>

#include "commands.h"
#include "flank/base/printable.h"

namespace flank::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void on_interrupt(int signal) {
  // A second one ends at once.
  if (interrupted != 0) std::_Exit(128 + signal);
  interrupted = signal;
}

std::string time_left(double seconds, double share) {
  if (share < 0.05) return "";
  return fmt::format(", {:.0f} s left", seconds * (1.0 - share) / share);
}

}  // namespace

void say_stopped(const std::string& folder) {
  const int signal = interrupted;
  const char* name = signal == SIGTERM ? "SIGTERM" : signal == SIGHUP ? "SIGHUP" : "SIGINT";
  const std::string line =
      fmt::format("flank: stopped by {}; the best so far is in {}\n", name, internal::printable(folder));
  (void)std::fwrite(line.data(), 1, line.size(), stderr);
}

Progress terminal_progress(const CommonOptions& options) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, on_interrupt);
  Progress progress;
  progress.cancelled = [] { return interrupted != 0; };
  if (options.quiet || options.json) return progress;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto start = std::chrono::steady_clock::now();
  progress.report = [terminal, start](std::string_view stage, double share) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::string line;
    if (terminal)
      line = fmt::format("\r\x1b[K{} {:3.0f} %{}{}", stage, 100.0 * share, time_left(seconds, share),
                         share >= 1.0 ? "\r\x1b[K" : "");
    else if (share < 1.0)
      line = fmt::format("{} {:.0f} %\n", stage, 100.0 * share);
    // A standard error that is closed or full costs the progress, not the work.
    (void)std::fwrite(line.data(), 1, line.size(), stderr);
    std::fflush(stderr);
  };
  return progress;
}

}  // namespace flank::cli
