/// engagement.json (docs/schema/engagement.md): how much of the tool is engaged at each pose of a path.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "flank/path.h"
#include "flank/path/engaged_arcs.h"

namespace flank::internal {

/// The engagement angle of every pose of every strip, radians.
using PathEngagement = std::vector<std::vector<double>>;

/// The whole file, angles to 0.01 degrees, those of arcs to 0.1. Arcs without heights are not known and left out. Throws InternalError for
/// numbers that are not finite.
[[nodiscard]] std::string engagement_to_json(const PathEngagement& engagement, const PathArcs& arcs = {});

/// The angles of an engagement.json's text, one for each pose of `path`; `file` is for messages. Throws InputError, naming
/// file and place, for a wrong schema, unknown keys, and for strips or angles that are not those of the path.
[[nodiscard]] PathEngagement engagement_from_json(std::string_view text, const std::string& file, const Path& path);

/// The arcs of such a file, one list for each pose of `path`; without heights where it has none. Throws InputError as above, and for arcs
/// of rings that are none or that do not ascend.
[[nodiscard]] PathArcs arcs_from_json(std::string_view text, const std::string& file, const Path& path);

}  // namespace flank::internal
