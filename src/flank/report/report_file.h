/// Whether a file is one that the page can show.
#pragma once

#include <string>
#include <string_view>

namespace flank::internal {

/// "view.json" has schema "openflank/view/1".
[[nodiscard]] std::string schema_of(const std::string& name);

/// Throws InputError, naming the file, unless the text is JSON of this schema whose lists, figures and verdicts are such.
void check_report_file(std::string_view text, const std::string& file, const std::string& schema);

}  // namespace flank::internal
