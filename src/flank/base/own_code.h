/// The object that holds this code: the program, or a shared library in it, as a Python module is.
#pragma once

#include <filesystem>
#include <string>

namespace flank::internal {

/// Its file; empty where the system does not tell.
[[nodiscard]] std::filesystem::path own_code_file();

/// What tells one build of it from another, as hex digits: the id that the linker wrote into it, a hash of all that it holds, or, where
/// there is none, the hash of its file. The version alone does not: it stays while the code changes. Looked for once.
[[nodiscard]] const std::string& own_code_id();

}  // namespace flank::internal
