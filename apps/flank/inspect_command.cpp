// inspect.
#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>

#include "behind.h"
#include "commands.h"
#include "flank/error.h"
#include "flank/feature/wheel_table.h"
#include "flank/inspect.h"
#include "flank/part.h"
#include "flank/part_page.h"
#include "flank/printable.h"
#include "flank/report.h"

namespace flank::cli {
using namespace internal;
namespace {

struct InspectOptions {
  std::string part;
  std::optional<std::string> unit;
  InspectOrder order;
  std::string html, png, view;  ///< files to write; empty: none
  [[nodiscard]] bool has_pictures() const { return !html.empty() || !png.empty() || !view.empty(); }
};

/// `inspect --wheel`: roles that are given, and where wheel.json goes.
struct WheelOptions {
  bool asked = false;
  WheelChoice choice;
  std::optional<std::string> output;
};

std::shared_ptr<WheelOptions> add_wheel_options(CLI::App& app) {
  auto wheel = std::make_shared<WheelOptions>();
  CLI::Option* asked = app.add_flag("--wheel", wheel->asked,
                                    "Name the faces of a wheel by role: hub, blades, sides, edges, tips, fillets");
  const auto add = [&](CLI::Option* option) { option->group("Wheel")->needs(asked); };
  add(app.add_option("--hub", wheel->choice.hub, "Faces of the hub, as F1. Default: found"));
  add(app.add_option("--blade", wheel->choice.blades,
                     "Faces of a main blade, as F8,F9,F10; once for each blade. Default: found")
          ->allow_extra_args(false));
  add(app.add_option("--splitter", wheel->choice.splitters,
                     "Faces of a splitter; once for each splitter. Default: found")
          ->allow_extra_args(false));
  add(app.add_option("--count", wheel->choice.count, "Number of equal sectors in a whole turn. Default: found")
          ->check(CLI::Range(1, 1000)));
  add(app.add_option("-o,--output", wheel->output, "File to write: wheel.json"));
  return wheel;
}

/// A page that only the browser sees, for a picture alone.
class PageForPicture {
 public:
  explicit PageForPicture(const std::string& page)
      : file_((std::filesystem::temp_directory_path() / fmt::format("flank-faces-{}.html", ::getpid())).string()) {
    write_file(file_, page);
  }
  ~PageForPicture() {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }
  PageForPicture(const PageForPicture&) = delete;
  PageForPicture& operator=(const PageForPicture&) = delete;
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  std::string file_;
};

/// None of them may be the part, or belong to a result.
void require_writable(const InspectOptions& options, const ReadFiles& inputs) {
  for (const std::string& file : {options.html, options.png, options.view}) {
    if (file.empty()) continue;
    require_no_result_there(file);
    inputs.require_not_written(file);
  }
  if (!options.png.empty() && (options.png == options.html || options.png == options.view))
    throw UsageError("png", options.png, "is the name of the page; give another one");
}

/// Page, picture and triangles; `wheel`: the text of a wheel.json, or empty.
void write_pictures(const InspectOptions& options, const Part& part, const InspectReport& report,
                    const std::string& wheel) {
  const std::string faces = faces_json(part, report, wheel);
  if (!options.view.empty()) write_file(options.view, faces);
  if (options.html.empty() && options.png.empty()) return;
  const std::string page = faces_page(faces);
  if (!options.html.empty()) write_file(options.html, page);
  if (!options.png.empty()) make_picture(PageForPicture(page).file(), options.png);
}

void print_files(const InspectOptions& options) {
  for (const std::string& file : {options.html, options.png, options.view})
    if (!file.empty()) fmt::print("{}\n", printable(file));
}

int inspect_wheel(const InspectOptions& options, const Part& part, const WheelOptions& wheel,
                  const CommonOptions& common) {
  if (wheel.output) require_no_result_there(*wheel.output);
  const WheelRoles roles = recognise_wheel(part, wheel.choice);
  if (wheel.output) write_file(*wheel.output, wheel_json(roles));
  if (options.has_pictures()) write_pictures(options, part, in_order(inspect(part), options.order), wheel_json(roles));
  if (common.json)
    fmt::print("{}", wheel_json(roles));
  else if (!common.quiet) {
    fmt::print("{}", printable(wheel_table(roles), true));
    print_files(options);
  }
  return kMeetsRequest;
}

int run_inspect(const InspectOptions& options, const WheelOptions& wheel, const CommonOptions& common) {
  ReadFiles inputs;
  inputs.add(options.part, "as the part");
  const Unwritten unwritten(inputs);
  require_writable(options, inputs);
  if (wheel.output) inputs.require_not_written(*wheel.output);
  const Part part = read_part(options.part, options.unit);
  if (wheel.asked) return inspect_wheel(options, part, wheel, common);
  const InspectReport report = in_order(inspect(part), options.order);
  if (options.has_pictures()) write_pictures(options, part, report, "");
  if (common.json)
    fmt::print("{}", inspect_json(report));
  else if (!common.quiet && !options.has_pictures())
    fmt::print("{}", printable(inspect_table(report), true));
  else if (!common.quiet)
    print_files(options);
  return kMeetsRequest;
}

}  // namespace

Subcommand add_inspect(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand(
      "inspect", "List the faces of a part with type, area, size, curvature and place, or draw them");
  auto options = std::make_shared<InspectOptions>();
  app->add_option("PART", options->part, part_formats() + " file")->required();
  app->add_option("--unit", options->unit, "Unit of a mesh, or of a CAD file that states a wrong one: mm, cm, m or in")
      ->check(CLI::IsMember({"mm", "cm", "m", "in"}));
  app->add_option("--sort", options->order.sort,
                  "Order of the faces: face, area (largest first), radius (tightest concave first) or type");
  app->add_option("--type", options->order.type, "Only faces of this type: plane, cylinder, B-spline, ...");
  app->add_option("--html", options->html,
                  "Write a page that shows the faces with their numbers; with --wheel in the colours of their roles");
  app->add_option("--png", options->png, "Write a picture of that page (needs Chromium)");
  app->add_option("--view", options->view, "Write the faces with their triangles as JSON (docs/schema/faces.md)");
  const auto wheel = add_wheel_options(*app);
  app->footer(
      "Example: flank example twisted-blade -o blade.step && flank inspect blade.step\n"
      "To see which face is which: flank inspect blade.step --html faces.html\n"
      "Of a wheel: flank example impeller -o wheel.step && flank inspect wheel.step --wheel --html wheel.html");
  return {app,
          [options, wheel](const CommonOptions& common) { return run_inspect(*options, *wheel, common); },
          {{"unit", "--unit"},
           {"sort", "--sort"},
           {"type", "--type"},
           {"png", "--png"},
           {"html", "--html"},
           {"hub", "--hub"},
           {"blade", "--blade"},
           {"count", "--count"}}};
}

}  // namespace flank::cli
