#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "commands.h"
#include "flank/pipeline/cover_job.h"

namespace flank::cli {
using namespace internal;
namespace {

/// The tool, and how it is chosen for --tool catalogue and families with open parameters.
void add_tool_options(CLI::App& app, CoverJob& job) {
  app.add_option(
         "--tool", job.base.tool,
         "A tool.json; a family with all its parameters (barrel:arc=85,radius=5) and --axis-length; a family "
         "with some or none (barrel, barrel:radius=5): the others are searched for this face; or catalogue: the "
         "best of a folder of tools")
      ->required();
  app.add_option(
      "--axis-length", job.base.axis_length_mm,
      "Length of the axis of a family, mm; where parameters are searched, default: the width of the face over 1, 2, 3 "
      "and 4 strips, all tried");
  const std::string group = "Choice of the tool";
  app.add_option(
         "--catalogue", job.catalogue,
         "Folder of tool files (NAME.json) for --tool catalogue; default: $FLANK_CATALOGUE, else the tools that "
         "come with flank (share/openflank/catalogue)")
      ->group(group);
  app.add_option("--finalists", job.finalists,
                 "Tools that are covered in full, strips smoothed; the others are compared by strips as they grow")
      ->capture_default_str()
      ->group(group);
  app.add_option("--feed", job.rates.feed_mm_min,
                 "Feed along the strips, mm/min, for the machining time in the ranking")
      ->capture_default_str()
      ->group(group);
  app.add_option("--rapid", job.rates.rapid_mm_min, "Rate between the strips, mm/min")
      ->capture_default_str()
      ->group(group);
}

}  // namespace

Subcommand add_cover(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand(
      "cover", "Find the strips with which a tool finishes a face, and judge them; the tool is given, or chosen");
  auto job = std::make_shared<CoverJob>();
  auto folder = std::make_shared<std::string>();
  auto side = std::make_shared<std::optional<std::string>>();
  app->add_option("PART", job->base.part, "STEP, IGES, BREP, STL, OBJ or PLY file")->required();
  app->add_option("--face", job->base.faces, "Faces to machine: F1 or F1,F3 (see flank inspect)")
      ->capture_default_str();
  add_tool_options(*app, *job);
  app->add_option("-o,--output", *folder, "Folder for the results")->required();
  app->add_option("--tolerance", job->base.tolerance_mm, "Tolerance, mm")->capture_default_str();
  app->add_option("--seeds", job->seeds,
                  "Where lines are begun: grid, spread evenly, or shape, more where the face bends more")
      ->capture_default_str();
  app->add_option("--strategy", job->strategy,
                  "How strips are found: grow, or curves (the published method, to compare)")
      ->capture_default_str();
  app->add_option("--strips", job->most_strips, "Most strips on one target; default: as many as are worth their price");
  app->add_option("--strip-price", job->strip_price,
                  "Share of the face that a strip must add to be worth it; default: 0.005");
  app->add_option("--side", *side, "Machined side of an open sheet, + or -; default: both are tried")
      ->check(CLI::IsMember({"+", "-"}));
  app->add_option("--coverage", job->base.least_coverage, "Share of the face within tolerance that counts as done")
      ->capture_default_str();
  app->add_option("--sample", job->base.sample_mm, "Spacing of the judge's samples, mm");
  add_clearance_options(*app, job->base.clearance);
  add_check_options(*app, job->base.check, job->base.reach_radius_mm);
  app->add_option("--unit", job->base.unit, "Unit of a mesh: mm, cm, m or in")
      ->check(CLI::IsMember({"mm", "cm", "m", "in"}));
  app->footer(
      "Example: flank example twisted-blade -o blade.step && flank cover blade.step --face F1 --tool "
      "barrel:arc=100,radius=5 --axis-length 20 --tolerance 0.05 -o out\n"
      "The best tool of the catalogue: flank cover blade.step --face F1 --tool catalogue --tolerance 0.05 -o out");
  return {app, [job, folder, side](const CommonOptions& common) {
            if (*side) job->base.side = **side == "-" ? -1 : +1;
            return run_job(job->base, *folder, common,
                           [&](const Progress& progress) { return run_cover(*job, progress); });
          }};
}

}  // namespace flank::cli
