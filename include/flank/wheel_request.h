/// What can be asked of a whole wheel (wheel.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace flank {

/// What is asked of a wheel. Faces are lists as "F1,F3"; what is not given is found.
struct WheelRequest {
  std::string part;
  std::string folder;               ///< for the results; operations that are finished in it are not done again
  std::optional<std::string> unit;  ///< of a mesh: mm, cm, m or in
  double tolerance_mm = 0.05;
  double least_coverage = 0.97;       ///< share of what is open of the flow surface, within tolerance
  std::string effort = "quick";       ///< of the fits: quick, normal or thorough
  std::optional<std::string> tool;    ///< a tool.json, a family or "free"
  std::optional<std::string> holder;  ///< "z:r,z:r,...", z over its own face, or a file; none: not checked
  int most_tools = 2;                 ///< 1: the one that finishes roughs, too; 2: a larger one roughs where one fits
  std::optional<double> sample_mm;    ///< judge by samples alone; their spacing in the fits
  bool rough = true, edges = true;
  std::optional<std::string> blank;   ///< a closed body, CAD or mesh; none: turned about the part
  double allowance_mm = 0.5;          ///< of a turned blank, > 0
  double most_engagement_deg = 90.0;  ///< that roughing may have, in (0, 180]
  std::optional<double>
      balance;  ///< thicknesses by which roughing lets a blade stand free on one side alone, >= 1; none: any
  std::optional<std::string>
      machine;                   ///< a name or a file NAME.toml: no pass of the tip tilts the part further than it does
  double most_tilt_deg = 100.0;  ///< between the tool and the wheel's axis on passes of the tip, in (0, 180]
  std::optional<std::string> hub;
  std::vector<std::string> blades, splitters;  ///< one list a blade
  std::optional<int> count;                    ///< of equal sectors in a whole turn
  bool operator==(const WheelRequest&) const = default;
};

}  // namespace flank
