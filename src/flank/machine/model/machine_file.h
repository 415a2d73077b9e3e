/// Machines as TOML files (docs/schema/machine.md).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flank/machine/model/machine.h"

namespace flank::internal {

/// The machine of a file's text; `file` is for messages. Throws InputError, naming file, line and column and what would
/// be accepted, for text that is no TOML, unknown keys, values out of range, and chains that cannot hold a tool at any
/// direction: not three linear joints that span space, not two rotary ones that are not parallel, a tool that turns about
/// itself.
[[nodiscard]] Machine machine_from_toml(std::string_view text, const std::string& file);

/// A machine that comes with the program, by name, or that of a file: what ends in ".toml" or holds a slash is a file.
/// Throws InputError naming the known machines for a name that is none.
[[nodiscard]] Machine read_machine(const std::string& name_or_file);

/// The file that read_machine reads for this name. Throws InputError where the program's machines are not found.
[[nodiscard]] std::string machine_file(const std::string& name_or_file);

/// The folder of machines: $FLANK_MACHINES, else share/openflank/machines beside the program, as installed, or in the
/// source tree. Throws InputError.
[[nodiscard]] std::string machine_folder();
/// Names of the machines in it, sorted.
[[nodiscard]] std::vector<std::string> machine_names();

}  // namespace flank::internal
