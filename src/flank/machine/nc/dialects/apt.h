/// Programs for APT: cutter-location files with the words of ISO 4343, for another postprocessor.
#pragma once

#include "flank/machine/nc/dialects/language_row.h"

namespace flank::internal {

extern const NcLanguageRow kAptRow;

}  // namespace flank::internal
