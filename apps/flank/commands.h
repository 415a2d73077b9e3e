/// The subcommands: each adds itself to the parser and returns what to run when it was chosen.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "flank/progress.h"
#include "flank/run.h"

namespace flank::cli {

/// Options that every command shares.
struct CommonOptions {
  std::vector<std::string> words;  ///< as they were typed, for a command that hands them on
  bool json = false;
  bool quiet = false;
  std::string progress = "line";  ///< or "json": a line of JSON for every report, also if quiet
  int threads = 0;
  std::optional<double> read_limit_s;  ///< for reading a CAD file; none: by its size
  bool no_cache = false;               ///< what was read of CAD files is neither taken from the cache nor kept there
};

/// Exit codes of the command.
inline constexpr int kMeetsRequest = 0, kFallsShort = 1, kWrongUsage = 2, kRefusedInput = 3, kOurFault = 4;
/// Every command that judges ends with this.
[[nodiscard]] inline int exit_code(const Acceptance& acceptance) {
  return acceptance.pass() ? kMeetsRequest : kFallsShort;
}

/// Runs the chosen command and returns the exit code.
using Command = std::function<int(const CommonOptions&)>;

/// A command line with its help text, what it does, and how it calls the fields that the library names in messages.
struct Subcommand {
  CLI::App* app;
  Command run;
  std::map<std::string, std::string> flags;
};

[[nodiscard]] Subcommand add_inspect(CLI::App& parser);
[[nodiscard]] Subcommand add_fields(CLI::App& parser);
[[nodiscard]] Subcommand add_example(CLI::App& parser);
[[nodiscard]] Subcommand add_tool(CLI::App& parser);
[[nodiscard]] Subcommand add_fit(CLI::App& parser);
[[nodiscard]] Subcommand add_cover(CLI::App& parser);
[[nodiscard]] Subcommand add_trochoid(CLI::App& parser);
[[nodiscard]] Subcommand add_verify(CLI::App& parser);
[[nodiscard]] Subcommand add_report(CLI::App& parser);
[[nodiscard]] Subcommand add_view(CLI::App& parser);
[[nodiscard]] Subcommand add_machine(CLI::App& parser);
[[nodiscard]] Subcommand add_post(CLI::App& parser);
[[nodiscard]] Subcommand add_studio(CLI::App& parser);
[[nodiscard]] Subcommand add_sweep(CLI::App& parser);

/// A line on stderr that grows on a terminal, plain lines otherwise, nothing if quiet; cancelled by Ctrl-C.
[[nodiscard]] Progress terminal_progress(const CommonOptions& options);
/// After a work that a signal has stopped, also if quiet: which signal it was, and where the best so far lies.
void say_stopped(const std::string& folder);
/// The same where nothing was found yet, but steps are done.
void say_steps_kept(const std::string& folder);
/// The same of a wheel, whose operations are a folder each.
void say_operations_kept(const std::string& folder);
/// The same where nothing is kept: "stopped by SIGTERM".
[[nodiscard]] std::string stopped_by();
/// For a command without a best so far: a signal ends it at once, with a line that says so. What it writes is whole or
/// not there, whenever that is.
void end_on_signals();

}  // namespace flank::cli
