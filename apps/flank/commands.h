/// The subcommands: each adds itself to the parser and returns what to run when it was chosen.
#pragma once

#include <CLI/App.hpp>
#include <functional>

#include "flank/pipeline/fit_job.h"
#include "flank/progress.h"
#include "flank/setup/check_faces.h"
#include "flank/setup/clearance_job.h"

namespace flank::cli {
using namespace internal;

/// Options that every command shares.
struct CommonOptions {
  bool json = false;
  bool quiet = false;
  int threads = 0;
  std::uint64_t seed = 1;
};

/// Runs the chosen command and returns the exit code.
using Command = std::function<int(const CommonOptions&)>;

/// A command line with its help text and what it does.
struct Subcommand {
  CLI::App* app;
  Command run;
};

[[nodiscard]] Subcommand add_inspect(CLI::App& parser);
[[nodiscard]] Subcommand add_example(CLI::App& parser);
[[nodiscard]] Subcommand add_tool(CLI::App& parser);
[[nodiscard]] Subcommand add_fit(CLI::App& parser);
[[nodiscard]] Subcommand add_cover(CLI::App& parser);
[[nodiscard]] Subcommand add_verify(CLI::App& parser);
[[nodiscard]] Subcommand add_report(CLI::App& parser);
[[nodiscard]] Subcommand add_view(CLI::App& parser);

/// Makes the folder, works, writes what came out, prints the summary; returns the exit code. A folder that it made is
/// removed where the work is refused.
[[nodiscard]] int run_job(const FitJob& job, const std::string& folder, const CommonOptions& common,
                          const std::function<FitOutcome(const Progress&)>& work);

/// --shank-radius, --shank-length, --holder, --fixture and --clearance.
void add_clearance_options(CLI::App& app, ClearanceJob& job);

/// --check-faces, --ignore-faces and --reach-radius.
void add_check_options(CLI::App& app, CheckFaceChoice& choice, std::optional<double>& reach_radius_mm);

/// A line on stderr that grows on a terminal, plain lines otherwise, nothing if quiet; cancelled by Ctrl-C.
[[nodiscard]] Progress terminal_progress(const CommonOptions& options);

}  // namespace flank::cli
