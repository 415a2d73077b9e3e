/// Programs for Heidenhain iTNC 530 and TNC 640, in their conversational language.
#pragma once

#include "flank/machine/nc/dialects/language_row.h"

namespace flank::internal {

extern const NcLanguageRow kHeidenhainRow;

}  // namespace flank::internal
