/// What was measured, as files.
#pragma once

#include <string>
#include <vector>

#include "flank/vec.h"

namespace flank::internal {

/// Lines of numbers (commas, semicolons, tabs or blanks between them; # starts a comment; a first line of words is passed over), at
/// least `least` each. Throws InputError with file and line.
[[nodiscard]] std::vector<std::vector<double>> read_number_lines(const std::string& file, std::size_t least);

/// Points (z, radius), mm, of a .dxf or of lines. Throws InputError.
[[nodiscard]] std::vector<Vec2> read_profile_points(const std::string& file);

/// Points, mm, of lines x, y, z (more numbers on a line are passed over), or the vertices of a mesh. Throws InputError.
[[nodiscard]] std::vector<Vec3> read_measured_points(const std::string& file);

}  // namespace flank::internal
