/// Programs for LinuxCNC.
#pragma once

#include "flank/machine/nc/dialects/language_row.h"

namespace flank::internal {

extern const NcLanguageRow kLinuxCncRow;

}  // namespace flank::internal
