// fit, cover, trochoid, verify: their options are the table of fields.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>

#include "behind.h"
#include "commands.h"
#include "flank/io/text/json_input.h"
#include "flank/pipeline/fit_defaults.h"
#include "flank/pipeline/folder/resume_folder.h"
#include "flank/pipeline/run_journal.h"
#include "flank/printable.h"
#include "flank/results/write_result.h"
#include "flank/run.h"
#include "job_options.h"

namespace flank::cli {
using namespace internal;
namespace {

struct Output {
  std::string folder;
  bool resume = false;  ///< go on where an earlier run was stopped
};

/// What was asked for is there already, and says what it said when it was made.
int say_finished(const ResultFolder& folder, const CommonOptions& common) {
  const bool meets = meets_request(folder);
  if (common.json)
    fmt::print("{}", read_file((std::filesystem::path(folder.path()) / "summary.json").string()));
  else if (!common.quiet)
    fmt::print("nothing to do: {} holds the complete result, which {}\n", printable(folder.path()),
               meets ? "meets the request" : "does NOT meet the request");
  return meets ? kMeetsRequest : kFallsShort;
}

/// Makes the folder and holds it, works, writes what came out, prints the summary. A folder that it made is removed if
/// the work is refused.
int run_into(const Output& output, const CommonOptions& common, const PlanJob& job,
             const std::function<Result(const Progress&)>& work) {
  const std::string& name = output.folder;
  const ReadFiles inputs = read_files(job);
  const Unwritten unwritten(inputs);
  ResultFolder folder(name, ResultFolder::Use::kWrite);
  folder.require_not_inputs(inputs);
  Progress progress = terminal_progress(common);
  if (output.resume && is_finished(folder, job, input_stamps(job))) return say_finished(folder, common);
  progress.journal = output.resume ? journal_of(folder) : std::make_shared<Journal>();
  Result result;
  try {
    result = work(progress);
  } catch (const Stopped&) {
    if (!write_steps(*progress.journal, job, folder)) throw;
    say_steps_kept(name);
    return kFallsShort;
  }
  write_result(result, folder);
  progress.step("done", 1.0);
  if (!result.complete) say_stopped(name);
  if (common.json)
    fmt::print("{}", summary_json(result));
  else if (!common.quiet)
    fmt::print("{}  written to  {}\n", printable(summary_text(result), true), printable(name));
  return exit_code(result.acceptance());
}

/// A command that makes a folder of results from a job. instead(job, common) may do something else, and is true then.
template <class Job>
Subcommand job_command(CLI::App* app, Result (*work)(const Job&, const Progress&),
                       const std::function<bool(const Job&, const CommonOptions&)>& instead = {}) {
  auto job = std::make_shared<Job>();
  auto output = std::make_shared<Output>();
  FlagNames names = add_job_options(*app, *job);
  app->add_option("-o,--output", output->folder, "Folder for the results")->required();
  app->add_flag("--resume", output->resume,
                "Continue a stopped run of the same command into this folder; the result is the same");
  const auto run = [job, output, work, instead](const CommonOptions& common) {
    if (instead && instead(*job, common)) return kMeetsRequest;
    return run_into(*output, common, *job, [&](const Progress& progress) { return work(*job, progress); });
  };
  return {app, run, std::move(names)};
}

}  // namespace

Subcommand add_fit(CLI::App& parser) {
  CLI::App* app =
      parser.add_subcommand("fit", "Find a tool and a motion that finish a face with the tool's flank, and check them");
  app->footer(
      "Example: flank example twisted-blade -o blade.step && flank fit blade.step --face F1 --tolerance 0.1 -o out\nA "
      "stopped run (Ctrl-C, SIGTERM, SIGHUP) continues with the same command and --resume.");
  auto dry = std::make_shared<bool>(false);
  const auto say_defaults = [dry](const FitJob& job, const CommonOptions& common) -> bool {
    if (!*dry) return false;
    end_on_signals();
    const FitDefaults defaults = fit_defaults(job);
    fmt::print("{}", common.json ? defaults_json(defaults) : printable(defaults_text(defaults), true));
    return true;
  };
  Subcommand command = job_command<FitJob>(app, run_fit, say_defaults);
  app->add_flag_callback(
      "--dry-run",
      [app, dry] {
        *dry = true;
        app->get_option("--output")->required(false);
      },
      "Do not search; print the side, tolerance, radii and accessible area that would be used");
  return command;
}

Subcommand add_cover(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand(
      "cover", "Find the passes with which a given or chosen tool finishes a face, and check them");
  app->footer(
      "Example: flank example twisted-blade -o blade.step && flank cover blade.step --face F1 --tool "
      "barrel:arc=100,radius=5 --axis-length 20 --tolerance 0.05 -o out\nThe best tool of the catalogue: flank cover "
      "blade.step --face F1 --tool catalogue --tolerance 0.05 -o out\nA stopped run continues with the same command "
      "and --resume.");
  return job_command<CoverJob>(app, run_cover);
}

Subcommand add_trochoid(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand(
      "trochoid", "Rough and finish the cavity between two sides with one tool, by trochoidal cycles");
  app->footer(
      "Example: flank example cavity-barrel -o cavity.step && flank trochoid cavity.step --left F1 --right F2 "
      "--tolerance 0.02 -o out\nA stopped run continues with the same command and --resume.");
  return job_command<TrochoidJob>(app, run_trochoid);
}

Subcommand add_verify(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand(
      "verify", "Check the tool and path of a folder, or an NC program, from tool, CL points and part alone");
  auto job = std::make_shared<VerifyJob>();
  FlagNames names = add_job_options(*app, *job);
  app->footer(
      "Example: flank example twisted-blade -o blade.step && flank fit blade.step --face F1 -o out --tolerance 0.1; "
      "flank verify out\n"
      "A program: flank post out --machine linuxcnc-xyzac-trt --spindle 8000 --feed 1000 -o part.ngc; flank verify out "
      "--nc part.ngc --machine "
      "linuxcnc-xyzac-trt");
  const auto run = [job](const CommonOptions& common) {
    end_on_signals();
    const Verification outcome = run_verify(*job);
    if (common.json)
      fmt::print("{}\n", verify_json(outcome));
    else if (!common.quiet)
      fmt::print("{}", printable(verify_text(outcome), true));
    return exit_code(outcome.acceptance);
  };
  return {app, run, std::move(names)};
}

}  // namespace flank::cli
