/// Programs as APT cutter-location files, with the words of ISO 4343: for another postprocessor.
#pragma once

#include <string>

#include "flank/machine/nc/dialect.h"

namespace flank::internal {

/// As write_nc, for a program that passed its checks: GOTO with the tool vector. No rotary axes, no inverse time.
[[nodiscard]] std::string write_apt(const NcProgram& program, const NcDialect& dialect);

}  // namespace flank::internal
