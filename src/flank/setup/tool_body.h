/// Shank and holder: from the user's words to profiles of the tool.
#pragma once

#include <string>
#include <vector>

#include "flank/job.h"
#include "flank/tool.h"

namespace flank::internal {

/// Throws UsageError for a radius without a length, for a clearance with nothing that could keep it (`tool`: the given
/// one, or nullptr), and both kinds of error for a holder that is no profile. Reads the holder's file; fixtures must exist.
void check_obstacles(const ObstacleRequest& request, const Tool* tool);

/// Puts the request's shank and holder on the tool, in the place of its own.
void equip_tool(const ObstacleRequest& request, Tool& tool);

/// Does the tool have anything above its flank?
[[nodiscard]] inline bool has_body(const Tool& tool) { return !tool.shank.empty() || !tool.holder.empty(); }

/// "30:10,70:12", or a file of such pairs, as points (z, radius), z above the flank's upper end. A file that counts from the
/// holder's own face (read_holder_file) is put with that at z = `face`, mm.
[[nodiscard]] std::vector<Vec2> holder_profile(const std::string& text, double face = 0.0);

/// The same with z above the holder's own face: its lowest point is at 0.
[[nodiscard]] std::vector<Vec2> holder_outline(const std::string& text);

}  // namespace flank::internal
