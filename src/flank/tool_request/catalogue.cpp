#include "flank/tool_request/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "flank/base/shared_folder.h"
#include "flank/error.h"
#include "flank/tool_file.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::string catalogue_folder(const std::optional<std::string>& asked) {
  if (asked) {
    if (!is_folder(*asked)) throw InputError("catalogue", *asked, "no such folder; give a folder of tool files");
    return *asked;
  }
  return find_shared_folder({.name = "catalogue",
                             .variable = "FLANK_CATALOGUE",
                             .installed = FLANK_CATALOGUE_INSTALLED,
                             .content = "tool files",
                             .things = "tool catalogue",
                             .advice = "name its folder by `catalogue` or FLANK_CATALOGUE"});
}

std::vector<CatalogueTool> read_catalogue(const std::string& folder) {
  if (!is_folder(folder)) throw InputError(folder + ": no such folder; give a folder of tool files");
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (files.empty())
    throw InputError(folder + ": no tool file in this folder; expected NAME.json as flank tool writes them");
  std::sort(files.begin(), files.end());
  std::vector<CatalogueTool> tools;
  for (const fs::path& file : files) tools.push_back({file.stem().string(), read_tool(file.string())});
  return tools;
}

}  // namespace flank::internal
