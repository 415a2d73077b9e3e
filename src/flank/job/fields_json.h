/// The table of fields of a command as JSON, for programs that draw forms of it (docs/schema/fields.md).
#pragma once

#include <string>
#include <vector>

namespace flank::internal {

/// Keys of the fields that most users of a command ask for beside part and faces, in the order of a form; the others are for those who
/// know what they want. Empty for a command that has none.
[[nodiscard]] const std::vector<std::string>& basic_fields(const std::string& command);

/// "quick", "normal" and "thorough" of "must be quick, normal or thorough"; empty for other sentences.
[[nodiscard]] std::vector<std::string> choices_of(const std::string& accepted);

/// Indented JSON, schema "openflank/fields/1": every field with name, option, unit, kind, group, default, help, what is accepted, and
/// whether it is basic. Throws UsageError as job_fields does.
[[nodiscard]] std::string fields_json(const std::string& command);

}  // namespace flank::internal
