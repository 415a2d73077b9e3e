/// Who reads CAD files: this process, or a child of it (read_isolated.h), or a cache of what was read (part_cache.h).
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "flank/part.h"

namespace flank::internal {

/// A CAD file that is to be read.
struct CadFile {
  std::string name;
  std::string format;  ///< "STEP", "IGES", "BREP"
  std::optional<std::string> unit;
  std::string sha256;  ///< of its bytes when they were looked at
};

/// Throws InputError.
using CadReader = std::function<Part(const CadFile&)>;

/// The reader in force; read_cad in this process unless a program has set another one.
[[nodiscard]] const CadReader& cad_reader();
/// To be called at start-up, while nothing else of the library runs.
void set_cad_reader(CadReader reader);

}  // namespace flank::internal
