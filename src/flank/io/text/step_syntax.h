/// Whether the text of a STEP file says what it seems to say.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flank::internal {

/// The text in the one form that every reader of such files takes as it is meant: numbers with a point and a large E (not
/// 1e5, 1.D5 or 1E5), words in capitals, no comments, no byte order mark. Readers take the beginning of another number, or
/// another word, and say nothing. What stands in quotes, and the header, stay as they are.
///
/// Throws InputError, with the line, unless every instance of the data sections follows the grammar of ISO 10303-21 in
/// what a reader could otherwise take for something else: numbers are numbers as a whole (not 0x1p5, --3., nan) and
/// finite, no parameter is empty, values are separated by commas, lists and strings are closed, and no instance is
/// defined twice.
[[nodiscard]] std::string plain_step(const std::string& file, std::string_view content);

/// Ids in the file that a STEP file refers to and does not define; the mark of a file that lost a part of itself.
[[nodiscard]] std::vector<long> undefined_step_references(const std::string& content);

}  // namespace flank::internal
