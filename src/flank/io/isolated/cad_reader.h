/// Who reads CAD files: this process, or a child of it (read_isolated.h).
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "flank/part.h"

namespace flank::internal {

/// file, format ("STEP", "IGES", "BREP"), unit -> part; throws InputError.
using CadReader = std::function<Part(const std::string&, const std::string&, const std::optional<std::string>&)>;

/// The reader in force; read_cad in this process unless a program has set another one.
[[nodiscard]] const CadReader& cad_reader();
/// To be called at start-up, while nothing else of the library runs.
void set_cad_reader(CadReader reader);

}  // namespace flank::internal
