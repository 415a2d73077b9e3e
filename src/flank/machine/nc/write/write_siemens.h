/// Programs for Siemens 840D sl.
#pragma once

#include <string>

#include "flank/machine/nc/dialect.h"

namespace flank::internal {

/// As write_nc, for a program that passed its checks: TRAORI with rotary words or with the tool vector A3= B3= C3=,
/// ORIAXES or ORIVECT as the control shall join blocks; or joint coordinates without a transformation.
[[nodiscard]] std::string write_siemens(const NcProgram& program, const NcDialect& dialect);

}  // namespace flank::internal
