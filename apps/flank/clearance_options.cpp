// What fit and verify share: what stands above the flank, what it must not hit, and by how much.
#include <CLI/CLI.hpp>

#include "commands.h"

namespace flank::cli {
using namespace internal;

void add_clearance_options(CLI::App& app, ClearanceJob& job) {
  const std::string group = "Clearance";
  app.add_option("--shank-length", job.shank_length_mm, "A cylindrical shank above the flank, of this length, mm")
      ->group(group);
  CLI::Option* radius =
      app.add_option("--shank-radius", job.shank_radius_mm, "Its radius, mm; default: that of the flank's upper end")
          ->group(group);
  app.add_option_function<double>(
         "--shank-diameter", [&job](double diameter) { job.shank_radius_mm = 0.5 * diameter; }, "Its diameter, mm")
      ->group(group)
      ->excludes(radius);
  app.add_option(
         "--holder", job.holder,
         "Outline of the holder: z:r,z:r,... (z above the flank's upper end, radius, mm), or a file of such pairs")
      ->group(group);
  app.add_option("--fixture", job.fixtures,
                 "Part file that shank, holder and flank must not touch; may be given several times")
      ->group(group)
      ->allow_extra_args(false);
  app.add_option(
         "--clearance", job.required_mm,
         "Least distance of shank and holder from the part, and of all from fixtures, mm; default: no collision")
      ->group(group);
}

void add_check_options(CLI::App& app, CheckFaceChoice& choice, std::optional<double>& reach_radius_mm) {
  const std::string group = "Other faces";
  app.add_option("--check-faces", choice.only,
                 "The tool must not enter these faces, F88,F12; default: any face that is not machined. Entering one "
                 "by more than the tolerance is exit 1")
      ->group(group);
  app.add_option("--ignore-faces", choice.ignored, "It may enter these: they are not checked")->group(group);
  app.add_option("--reach-radius", reach_radius_mm,
                 "A place of the face counts as reachable where a ball of this radius touches it without entering "
                 "another face, mm; --coverage is about those; default: the tool's smallest radius")
      ->group(group);
}

}  // namespace flank::cli
