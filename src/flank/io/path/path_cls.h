/// path.cls (docs/schema/cls.md): a path as an APT cutter-location file, with the words of ISO 4343.
#pragma once

#include <optional>
#include <string>

#include "flank/path.h"
#include "flank/tool.h"

namespace flank::internal {

struct ClsOptions {
  std::string part = "PART";  ///< after PARTNO
  std::string tool_file =
      "tool.json";      ///< the profile, named in PPRINT: CUTTER can only say the nearest standard shape
  int tool_number = 1;  ///< LOADTL
  std::optional<double> spindle_rpm = {};  ///< SPINDL; none: the file names none, and says so
  std::optional<double> feed_mm_min = {};  ///< FEDRAT along the strips, likewise
  double retract_mm = 50.0;  ///< every strip is entered and left along the tool's axis over this way; the move to the
                             ///< next strip is not planned
};

/// The nearest cutter of APT's seven parameters: a ball end of the radius r(0) under the straight line nearest to the
/// meridian.
struct NearestCutter {
  double diameter = 0.0;       ///< d: twice the radius where the side's line meets the plane through the control point
  double corner_radius = 0.0;  ///< r
  double side_angle = 0.0;     ///< b, radians
  double height = 0.0;         ///< h
  double error_mm = 0.0;       ///< largest distance between the meridian and the side's line
};
[[nodiscard]] NearestCutter nearest_cutter(const Tool& tool);

/// The whole file, lines of at most 72 characters (a strip of very many faces apart). GOTO is the pose: the centre of
/// the tip's sphere (s = 0) and the unit vector towards the holder; CUTTER's f = 0 says so. Numbers read back as the
/// same doubles. Throws UsageError for options that are not finite or <= 0.
[[nodiscard]] std::string path_to_cls(const Path& path, const Tool& tool, const ClsOptions& options = {});

}  // namespace flank::internal
