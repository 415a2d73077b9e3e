/// CAD files read in a child process, which a damaged file may bring down without harm to the program
/// (docs/decisions/0017-cad-files-in-a-child-process.md). A program that wants it begins with the first two functions.
#pragma once

#include <optional>

namespace flank {

/// To be called first of all: a process that was started to end with its parent does so from now on.
void end_with_parent();

/// The exit code of a process that was started to read a CAD file for another one of the same program, once it has done that; nothing
/// for any other process.
[[nodiscard]] std::optional<int> serve_as_cad_reader(int argc, const char* const* argv);

/// From now on read_part reads CAD files in children: this very program, started again. `limit_s`: seconds of processor time for a
/// file; none: by its size. `keep`: what took long to read is kept in the user's cache for the next process, unless the environment has
/// FLANK_CACHE=off (SECURITY.md). To be called at start-up, while nothing else of the library runs.
void read_cad_in_children(std::optional<double> limit_s = {}, bool keep = false);

}  // namespace flank
