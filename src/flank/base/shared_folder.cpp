#include "flank/base/shared_folder.h"

#include <cstdlib>
#include <filesystem>

#include "flank/base/own_code.h"
#include "flank/error.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

/// The nearest share/openflank/NAME above a file; empty: there is none.
std::string above(const fs::path& file, const char* name) {
  for (fs::path folder = file.parent_path(); !folder.empty(); folder = folder.parent_path()) {
    const fs::path found = folder / "share" / "openflank" / name;
    if (is_folder(found.string())) return found.string();
    if (folder == folder.parent_path()) break;
  }
  return {};
}

}  // namespace

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

std::string find_shared_folder(const SharedFolder& folder) {
  if (const char* wanted = std::getenv(folder.variable); wanted != nullptr && *wanted != '\0') {
    if (is_folder(wanted)) return wanted;
    throw InputError(std::string(folder.variable) + "=" + wanted + ": no such folder; give one of " + folder.content);
  }
  const fs::path code = own_code_file();
  const std::string found = above(code, folder.name);
  if (!found.empty()) return found;
  if (is_folder(folder.installed)) return folder.installed;
  throw InputError(std::string("no ") + folder.things + ": tried share/openflank/" + folder.name + " above " +
                   code.string() + ", " + folder.installed + "; " + folder.advice);
}

}  // namespace flank::internal
