#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "commands.h"
#include "flank/printable.h"
#include "progress_line.h"

namespace flank::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void on_interrupt(int signal) {
  // A second one ends at once.
  if (interrupted != 0) std::_Exit(128 + signal);
  interrupted = signal;
  request_stop();
}

const char* name_of(int signal) { return signal == SIGTERM ? "SIGTERM" : signal == SIGHUP ? "SIGHUP" : "SIGINT"; }

/// Only what a handler may call.
void on_end(int signal) {
  const std::string_view begin = "flank: stopped by ", name = name_of(signal), end = "\n";
  for (const std::string_view part : {begin, name, end}) (void)!::write(STDERR_FILENO, part.data(), part.size());
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// From now on `handler` is called when we are asked to end; also for what came before, if whoever started us held it back until somebody here
/// could hear it.
void handle_ends(void (*handler)(int)) {
  sigset_t ends;
  sigemptyset(&ends);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::signal(signal, handler);
    sigaddset(&ends, signal);
  }
  ::pthread_sigmask(SIG_UNBLOCK, &ends, nullptr);
}

/// A line of JSON for every report on stderr; of reports that follow each other fast only the first.
Progress as_json(Progress progress) {
  constexpr double kPause = 0.1;  // seconds
  const auto start = std::chrono::steady_clock::now();
  struct Told {
    ProgressLine line;
    std::string stage;
    double seconds = -1.0;
  };
  const auto told = std::make_shared<Told>();
  progress.found = [told](const BestSoFar& found) { told->line.found(found); };
  progress.report = [start, told](std::string_view stage, double share) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::string line = told->line.json(stage, share, seconds) + "\n";
    if (stage == told->stage && share < 1.0 && seconds < told->seconds + kPause) return;
    told->stage = stage, told->seconds = seconds;
    (void)std::fwrite(line.data(), 1, line.size(), stderr);
    std::fflush(stderr);
  };
  return progress;
}

/// A line on stderr, also if quiet.
void say(const std::string& message) {
  const std::string line = "flank: " + message + "\n";
  (void)std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace

std::string stopped_by() { return fmt::format("stopped by {}", name_of(interrupted)); }

void say_stopped(const std::string& folder) {
  say(fmt::format("{}; the best result so far is in {}; the same command with --resume continues", stopped_by(),
                  printable(folder)));
}

void say_steps_kept(const std::string& folder) {
  say(fmt::format("{}; no result yet, but the finished steps are in {}; the same command with --resume continues",
                  stopped_by(), printable(folder)));
}

void say_operations_kept(const std::string& folder) {
  say(fmt::format("{}; the finished operations are in {}; the same command continues", stopped_by(),
                  printable(folder)));
}

void end_on_signals() { handle_ends(on_end); }

Progress terminal_progress(const CommonOptions& options) {
  handle_ends(on_interrupt);
  Progress progress;
  progress.cancelled = [] { return interrupted != 0; };
  if (options.progress == "json") return as_json(std::move(progress));
  if (options.quiet || options.json) return progress;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto start = std::chrono::steady_clock::now();
  const auto shown = std::make_shared<ProgressLine>();
  progress.found = [shown](const BestSoFar& found) { shown->found(found); };
  progress.report = [terminal, start, shown](std::string_view stage, double share) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::string line;
    if (terminal)
      line = fmt::format("\r\x1b[K{}", share >= 1.0 ? std::string() : shown->line(stage, share, seconds));
    else if (share < 1.0)
      line = fmt::format("{} {:.0f} %\n", stage, 100.0 * share);
    // A standard error that is closed or full costs the progress, not the work.
    (void)std::fwrite(line.data(), 1, line.size(), stderr);
    std::fflush(stderr);
  };
  return progress;
}

}  // namespace flank::cli
