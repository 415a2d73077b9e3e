#include "studio_options.h"

#include <CLI/CLI.hpp>

#include "flank/part.h"

namespace flank::cli {

CLI::App* add_studio_words(CLI::App& parser, const std::shared_ptr<StudioWords>& words) {
  CLI::App* app =
      parser.add_subcommand("studio", "Open the studio in the browser: drop a part, click a face, run, check, post");
  internal::StudioOptions* options = &words->studio;
  options->folder = "flank-studio";
  app->add_option("PART", options->part, part_formats() + " file to open first");
  app->add_option("--unit", options->unit, "Unit of a mesh, or of a CAD file that states a wrong one: mm, cm, m or in")
      ->check(CLI::IsMember({"mm", "cm", "m", "in"}));
  app->add_option("-o,--output", options->folder, "Folder of parts and jobs; an earlier one is continued")
      ->capture_default_str();
  app->add_option("--port", options->port, "Port on 127.0.0.1; 0: any free port")
      ->capture_default_str()
      ->check(CLI::Range(0, 65535));
  app->add_flag("--browser,!--no-browser", words->open,
                "Open the page in the browser; --no-browser only prints its address");
  app->footer("Example: flank example twisted-blade -o blade.step && flank studio blade.step");
  return app;
}

}  // namespace flank::cli
