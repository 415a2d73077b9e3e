/// [[body]] of a machine's file: outlines of its table and head (docs/schema/machine.md).
#pragma once

#include "flank/io/text/toml_table.h"
#include "flank/machine/model/machine.h"

namespace flank::internal {

/// The bodies of a file whose joints are already in `machine`. Throws InputError, naming line and column.
[[nodiscard]] std::vector<MachineBody> read_bodies(const TomlTable& file, const Machine& machine);

}  // namespace flank::internal
