/// A catalogue: a folder of tool files, e.g. those that makers sell (share/catalogue).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/tool.h"

namespace flank::internal {

/// A tool and where it comes from.
struct CatalogueTool {
  std::string name;  ///< the file's name without its ending
  Tool tool;
};

/// Folder of the catalogue: `asked`; else the environment variable FLANK_CATALOGUE; else share/openflank/catalogue
/// beside the running program's folder; else where it was installed to; else that of the source tree. What is asked for
/// and not there is an error, not passed over. Throws InputError that names what was tried.
[[nodiscard]] std::string catalogue_folder(const std::optional<std::string>& asked);

/// Every .json file of the folder, by name. Throws InputError for a folder that is missing or has none, and for a file
/// that is no tool, naming it.
[[nodiscard]] std::vector<CatalogueTool> read_catalogue(const std::string& folder);

}  // namespace flank::internal
