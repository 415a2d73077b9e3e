/// Folders of data that come with the program: tools of the catalogue, machines.
#pragma once

#include <string>

namespace flank::internal {

struct SharedFolder {
  const char* name = "";       ///< below share/openflank: "machines"
  const char* variable = "";   ///< of the environment, which names another one: "FLANK_MACHINES"
  const char* installed = "";  ///< where it was installed
  const char* content = "";    ///< for messages: "machine files"
  const char* things = "";     ///< for messages: "machines"
  const char* advice = "";     ///< for messages: "name their folder by FLANK_MACHINES"
};

[[nodiscard]] bool is_folder(const std::string& path);

/// The first that is there: the one that the environment names (which must be there), the nearest share/openflank above the
/// file of the running code (program or shared library: an install tree may have been moved, and a build tree has its own),
/// where it was installed. Throws InputError.
[[nodiscard]] std::string find_shared_folder(const SharedFolder& folder);

}  // namespace flank::internal
