/// Programs for Fanuc 30i and 31i.
#pragma once

#include "flank/machine/nc/dialects/language_row.h"

namespace flank::internal {

extern const NcLanguageRow kFanucRow;

}  // namespace flank::internal
