/// How long a shank must be to reach out of a part.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/job.h"
#include "flank/judge.h"
#include "flank/tool.h"

namespace flank::internal {

/// Of a cylinder of this radius above the flank, mm: at every pose of the path its upper end, and so the face of any holder, is outside of
/// the part's box. 0 where the flank's own end always is.
[[nodiscard]] double shank_reach(const Tool& tool, const Path& path, const Box3& part, double radius_mm);

/// Diameters of h6 shanks that are held in stock, mm.
[[nodiscard]] const std::vector<double>& shank_diameters();

/// The largest of them that is below a flank's upper end by at most a tenth; none: the shank is as thick as the flank ends.
[[nodiscard]] std::optional<double> standard_shank(double flank_diameter_mm);

/// What was chosen for a tool, in words.
[[nodiscard]] std::string chosen_shank_text(const Tool& tool, const ObstacleRequest& chosen);

/// Radius (where it is not given) and length of a shank that reaches out of the part along the path, to whole millimetres and no shorter
/// than the request's.
void choose_shank(const Tool& tool, const Path& path, const Box3& part, ObstacleRequest& request);

}  // namespace flank::internal
