/// `flank studio`: a page in the user's browser, served to this machine alone (SECURITY.md). Everything that is computed is computed by a
/// child, the command itself; what there is lies in a folder.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace flank::internal {

struct StudioOptions {
  std::string folder;               ///< of parts and jobs; is made
  std::string part;                 ///< to begin with, a copy is taken; empty: none
  std::optional<std::string> unit;  ///< of that part
  int port = 0;                     ///< 0: any that is free
};

/// Serves until cancelled() is true. told(address) is called once the page can be opened. `program`: the command. What runs then is told
/// to stop and keeps its best. Throws UsageError if the program was built without the page; InputError if the folder
/// cannot be used, another studio has it, the part cannot be read, or the port is taken.
void run_studio(const StudioOptions& options, const std::string& program,
                const std::function<void(const std::string& address)>& told, const std::function<bool()>& cancelled);

}  // namespace flank::internal
