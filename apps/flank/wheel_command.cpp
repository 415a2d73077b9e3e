// wheel.
#include "wheel_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>

#include "behind.h"
#include "flank/part.h"
#include "flank/printable.h"
#include "flank/run.h"
#include "flank/wheel/run_wheel.h"

namespace flank::cli {
using namespace internal;
namespace {

/// The program of the whole, for a machine; what it lacks is told, and is a reason.
struct WheelProgram {
  std::optional<std::string> machine;
  double feed_mm_min = 1000.0, spindle_rpm = 8000.0;
};

Acceptance post_whole(const WheelProgram& program, const WheelJob& job, bool quiet) {
  PostJob post;
  post.folder = job.folder;
  post.machine = *program.machine;
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

void add_roughing(CLI::App& app, WheelJob& job) {
  app.add_option("--blank", job.blank,
                 "The blank, a closed body that lies where the part does: " + part_formats() +
                     ". Default: a turned blank (a body of revolution) round the part")
      ->group("Roughing");
  app.add_option("--allowance", job.allowance_mm, "Stock of a turned blank over the part, mm")
      ->capture_default_str()
      ->group("Roughing");
  app.add_option("--engagement", job.most_engagement_deg,
                 "Largest engagement in the simulation of roughing, degrees; 180 allows slots")
      ->capture_default_str()
      ->group("Roughing");
}

void add_options(CLI::App& app, WheelJob& job, WheelProgram& program) {
  app.add_option("PART", job.part, part_formats() + " file")->required();
  app.add_option("--unit", job.unit, "Unit of a mesh, or of a CAD file that states a wrong one: mm, cm, m or in")
      ->check(CLI::IsMember({"mm", "cm", "m", "in"}));
  app.add_option("-o,--output", job.folder, "Folder for the results")->required();
  app.add_option("--tolerance", job.tolerance_mm, "Allowed deviation of the machined faces, both ways")
      ->capture_default_str();
  app.add_option("--coverage", job.least_coverage,
                 "Share of the accessible area of sides, edges, fillets and hub that must be within the tolerance")
      ->capture_default_str();
  app.add_option("--effort", job.effort, "How long each fit searches: quick, normal or thorough")
      ->capture_default_str();
  app.add_option("--tool", job.tool, "Tool file (tool.json). Default: found with the blades' sides");
  app.add_option("--sample", job.sample_mm,
                 "Fast check at this spacing, without the proof. Default: samples and a proof");
  app.add_flag_callback(
      "--no-edges", [&job] { job.edges = false; }, "Do not machine leading and trailing edges");
  app.add_flag_callback(
      "--no-rough", [&job] { job.rough = false; }, "Do not rough the channels");
  app.add_option("--most-tilt", job.most_tilt_deg,
                 "Largest angle between the tool and the wheel's axis on passes of the tip, degrees: as far as the "
                 "machine tilts the part")
      ->capture_default_str()
      ->group("Program");
  add_roughing(app, job);
  app.add_option("--hub", job.choice.hub, "Faces of the hub, as F1. Default: found")->group("Roles");
  app.add_option("--blade", job.choice.blades,
                 "Faces of a main blade, as F8,F9,F10; once for each blade. Default: found")
      ->allow_extra_args(false)
      ->group("Roles");
  app.add_option("--splitter", job.choice.splitters, "Faces of a splitter; once for each splitter. Default: found")
      ->allow_extra_args(false)
      ->group("Roles");
  app.add_option("--count", job.choice.count, "Number of equal sectors in a whole turn. Default: found")
      ->check(CLI::Range(1, 1000))
      ->group("Roles");
  app.add_option("--machine", program.machine, "Also write the program for this machine (flank machine --list)")
      ->group("Program");
  app.add_option("--feed", program.feed_mm_min, "Feed of the program, mm/min")->capture_default_str()->group("Program");
  app.add_option("--spindle", program.spindle_rpm, "Spindle speed of the program, 1/min")
      ->capture_default_str()
      ->group("Program");
}

}  // namespace

Subcommand add_wheel(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand(
      "wheel", "Mill a whole wheel: recognise its faces, plan one sector, copy it to the others, and check the whole");
  auto job = std::make_shared<WheelJob>();
  auto program = std::make_shared<WheelProgram>();
  add_options(*app, *job, *program);
  app->footer(
      "Example: flank example impeller -o wheel.step && flank wheel wheel.step --tolerance 0.05 -o out\nOperations "
      "that an earlier run into the same folder has finished are kept.");
  const auto run = [job, program](const CommonOptions& common) {
    const WheelResult result = run_wheel(*job, terminal_progress(common));
    Acceptance acceptance = result.acceptance();
    if (common.json)
      fmt::print("{}", plan_json(result));
    else if (!common.quiet)
      fmt::print("{}  written to  {}\n", printable(wheel_text(result), true), printable(job->folder));
    if (program->machine && result.whole) {
      const Acceptance posted = post_whole(*program, *job, common.quiet || common.json);
      acceptance.reasons.insert(acceptance.reasons.end(), posted.reasons.begin(), posted.reasons.end());
    }
    return exit_code(acceptance);
  };
  return {app,
          run,
          {{"unit", "--unit"},
           {"tolerance_mm", "--tolerance"},
           {"least_coverage", "--coverage"},
           {"effort", "--effort"},
           {"tool", "--tool"},
           {"hub", "--hub"},
           {"blade", "--blade"},
           {"count", "--count"},
           {"sample_mm", "--sample"},
           {"blank", "--blank"},
           {"allowance_mm", "--allowance"},
           {"most_engagement_deg", "--engagement"},
           {"most_tilt_deg", "--most-tilt"},
           {"machine", "--machine"}}};
}

}  // namespace flank::cli
