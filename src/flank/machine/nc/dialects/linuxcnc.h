/// Programs of LinuxCNC.
#pragma once

#include <string>
#include <string_view>

#include "flank/machine/nc/dialect.h"

namespace flank::internal {

/// As read_nc, for a text that was not recognised as one of another language.
[[nodiscard]] NcProgram read_linuxcnc(std::string_view text, const std::string& file, const NcDialect& dialect);

}  // namespace flank::internal
