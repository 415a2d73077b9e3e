/// Cutter-location files of other programs, and our own, as paths.
#pragma once

#include <string>
#include <string_view>

#include "flank/path.h"

namespace flank::internal {

/// The strips of a cutter-location file: cutting moves, grouped by this project's PPRINT/STRIP lines or, in other
/// files, by RAPID. Moves under RAPID are links and left out unless their strip's kind is "link". UNITS/INCHES is
/// honoured; without MULTAX the axis is +z. Words that mean nothing here are skipped; motion that is not points
/// (CIRCLE, CYCLE, GODLTA, TRACUT, ...) is refused. Throws InputError naming file and line.
[[nodiscard]] Path path_from_cls(std::string_view text, const std::string& file);

}  // namespace flank::internal
