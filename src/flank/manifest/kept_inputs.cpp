#include "flank/manifest/kept_inputs.h"

#include <filesystem>

#include "flank/manifest/result_folder.h"

namespace flank::internal {

void require_inputs_kept(const ReadFiles& inputs, const std::string& folder, const std::vector<std::string>& own) {
  const auto keep = [&](const std::string& name) {
    inputs.require_not_written((std::filesystem::path(folder) / name).string());
  };
  for (const std::string& name : result_names()) keep(name);
  keep(kPageFile);
  for (const std::string& name : own) keep(name);
}

}  // namespace flank::internal
