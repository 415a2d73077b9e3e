/// An example as files.
#pragma once

#include <string>
#include <vector>

#include "flank/example/example.h"

namespace flank::internal {

/// Writes the part as `file`: faces as .step or .stp, a mesh under an ending of write_mesh.h (millimetres). Where the truth is
/// known, FILE.truth.json (rails, error), FILE.tool.json and FILE.path.json are written beside it, FILE without its
/// ending. Returns the names of the files written, the part first. Throws UsageError for an ending that does not suit,
/// InputError if writing fails.
std::vector<std::string> write_example(const Example& example, const std::string& file);

}  // namespace flank::internal
