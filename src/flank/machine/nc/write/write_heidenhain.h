/// Programs for Heidenhain iTNC 530 and TNC 640 in their conversational language.
#pragma once

#include <span>
#include <string>

#include "flank/machine/nc/dialect.h"

namespace flank::internal {

/// As write_nc, for operations that passed its checks: L blocks with rotary words or LN blocks with the tool vector TX TY
/// TZ under M128 or FUNCTION TCPM. No inverse time, and no joint coordinates: it always compensates the tool's length.
[[nodiscard]] std::string write_heidenhain(std::span<const NcProgram> operations, const NcDialect& dialect);

}  // namespace flank::internal
