/// NC programs read back.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "flank/machine/nc/dialect.h"

namespace flank::internal {

/// The program of a text: one of ours, or another's within the subset of docs/schema/nc.md. `file` is for messages.
/// Of the dialect only the language, `positions` and the words that switch tool-centre kinematics matter.
/// Throws InputError, naming file and line, for a word that is not of the subset, a position that is not stated, a
/// program without an end or without moves; a program of another dialect is named as such.
[[nodiscard]] NcProgram read_nc(std::string_view text, const std::string& file, const NcDialect& dialect);

/// The same of a program that may have several operations (NcHeader::operation), each as a program; read_nc refuses those. Nothing
/// that an operation states holds for the next one, but what a control would keep.
[[nodiscard]] std::vector<NcProgram> read_nc_operations(std::string_view text, const std::string& file,
                                                        const NcDialect& dialect);

}  // namespace flank::internal
