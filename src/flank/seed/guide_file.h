/// A start that the user gives as several lines (`--guide FILE`), as it stands in the file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "flank/seed/axis_line.h"

namespace flank::internal {

/// Lines in the order of the file. Each line of the file is "x y z x y z" in mm (commas or blanks; # starts a comment):
/// tip and holder end of one axis. Throws InputError naming the file and the line; at least two axes are needed.
[[nodiscard]] std::vector<AxisLine> read_guide(const std::string& file);
/// The same from a text; `file` is for messages.
[[nodiscard]] std::vector<AxisLine> parse_guide(const std::string& file, std::string_view text);

}  // namespace flank::internal
