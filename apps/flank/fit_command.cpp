#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>

#include "commands.h"
#include "flank/error.h"
#include "flank/job/job_json.h"
#include "flank/pipeline/fit_job.h"

namespace flank::cli {
using namespace internal;
namespace {

/// Texts that need more than a number.
struct FitTexts {
  std::string folder;
  std::string strips = "1";
  std::optional<std::string> side;
  std::string avoid = "on";
};

void read_texts(const FitTexts& texts, FitJob& job) {
  job.avoid = texts.avoid == "on";
  if (texts.side) job.side = *texts.side == "-" ? -1 : +1;
  if (texts.strips == "auto") {
    job.strips = 0;
    return;
  }
  char* end = nullptr;
  const long count = std::strtol(texts.strips.c_str(), &end, 10);
  if (texts.strips.empty() || *end != '\0' || count < 1 || count > 64)
    throw UsageError("--strips " + texts.strips + ": auto or a number from 1 to 64 is needed");
  job.strips = static_cast<int>(count);
}

}  // namespace

int run_job(const FitJob& job, const std::string& folder, const CommonOptions& common,
            const std::function<FitOutcome(const Progress&)>& work) {
  const bool existed = std::filesystem::exists(folder);
  ensure_folder(folder);
  try {
    const Progress progress = terminal_progress(common);
    const FitOutcome outcome = work(progress);
    write_fit(job, outcome, folder);
    progress.step("done", 1.0);
    if (common.json)
      fmt::print("{}", summary_json(job, outcome));
    else if (!common.quiet)
      fmt::print("{}  written to  {}\n", summary_text(job, outcome), folder);
    return outcome.acceptance(job).exit_code();
  } catch (...) {
    std::error_code ignored;
    if (!existed) std::filesystem::remove(folder, ignored);
    throw;
  }
}

Subcommand add_fit(CLI::App& parser) {
  CLI::App* app =
      parser.add_subcommand("fit", "Find a tool and a five-axis motion whose flank is the face, and judge them");
  auto job = std::make_shared<FitJob>();
  auto texts = std::make_shared<FitTexts>();
  app->add_option("PART", job->part, "STEP, IGES, BREP, STL, OBJ or PLY file")->required();
  app->add_option("--face", job->faces, "Faces to machine: F1 or F1,F3 (see flank inspect)")->capture_default_str();
  app->add_option("-o,--output", texts->folder, "Folder for the results")->required();
  app->add_option("--tool", job->tool,
                  "free, a family with any of its parameters (cone:radius=2,angle=3), or a tool.json")
      ->capture_default_str();
  app->add_option("--tolerance", job->tolerance_mm, "Tolerance, mm")->capture_default_str();
  app->add_option("--axis-length", job->axis_length_mm, "Length of the tool's axis, mm; default: as the face needs");
  app->add_option("--strips", texts->strips, "Passes side by side with one tool: a number, or auto")
      ->capture_default_str();
  app->add_option("--start", job->start, "First axis x,y,z,x,y,z (tip, holder end), mm; default: automatic");
  app->add_option("--guide", job->guide, "File of several such lines: the axis follows them");
  app->add_option("--side", texts->side,
                  "Machined side of an open sheet, + or -; default: of the start, else both are tried")
      ->check(CLI::IsMember({"+", "-"}));
  app->add_option("--radius-min", job->radius_min_mm,
                  "Smallest radius of a free tool (core), mm; default: 1 % of the face's diagonal");
  app->add_option("--radius-max", job->radius_max_mm,
                  "Largest radius of a free tool, mm; default: 15 % of the face's diagonal");
  app->add_option("--slope-max", job->slope_max, "Largest |r'| of a free tool")->capture_default_str();
  app->add_option("--coverage", job->least_coverage,
                  "Share of what is reachable of the face, within tolerance, that counts as done")
      ->capture_default_str();
  app->add_option("--sample", job->sample_mm, "Spacing of the judge's samples, mm");
  add_check_options(*app, job->check, job->reach_radius_mm);
  app->add_option("--avoid", texts->avoid,
                  "on: steer the tool clear of the other faces; off: fit as if they were not there (they are judged "
                  "all the same)")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str()
      ->group("Other faces");
  add_clearance_options(*app, job->clearance);
  app->add_option("--unit", job->unit, "Unit of a mesh: mm, cm, m or in")
      ->check(CLI::IsMember({"mm", "cm", "m", "in"}));
  app->footer(
      "Example: flank example twisted-blade -o blade.step && flank fit blade.step --face F1 --tolerance 0.1 -o out");
  return {app, [job, texts](const CommonOptions& common) {
            read_texts(*texts, *job);
            return run_job(*job, texts->folder, common,
                           [&](const Progress& progress) { return run_fit(*job, progress); });
          }};
}

}  // namespace flank::cli
