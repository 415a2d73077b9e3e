/// A part of CAD faces as bytes, between two processes of one program. Not a file format: it changes with Part.
#pragma once

#include <string>
#include <string_view>

#include "flank/part.h"

namespace flank::internal {

/// All of a part without a mesh: faces with surfaces and trims, what was left out, notes, box. Numbers bit by bit.
[[nodiscard]] std::string encode_part(const Part& part);

/// The other way. Throws InternalError for bytes that encode_part did not write: counts beyond what is there, surfaces
/// and curves whose knots, poles and weights do not fit together.
[[nodiscard]] Part decode_part(std::string_view bytes);

}  // namespace flank::internal
