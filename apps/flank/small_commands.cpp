// example, tool, fields.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "behind.h"
#include "commands.h"
#include "flank/example.h"
#include "flank/job/fields_json.h"
#include "flank/printable.h"
#include "flank/tool_command.h"

namespace flank::cli {
using namespace internal;

Subcommand add_example(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand("example", "Write an example part, with the exact solution where it is known");
  auto name = std::make_shared<std::string>();
  auto file = std::make_shared<std::string>();
  auto options = std::make_shared<ExampleOptions>();
  std::string names;
  for (const std::string& known : example_names()) names += (names.empty() ? "" : ", ") + known;
  app->add_option("NAME", *name, "One of: " + names)->required();
  app->add_option("-o,--output", *file, "File to write: .step for faces, .stl or another mesh file for meshes")
      ->required();
  app->add_option("--seed", options->seed, "Seed of the noise of noisy examples")->capture_default_str();
  CavityShape& cavity = options->cavity;
  app->add_option("--width", cavity.width_mm, "Width of the cavity, mm")->capture_default_str();
  app->add_option("--depth", cavity.depth_mm, "Depth of the cavity, mm")->capture_default_str();
  app->add_option("--length", cavity.length_mm, "Length of the cavity along its walls, mm")->capture_default_str();
  app->add_option("--twist", cavity.twist_deg, "Twist of the cavity's walls from end to end, degrees")
      ->capture_default_str();
  app->add_option("--lean", cavity.lean_deg, "Outward lean of the cavity's walls towards the top, degrees");
  app->add_option("--hollow", cavity.hollow_mm, "Hollow depth of the cavity's walls, mm")->capture_default_str();
  app->add_option("--blades", options->blades,
                  "Blades of rotor37-blisk: 2 to 33 on a piece of the hub, or 36, the whole wheel")
      ->capture_default_str();
  app->add_flag("--end-wall", cavity.end_wall, "A wall closes one end of the cavity, F3");
  app->add_flag("--start-wall", cavity.start_wall, "A wall closes the other end of the cavity, the next face");
  app->footer("Examples: flank example envelope-barrel-1 -o barrel.step; flank example rotor37 -o blade.step");
  return {app,
          [name, file, options](const CommonOptions& common) {
            require_no_result_there(*file);
            const Example example = make_example(*name, *options);
            const std::vector<std::string> written = write_example(example, *file);
            if (common.json) {
              fmt::print("{}", example_json(example, written));
            } else if (!common.quiet) {
              fmt::print("{}: {}\n", example.name, example.description);
              for (const std::string& path : written) fmt::print("  {}\n", printable(path));
            }
            return 0;
          },
          {}};
}

Subcommand add_tool(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand("tool", "Make, show and convert tools");
  auto options = std::make_shared<ToolCommandOptions>();
  auto show = std::make_shared<bool>(false);
  app->add_option(
         "SOURCE", options->source,
         "A family (" + tool_families() + "), a family with parameters (cone:radius=2,angle=3), or a tool.json or .dxf")
      ->required();
  app->add_option("--param", options->parameters, "Parameter of the family as NAME=VALUE; mm, degrees")
      ->allow_extra_args(false);
  app->add_option("--axis-length", options->axis_length_mm, "Length of the axis, mm");
  app->add_option("--shank-diameter", options->shank_diameter_mm, "Diameter of a plain shank above the flank, mm");
  app->add_option("--name", options->name, "Name of the tool");
  app->add_option("-o,--output", options->outputs, "Files to write: .json, .dxf, .step, .fctb, .svg, .csv")
      ->allow_extra_args(false);
  app->add_flag("--arcs", options->arcs, "Write the profile in a .dxf as tangent arcs and lines, within 0.001 mm");
  app->add_flag("--show", *show, "Draw the profile even when files are written");
  app->footer("Example: flank tool barrel --param arc=85 --param radius=5 --axis-length 30 -o tool.json -o tool.dxf");
  const auto run = [options, show](const CommonOptions& common) {
    for (const std::string& file : options->outputs) require_no_result_there(file);
    const Tool tool = run_tool_command(*options);
    if (common.json) {
      fmt::print("{}", tool_summary_json(tool, options->outputs));
      return kMeetsRequest;
    }
    if (options->outputs.empty() || *show) fmt::print("{}", tool_drawing(tool));
    if (!common.quiet)
      for (const std::string& file : options->outputs) fmt::print("wrote {}\n", printable(file));
    return kMeetsRequest;
  };
  return {app,
          run,
          {{"source", "tool"},
           {"param", "--param"},
           {"axis_length_mm", "--axis-length"},
           {"shank_diameter_mm", "--shank-diameter"},
           {"output", "-o"}}};
}

Subcommand add_fields(CLI::App& parser) {
  CLI::App* app =
      parser.add_subcommand("fields", "Print the options of a command as JSON, with units, ranges, defaults and help");
  auto command = std::make_shared<std::string>();
  app->add_option("COMMAND", *command, "fit, cover, trochoid, verify, post, design or wheel")->required();
  app->footer("Example: flank fields fit");
  return {app,
          [command](const CommonOptions&) {
            fmt::print("{}", fields_json(*command));
            return kMeetsRequest;
          },
          {{"command", "COMMAND"}}};
}

}  // namespace flank::cli
