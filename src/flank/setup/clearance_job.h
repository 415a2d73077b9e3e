/// Shank, holder, fixtures and the clearance they must keep: from the user's words to the judge's question.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/clearance.h"
#include "flank/part.h"
#include "flank/tool.h"

namespace flank::internal {

/// What the user asked for. Lengths in mm; heights count from the upper end of the flank.
struct ClearanceJob {
  std::optional<double> shank_radius_mm;  ///< none: that of the flank's upper end
  std::optional<double> shank_length_mm;  ///< a cylinder on the upper end of the flank
  std::optional<std::string> holder;      ///< "z:r,z:r,..." or a file of such pairs
  std::vector<std::string> fixtures;      ///< part files
  std::optional<double> required_mm;      ///< least clearance

  [[nodiscard]] bool any() const {
    return shank_radius_mm || shank_length_mm || holder || !fixtures.empty() || required_mm;
  }
};

/// Throws UsageError for lengths that are not > 0, a radius without a length, a requirement with nothing that could keep
/// it (`tool`: the given one, or nullptr), and both kinds of error for a holder that is no profile. Reads the holder's
/// file; fixtures must exist.
void check_clearance_job(const ClearanceJob& job, const Tool* tool);

/// Puts the job's shank and holder on the tool, in the place of its own.
void equip_tool(const ClearanceJob& job, Tool& tool);

/// The shape that the job asks for, as points (z, radius).
[[nodiscard]] std::vector<Vec2> holder_profile(const std::string& text);

/// Judges shank, holder and fixtures; an empty report where there are none. `target_faces` and `check_faces` are indices
/// into the part's faces: no other faces count; `unit` is that of fixtures that are meshes. Notes say what was done to
/// fixtures.
[[nodiscard]] ClearanceReport measure_clearance(const ClearanceJob& job, const Tool& tool, const Path& path,
                                                const Part& part, const std::vector<int>& target_faces,
                                                const std::vector<int>& check_faces,
                                                const std::optional<std::string>& unit, double tolerance_mm,
                                                std::vector<std::string>& notes);

/// One line a figure: "  shank       0.1230 mm from other faces (F88 at ...)".
[[nodiscard]] std::string clearance_text(const ClearanceReport& report);

}  // namespace flank::internal
