// The command line: parses arguments, calls the library, turns errors into exit codes.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "bound_command.h"
#include "commands.h"
#include "correct_command.h"
#include "design_command.h"
#include "flank/cad_process.h"
#include "flank/error.h"
#include "flank/printable.h"
#include "flank/threads.h"
#include "flank/version.h"
#include "messages.h"
#include "wheel_command.h"

namespace {

using flank::cli::kOurFault;
using flank::cli::kRefusedInput;
using flank::cli::kWrongUsage;

/// One line on stderr, whatever the message holds.
int complain(const std::string& message, int code) {
  std::string line = message;
  for (char& c : line)
    if (c == '\n') c = ' ';
  line = "flank: " + flank::printable(line) + "\n";
  // Nothing can be said where standard error is closed or full; the exit code says it.
  (void)std::fwrite(line.data(), 1, line.size(), stderr);
  return code;
}

/// A first word that is no command is named, with those that are.
void require_known_command(const CLI::App& parser, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::string known;
  for (const CLI::App* command : parser.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == argv[1]) return;
    known += (known.empty() ? "" : ", ") + command->get_name();
  }
  throw flank::UsageError(fmt::format("'{}' is no command; there are {}", argv[1], known));
}

void add_common(CLI::App& app, flank::cli::CommonOptions& common) {
  app.add_flag("--json", common.json, "Print the summary as JSON on stdout, and nothing else");
  app.add_flag("--quiet", common.quiet, "No progress and no summary");
  app.add_option("--progress", common.progress,
                 "How progress is told on stderr: line, or json: a line of JSON each time")
      ->check(CLI::IsMember({"line", "json"}))
      ->capture_default_str();
  app.add_option("--threads", common.threads, "Threads to use; 0: all cores. The result does not depend on it")
      ->check(CLI::Range(0, 1024));
  app.add_option("--read-limit", common.read_limit_s,
                 "Processor time for reading a CAD file, seconds; default: 10 and 30 more for each MB of it")
      ->check(CLI::Range(0.1, 1e6));
  app.add_flag("--no-cache", common.no_cache, "Read CAD files anew, and keep nothing of them for the next command");
}

/// The flags of a command, and those that all have.
std::map<std::string, std::string> with_common(std::map<std::string, std::string> flags) {
  flags["read_limit"] = "--read-limit";
  return flags;
}

/// What was printed must have arrived: a full disk or a closed pipe is noticed when it is flushed.
int flushed(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  return complain(std::string("standard output cannot be written (") + std::strerror(errno) + ")", kRefusedInput);
}

/// Gives each standard stream that is closed a descriptor that can be neither read nor written: another file that gets its
/// number would be taken for it.
void keep_standard_streams() {
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      static_cast<void>(!::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

/// What main does; throws only what nobody can report.
int run_command(int argc, char** argv) {
  keep_standard_streams();
  if (const std::optional<int> code = flank::serve_as_cad_reader(argc, argv)) return *code;
  // A reader that has gone away, and a limit on the size of files, are errors of the write, not our end.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  CLI::App parser{"flank: custom-shaped milling tools and the five-axis motions whose flank finishes a surface",
                  "flank"};
  parser.set_version_flag("--version", flank::kVersion);
  parser.require_subcommand(1);
  parser.footer(
      "Exit: 0 done, and the result meets the request; 1 done, but it does not; 2 wrong usage; 3 input refused; 4 our "
      "fault.");
  flank::cli::CommonOptions common;
  std::vector<flank::cli::Subcommand> commands = {
      flank::cli::add_inspect(parser), flank::cli::add_example(parser),  flank::cli::add_tool(parser),
      flank::cli::add_fit(parser),     flank::cli::add_cover(parser),    flank::cli::add_verify(parser),
      flank::cli::add_report(parser),  flank::cli::add_view(parser),     flank::cli::add_machine(parser),
      flank::cli::add_post(parser),    flank::cli::add_trochoid(parser), flank::cli::add_sweep(parser),
      flank::cli::add_design(parser),  flank::cli::add_bound(parser),    flank::cli::add_correct(parser),
      flank::cli::add_wheel(parser),   flank::cli::add_fields(parser),   flank::cli::add_studio(parser)};
  for (const flank::cli::Subcommand& command : commands) add_common(*command.app, common);
  const auto chosen = [&]() -> const flank::cli::Subcommand* {
    for (const flank::cli::Subcommand& command : commands)
      if (command.app->parsed() || (argc > 1 && command.app->get_name() == argv[1])) return &command;
    return nullptr;
  };
  const auto in_flags = [&](const flank::Error& error) {
    const flank::cli::Subcommand* command = chosen();
    return command != nullptr ? flank::cli::in_flags(error, with_common(command->flags)) : std::string(error.what());
  };
  try {
    require_known_command(parser, argc, argv);
    parser.parse(argc, argv);
    flank::set_thread_count(common.threads);
    // The command's threads are still to come, so it can be told now how CAD files are read.
    flank::read_cad_in_children(common.read_limit_s, !common.no_cache);
    return flushed(chosen()->run(common));
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return flushed(parser.exit(e));
    return complain(std::string(e.what()) + " (see flank --help)", kWrongUsage);
  } catch (const flank::UsageError& e) {
    return complain(in_flags(e), kWrongUsage);
  } catch (const flank::InputError& e) {
    return complain(in_flags(e), kRefusedInput);
  } catch (const flank::Stopped&) {
    return complain(flank::cli::stopped_by() + "; nothing was found yet", flank::cli::kFallsShort);
  } catch (const std::bad_alloc&) {
    return complain("out of memory", kOurFault);
  } catch (const std::system_error& e) {
    // fmt says so when a stream cannot be written.
    return complain(std::string("cannot write (") + e.what() + ")", kRefusedInput);
  } catch (const std::exception& e) {
    return complain(std::string("internal error: ") + e.what(), kOurFault);
  }
}

/// Memory that ends in a destructor (the JSON library's asks for some) comes here, not to a handler of run_command.
[[noreturn]] void end_at_once() {
  try {
    if (const std::exception_ptr what = std::current_exception()) std::rethrow_exception(what);
  } catch (const std::bad_alloc&) {
    constexpr std::string_view kText = "flank: out of memory\n";
    static_cast<void>(!::write(STDERR_FILENO, kText.data(), kText.size()));
    ::_exit(kOurFault);
  } catch (...) {
  }
  std::abort();
}

}  // namespace

int main(int argc, char** argv) {
  flank::end_with_parent();
  std::set_terminate(end_at_once);
  try {
    return run_command(argc, argv);
  } catch (...) {
    return kOurFault;
  }
}
