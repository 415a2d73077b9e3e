/// CAD files as parts.
#pragma once

#include <optional>
#include <string>

#include "flank/part.h"

namespace flank::internal {

/// Reads a STEP, IGES or BREP file. Throws InputError.
[[nodiscard]] Part read_cad(const std::string& file, const std::string& format, const std::optional<std::string>& unit);

}  // namespace flank::internal
