// report and view.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "behind.h"
#include "commands.h"
#include "flank/error.h"
#include "flank/io/text/json_dump.h"
#include "flank/printable.h"
#include "flank/report.h"

namespace flank::cli {
using namespace internal;
namespace {

struct ReportOptions {
  std::string folder;
  std::string html;  ///< empty: report.html in the folder
  std::string png;   ///< empty: no picture
  PictureOptions picture;
  std::string size = "1600x1000";
  std::string theme;
  [[nodiscard]] std::string page() const {
    return html.empty() ? (std::filesystem::path(folder) / kPageFile).string() : html;
  }
};

void add_page(CLI::App* app, ReportOptions& options) {
  app->add_option("DIR", options.folder, "A folder written by flank fit")->required();
  app->add_option("-o,--output", options.html, "Page to write. Default: report.html in DIR");
}

/// The files that were written, for people or for scripts.
int say(const std::vector<std::string>& written, const CommonOptions& common) {
  if (common.json) {
    nlohmann::ordered_json json = {{"schema", "openflank/report/1"}, {"files", written}};
    fmt::print("{}\n", dumped(json, 2));
  } else if (!common.quiet) {
    for (const std::string& file : written) fmt::print("{}\n", printable(file));
  }
  return 0;
}

/// "1600x1000" to the size of a window.
std::string read_size(const std::string& text, PictureOptions& picture) {
  // A third item means that something follows the numbers.
  char rest = '\0';
  const int count = std::sscanf(text.c_str(), "%dx%d%c", &picture.width, &picture.height, &rest);
  const bool sensible =
      count == 2 && std::min(picture.width, picture.height) >= 200 && std::max(picture.width, picture.height) <= 10000;
  return sensible ? "" : text + ": expected WIDTHxHEIGHT in pixels, each from 200 to 10000";
}

int report(ReportOptions& options, const CommonOptions& common) {
  // Before anything is computed: a page over tool.json would destroy what it shows.
  const ReadFiles inputs = inputs_of_folder(options.folder);
  const Unwritten unwritten(inputs);
  if (!options.png.empty()) {
    require_not_a_result(options.folder, options.png);
    require_no_result_there(options.png);
    inputs.require_not_written(options.png);
    if (is_same_file(options.png, options.page()))
      throw UsageError("png", options.png, "is the name of the page; give another one");
  }
  std::vector<std::string> written{write_report(options.folder, options.html)};
  // The page says so too, and is not green.
  if (!std::filesystem::exists(std::filesystem::path(options.folder) / kManifestFile))
    fmt::print(stderr, "flank: {}: no {}: the files may not belong together; run `flank verify`\n",
               printable(options.folder), kManifestFile);
  if (!options.png.empty()) {
    if (!options.theme.empty()) options.picture.fragment = "theme=" + options.theme;
    make_picture(written.front(), options.png, options.picture);
    written.push_back(options.png);
  }
  return say(written, common);
}

}  // namespace

Subcommand add_report(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand("report", "Write one HTML page of a result: part, error, moving tool, figures");
  auto options = std::make_shared<ReportOptions>();
  add_page(app, *options);
  app->add_option("--png", options->png, "Also make a picture of the page (needs Chromium)");
  app->add_option("--png-size", options->size, "Size of the picture, pixels")
      ->capture_default_str()
      ->check([options](const std::string& text) { return read_size(text, options->picture); });
  app->add_option("--theme", options->theme, "Theme of the picture: light or dark. Default: the system's setting")
      ->check(CLI::IsMember({"light", "dark"}));
  app->footer(
      "Example: flank example twisted-blade -o blade.step && flank fit blade.step --face F1 -o out --tolerance 0.1; "
      "flank report out");
  return {app, [options](const CommonOptions& common) { return report(*options, common); }, {{"png", "--png"}}};
}

Subcommand add_view(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand("view", "Write the page of a result and open it in the browser");
  auto options = std::make_shared<ReportOptions>();
  add_page(app, *options);
  app->footer(
      "Example: flank example twisted-blade -o blade.step && flank fit blade.step --face F1 -o out --tolerance 0.1; "
      "flank view out");
  return {app,
          [options](const CommonOptions& common) {
            const int code = report(*options, common);
            open_page(options->page());
            return code;
          },
          {}};
}

}  // namespace flank::cli
