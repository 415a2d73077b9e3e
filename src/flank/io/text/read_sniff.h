/// What a file is, by its content; its name only has to agree.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flank::internal {

/// The three bytes with which some programs begin a text in UTF-8. They mean nothing.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// The whole file. Throws InputError for a missing file, a folder, an empty or an unreadable file.
[[nodiscard]] std::string read_bytes(const std::string& file);

/// STEP, IGES, BREP, STL, OBJ or PLY, by content. Throws InputError when the content is none of these, when the
/// extension is not one that is read, when the two disagree, and when the end of a STEP or IGES file is missing (a
/// truncated copy).
[[nodiscard]] std::string sniff_format(const std::string& file, std::string_view content);

/// True if the content has the size that a binary STL states for itself (80 bytes, a count, 50 bytes a facet).
[[nodiscard]] bool is_binary_stl(std::string_view content);

/// Ids in the file that a STEP file refers to and does not define; the mark of a file that lost a part of itself.
[[nodiscard]] std::vector<long> undefined_step_references(const std::string& content);

}  // namespace flank::internal
