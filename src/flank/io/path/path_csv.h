/// Poses as a table, for spreadsheets and scripts.
#pragma once

#include <string>
#include <string_view>

#include "flank/path.h"

namespace flank::internal {

/// One line a pose under the head "strip,kind,face,x,y,z,i,j,k" (mm, unit vector), RFC 4180 quotes where needed;
/// numbers read back as the same doubles.
[[nodiscard]] std::string path_to_csv(const Path& path);

/// The inverse. Lines of one strip stand together; a strip without poses cannot be told. Throws InputError naming file
/// and line.
[[nodiscard]] Path path_from_csv(std::string_view text, const std::string& file);

}  // namespace flank::internal
