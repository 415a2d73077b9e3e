#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "commands.h"
#include "flank/pipeline/cover_job.h"

namespace flank {

Subcommand add_cover(CLI::App& parser) {
  CLI::App* app =
      parser.add_subcommand("cover", "Find the strips with which a given tool finishes a face, and judge them");
  auto job = std::make_shared<CoverJob>();
  auto folder = std::make_shared<std::string>();
  auto side = std::make_shared<std::optional<std::string>>();
  app->add_option("PART", job->base.part, "STEP, IGES, BREP, STL, OBJ or PLY file")->required();
  app->add_option("--face", job->base.faces, "Faces to machine: F1 or F1,F3 (see flank inspect)")
      ->capture_default_str();
  app->add_option("--tool", job->base.tool,
                  "A tool.json, or a family with all its parameters (barrel:arc=85,radius=5) and --axis-length")
      ->required();
  app->add_option("-o,--output", *folder, "Folder for the results")->required();
  app->add_option("--tolerance", job->base.tolerance_mm, "Tolerance, mm")->capture_default_str();
  app->add_option("--axis-length", job->base.axis_length_mm, "Length of the axis of a family, mm");
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
      "barrel:arc=100,radius=5 --axis-length 20 --tolerance 0.05 -o out");
  return {app, [job, folder, side](const CommonOptions& common) {
            if (*side) job->base.side = **side == "-" ? -1 : +1;
            return run_job(job->base, *folder, common,
                           [&](const Progress& progress) { return run_cover(*job, progress); });
          }};
}

}  // namespace flank
