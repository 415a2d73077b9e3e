/// Machines by name, as people and scripts read them; a program for one is run_post of run.h.
#pragma once

#include <string>
#include <vector>

namespace flank {

/// The machines that come with the library, sorted. Throws InputError where they are not found.
[[nodiscard]] std::vector<std::string> machine_names();

/// Its joints, limits and control as a table. `name_or_file`: one of machine_names(), or a file NAME.toml
/// (docs/schema/machine.md). Throws InputError, naming file, line and column, or the known machines.
[[nodiscard]] std::string machine_table(const std::string& name_or_file);
/// The same as JSON: schema "openflank/machine-summary/1"; mm, degrees, seconds. Throws likewise.
[[nodiscard]] std::string machine_json(const std::string& name_or_file);

/// Name, nesting and description of each of machine_names(), and as JSON. Throws InputError.
[[nodiscard]] std::string machine_list_table();
[[nodiscard]] std::string machine_list_json();

}  // namespace flank
