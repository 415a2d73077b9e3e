/// Whether the text of a STEP file says what it seems to say.
#pragma once

#include <string>
#include <string_view>

namespace flank::internal {

/// Throws InputError, with the line, unless every instance of the data sections follows the grammar of ISO 10303-21 in
/// what a reader could otherwise take for something else: numbers are numbers as a whole (not 0x1p5, --3., nan) and
/// finite, no parameter is empty, values are separated by commas, lists and strings are closed. Readers of such files
/// take the beginning of a wrong number, or nothing, and say nothing.
void check_step_syntax(const std::string& file, std::string_view content);

}  // namespace flank::internal
