#include "flank/base/shared_folder.h"

#include <cstdlib>
#include <filesystem>

#include "flank/error.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

/// Empty where the system does not tell.
std::string beside_program(const char* name) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? std::string() : (program.parent_path().parent_path() / "share" / "openflank" / name).string();
}

}  // namespace

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

std::string find_shared_folder(const SharedFolder& folder) {
  if (const char* wanted = std::getenv(folder.variable); wanted != nullptr && *wanted != '\0') {
    if (is_folder(wanted)) return wanted;
    throw InputError(std::string(folder.variable) + "=" + wanted + ": no such folder; one of " + folder.content +
                     " is needed");
  }
  std::string tried;
  for (const std::string& place :
       {beside_program(folder.name), std::string(folder.installed), std::string(folder.source)}) {
    if (place.empty()) continue;
    if (is_folder(place)) return place;
    tried += (tried.empty() ? "" : ", ") + place;
  }
  throw InputError(std::string("no ") + folder.things + ": tried " + tried + "; " + folder.advice);
}

}  // namespace flank::internal
