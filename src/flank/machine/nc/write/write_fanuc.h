/// Programs for Fanuc 30i and 31i.
#pragma once

#include <string>

#include "flank/machine/nc/dialect.h"

namespace flank::internal {

/// As write_nc, for a program that passed its checks: G43.4 with rotary words, G43.5 with the tool vector I J K on every
/// block, or joint coordinates without length compensation. G5.1 Q1 where a smoothing tolerance is given.
[[nodiscard]] std::string write_fanuc(const NcProgram& program, const NcDialect& dialect);

}  // namespace flank::internal
