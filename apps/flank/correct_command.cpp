// correct.
#include "correct_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "flank/correct/run_correct.h"
#include "flank/printable.h"
#include "job_options.h"

namespace flank::cli {
using namespace internal;

Subcommand add_correct(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand(
      "correct", "Correct the motion for the tool as ground, or against the error of the face as cut");
  auto job = std::make_shared<CorrectJob>();
  auto folder = std::make_shared<std::string>();
  FlagNames names = add_job_options(*app, *job);
  app->add_option("-o,--output", *folder, "Folder for the new result")->required();
  app->footer(
      "Examples: flank correct out --profile ground.csv -o ground; flank correct out --measured points.csv -o "
      "corrected\nThe verdict is about the new motion. With --measured it is checked against the face with its error "
      "mirrored.");
  const auto run = [job, folder](const CommonOptions& common) {
    const Correction correction = run_correct(*job, *folder, terminal_progress(common));
    write_correction(correction, *folder);
    if (common.json)
      fmt::print("{}", correction_json(correction));
    else if (!common.quiet)
      fmt::print("{}  written to  {}\n", printable(correction_text(correction), true), printable(*folder));
    return exit_code(correction.result.acceptance());
  };
  return {app, run, std::move(names)};
}

}  // namespace flank::cli
