// inspect, example, tool, verify.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "flank/artefact/verify_json.h"
#include "flank/example/example.h"
#include "flank/example/example_write.h"
#include "flank/inspect/inspect.h"
#include "flank/inspect/inspect_text.h"
#include "flank/part.h"
#include "flank/pipeline/verify_job.h"
#include "flank/toolbox/tool_command.h"

namespace flank::cli {
using namespace internal;

Subcommand add_inspect(CLI::App& parser) {
  CLI::App* app =
      parser.add_subcommand("inspect", "List the faces of a part: type, area, size, curvature, trims, units");
  auto file = std::make_shared<std::string>();
  auto unit = std::make_shared<std::optional<std::string>>();
  app->add_option("PART", *file, "STEP, IGES, BREP, STL, OBJ or PLY file")->required();
  app->add_option("--unit", *unit, "Unit of a mesh: mm, cm, m or in")->check(CLI::IsMember({"mm", "cm", "m", "in"}));
  app->footer("Example: flank example twisted-blade -o blade.step && flank inspect blade.step");
  return {app, [file, unit](const CommonOptions& common) {
            const InspectReport report = inspect(read_part(*file, *unit));
            if (common.json)
              fmt::print("{}", inspect_to_json(report));
            else
              fmt::print("{}", to_table(report));
            return 0;
          }};
}

Subcommand add_example(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand(
      "example", "Write a part that the project generates itself, and its truth where it is known");
  auto name = std::make_shared<std::string>();
  auto file = std::make_shared<std::string>();
  std::string names;
  for (const std::string& known : example_names()) names += (names.empty() ? "" : ", ") + known;
  app->add_option("NAME", *name, "One of: " + names)->required();
  app->add_option("-o,--output", *file, "File to write: .step for faces, .stl, .obj or .ply for meshes")->required();
  app->footer(
      "Examples: flank example envelope-barrel-1 -o barrel.step; flank example rotor37 -o blade.step (a real "
      "compressor "
      "blade)");
  return {
      app, [name, file](const CommonOptions& common) {
        ExampleOptions options;
        options.seed = common.seed;
        const Example example = make_example(*name, options);
        const std::vector<std::string> written = write_example(example, *file);
        if (common.json) {
          nlohmann::ordered_json json = {{"schema", "openflank/example/1"}, {"name", example.name}, {"files", written}};
          fmt::print("{}\n", json.dump(2));
        } else if (!common.quiet) {
          fmt::print("{}: {}\n", example.name, example.description);
          for (const std::string& path : written) fmt::print("  {}\n", path);
        }
        return 0;
      }};
}

Subcommand add_tool(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand("tool", "Make, show and convert tools");
  auto options = std::make_shared<ToolCommandOptions>();
  app->add_option(
         "SOURCE", options->source,
         "A family (cylinder, cone, barrel, lens, tapered-barrel, hyperbolic, power), a family with parameters "
         "(cone:radius=2,angle=3), or a tool.json or .dxf")
      ->required();
  app->add_option("--param", options->parameters, "NAME=VALUE of the family; mm, degrees")->allow_extra_args(false);
  app->add_option("--axis-length", options->axis_length_mm, "Length of the axis, mm");
  app->add_option("--shank-diameter", options->shank_diameter_mm, "A plain shank above the flank, mm");
  app->add_option("--name", options->name, "Name of the tool");
  app->add_option("-o,--output", options->outputs, "Files to write: .json, .dxf, .step, .fctb, .svg, .csv")
      ->allow_extra_args(false);
  app->add_flag("--show", options->show, "Draw the profile also when files are written");
  app->footer("Example: flank tool barrel --param arc=85 --param radius=5 --axis-length 30 -o tool.json -o tool.dxf");
  return {app, [options](const CommonOptions& common) {
            options->json = common.json;
            options->quiet = common.quiet;
            return run_tool_command(*options, std::cout);
          }};
}

Subcommand add_verify(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand(
      "verify", "Judge the tool and the path that lie in a folder, from tool, poses and part alone");
  auto job = std::make_shared<VerifyJob>();
  app->add_option("DIR", job->folder, "A folder written by flank fit")->required();
  app->add_option("--part", job->part, "Judge against this part instead of the one named in job.json");
  app->add_option("--tolerance", job->tolerance_mm, "Tolerance, mm, instead of the job's");
  app->add_option("--sample", job->sample_mm, "Spacing of the samples, mm");
  add_check_options(*app, job->check, job->reach_radius_mm);
  add_clearance_options(*app, job->clearance);
  app->footer(
      "Example: flank example twisted-blade -o blade.step && flank fit blade.step --face F1 -o out --tolerance 0.1; "
      "flank verify out");
  return {app, [job](const CommonOptions& common) {
            const VerifyOutcome outcome = run_verify(*job);
            if (common.json)
              fmt::print("{}\n", verify_to_json(outcome.report, outcome.acceptance));
            else if (!common.quiet)
              fmt::print("{}", verify_text(outcome));
            return outcome.acceptance.exit_code();
          }};
}

}  // namespace flank::cli
