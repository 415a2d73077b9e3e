/// path.json (docs/schema/path.md): poses as a file.
#pragma once

#include <string>
#include <string_view>

#include "flank/path.h"

namespace flank {

/// How far an axis vector in a file may be from unit length: within the first it is taken as it stands, within the
/// second it is normalised (files with rounded numbers), beyond it is refused.
inline constexpr double kAxisLengthExact = 1e-9;
inline constexpr double kAxisLengthRounded = 1e-3;

/// The whole file; numbers read back as the same doubles. Throws InternalError for numbers that are not finite.
[[nodiscard]] std::string path_to_json(const Path& path);

/// The path of a path.json's text; `file` is for messages. Throws InputError, naming file, strip and pose, for wrong
/// schema, unknown keys, numbers missing or not finite, axis vectors that are not of unit length, a strip without
/// poses, an id used twice.
[[nodiscard]] Path path_from_json(std::string_view text, const std::string& file);

/// The same for a file on disk.
[[nodiscard]] Path read_path(const std::string& file);

/// Writes the file whole or not at all. Throws InputError naming the file if it cannot be written.
void write_path(const Path& path, const std::string& file);

}  // namespace flank
