/// What a fit would take for what was not asked: told before anything is searched.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/job.h"
#include "flank/judge.h"

namespace flank::internal {

struct FitDefaults {
  std::string faces;  ///< "F1" or "F1,F2"
  double tolerance_mm = 0.0;
  double area_mm2 = 0.0, diagonal_mm = 0.0;  ///< of all faces; of the first target
  std::vector<SheetSide> sides;              ///< of sheets
  double radius_min_mm = 0.0, radius_max_mm = 0.0;
  /// Of the ball that says what is reachable; none: a given tool's own. Where other faces leave it no room, less is taken.
  std::optional<double> reach_radius_mm;
  std::optional<double> axis_length_mm;  ///< none: as the face needs
  double slenderness_max = 0.0, least_coverage = 0.0;
  std::vector<std::string> notes;
};

/// Reads the part and looks, but searches nothing. Throws as run_fit does.
[[nodiscard]] FitDefaults fit_defaults(const FitJob& job);

/// For people, and as JSON, schema "openflank/defaults/1"; lengths in mm.
[[nodiscard]] std::string defaults_text(const FitDefaults& defaults);
[[nodiscard]] std::string defaults_json(const FitDefaults& defaults);

}  // namespace flank::internal
