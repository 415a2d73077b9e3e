// wheel.
#include "wheel_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>

#include "behind.h"
#include "flank/error.h"
#include "flank/part.h"
#include "flank/printable.h"
#include "flank/run.h"
#include "flank/wheel/run_wheel.h"
#include "job_options.h"

namespace flank::cli {
using namespace internal;
namespace {

/// The program of the whole, for a machine; what it lacks is told, and is a reason.
struct WheelProgram {
  double feed_mm_min = 1000.0, spindle_rpm = 8000.0;
};

Acceptance post_whole(const WheelProgram& program, const WheelRequest& job, bool quiet) {
  PostJob post;
  post.folder = job.folder;
  post.machine = *job.machine;
  post.feed_mm_min = program.feed_mm_min;
  post.spindle_rpm = program.spindle_rpm;
  const PostOutcome outcome = run_post(post);
  const std::string file = (std::filesystem::path(job.folder) / "program.ngc").string();
  if (outcome.acceptance.pass()) write_file(file, outcome.program);
  if (!quiet)
    fmt::print("{}  {} {}\n", printable(post_text(outcome), true),
               outcome.acceptance.pass() ? "written to " : "not written: ", printable(file));
  return outcome.acceptance;
}

/// What the table of fields has not.
void add_more(CLI::App& app, WheelRequest& job, WheelProgram& program) {
  app.add_option("-o,--output", job.folder, "Folder for the results")->required();
  const auto add_short = [&](const char* flag, bool& member, const char* help) {
    app.add_flag_callback(
        flag, [&member] { member = false; }, help);
  };
  add_short("--no-rough", job.rough, "As --rough off");
  add_short("--no-edges", job.edges, "As --edges off");
  app.add_option("--feed", program.feed_mm_min, "Feed of the program, mm/min")->capture_default_str()->group("Program");
  app.add_option("--spindle", program.spindle_rpm, "Spindle speed of the program, 1/min")
      ->capture_default_str()
      ->group("Program");
}

/// Its operations up to the end, or up to a signal: what is finished is kept.
std::optional<WheelResult> milled(const WheelRequest& job, const CommonOptions& common) {
  try {
    return run_wheel(job, terminal_progress(common));
  } catch (const Stopped&) {
    say_operations_kept(job.folder);
    return {};
  }
}

}  // namespace

Subcommand add_wheel(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand(
      "wheel", "Mill a whole wheel: recognise its faces, plan one sector, copy it to the others, and check the whole");
  auto job = std::make_shared<WheelRequest>();
  auto program = std::make_shared<WheelProgram>();
  FlagNames names = add_job_options(*app, *job);
  add_more(*app, *job, *program);
  app->footer(
      "Example: flank example impeller -o wheel.step && flank wheel wheel.step --tolerance 0.05 -o out\nOperations "
      "that an earlier run into the same folder has finished are kept.");
  const auto run = [job, program](const CommonOptions& common) {
    const std::optional<WheelResult> result = milled(*job, common);
    if (!result) return kFallsShort;
    Acceptance acceptance = result->acceptance();
    if (common.json)
      fmt::print("{}", plan_json(*result));
    else if (!common.quiet)
      fmt::print("{}  written to  {}\n", printable(wheel_text(*result), true), printable(job->folder));
    if (job->machine && result->whole) {
      const Acceptance posted = post_whole(*program, *job, common.quiet || common.json);
      acceptance.reasons.insert(acceptance.reasons.end(), posted.reasons.begin(), posted.reasons.end());
    }
    return exit_code(acceptance);
  };
  return {app, run, std::move(names)};
}

}  // namespace flank::cli
