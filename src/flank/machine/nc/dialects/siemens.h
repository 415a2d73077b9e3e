/// Programs for Siemens 840D sl.
#pragma once

#include "flank/machine/nc/dialects/language_row.h"

namespace flank::internal {

extern const NcLanguageRow kSiemensRow;

}  // namespace flank::internal
