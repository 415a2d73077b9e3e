#include "flank/toolbox/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "flank/error.h"
#include "flank/tool_file.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

/// Beside the folder of the running program: an install tree may have been moved. Empty where the system does not tell.
fs::path beside_program() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path() : program.parent_path().parent_path() / "share" / "openflank" / "catalogue";
}

}  // namespace

std::string catalogue_folder(const std::optional<std::string>& asked) {
  if (asked) {
    if (!is_folder(*asked)) throw InputError("catalogue", *asked, "no such folder; one of tool files is needed");
    return *asked;
  }
  if (const char* wanted = std::getenv("FLANK_CATALOGUE"); wanted != nullptr && *wanted != '\0') {
    if (!is_folder(wanted))
      throw InputError(fmt::format("FLANK_CATALOGUE={}: no such folder; one of tool files is needed", wanted));
    return wanted;
  }
  const std::vector<fs::path> places = {beside_program(), FLANK_CATALOGUE_INSTALLED, FLANK_CATALOGUE_SOURCE};
  std::vector<std::string> tried;
  for (const fs::path& place : places) {
    if (place.empty()) continue;
    if (is_folder(place)) return place.string();
    tried.push_back(place.string());
  }
  throw InputError(fmt::format("no tool catalogue: tried {}; name its folder by `catalogue` or FLANK_CATALOGUE",
                               fmt::join(tried, ", ")));
}

std::vector<CatalogueTool> read_catalogue(const std::string& folder) {
  if (!is_folder(folder)) throw InputError(folder + ": no such folder; one of tool files is needed");
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (files.empty())
    throw InputError(folder + ": no tool file in this folder; NAME.json as flank tool writes is needed");
  std::sort(files.begin(), files.end());
  std::vector<CatalogueTool> tools;
  for (const fs::path& file : files) tools.push_back({file.stem().string(), read_tool(file.string())});
  return tools;
}

}  // namespace flank::internal
