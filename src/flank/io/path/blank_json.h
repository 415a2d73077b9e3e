/// blank.json (docs/schema/blank.md): what is material before a program begins.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "flank/path/half_space.h"

namespace flank::internal {

/// The whole file; numbers read back as the same doubles. Throws InternalError for numbers that are not finite.
[[nodiscard]] std::string blank_to_json(const std::vector<HalfSpace>& blank);

/// The half spaces of a blank.json's text; `file` is for messages. Throws InputError, naming file and place, for a wrong
/// schema, unknown keys, numbers that are missing, and normals that are no unit vectors.
[[nodiscard]] std::vector<HalfSpace> blank_from_json(std::string_view text, const std::string& file);

}  // namespace flank::internal
