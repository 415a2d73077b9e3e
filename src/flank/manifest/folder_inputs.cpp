#include "flank/manifest/folder_inputs.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "flank/base/file_name.h"
#include "flank/base/rest_of.h"
#include "flank/error.h"
#include "flank/manifest/manifest.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return rest_of(stream);
}

std::optional<Manifest> manifest_of(const fs::path& folder) {
  try {
    return manifest_from_json(text_of(folder / kManifestFile), kManifestFile);
  } catch (const InputError&) {
    return {};
  }
}

/// Every text in it, at any depth: a field that is still to come is no exception.
template <class Use>
void for_each_text(const nlohmann::json& json, const Use& use) {
  if (json.is_string()) use(json.get<std::string>());
  if (json.is_structured())
    for (const nlohmann::json& item : json) for_each_text(item, use);
}

}  // namespace

ReadFiles inputs_of_folder(const std::string& folder) {
  const fs::path root = folder;
  const std::optional<Manifest> manifest = manifest_of(root);
  ReadFiles files;
  const auto add = [&](const std::string& named, const std::string& reader) {
    files.add(named, reader);
    // It may have moved with the folder, and then it is read there.
    if (manifest) files.add(moved_with(*manifest, folder, named), reader);
  };
  if (manifest) {
    add(manifest->part.file, "by the result in " + folder);
    add(manifest->judged.file, "by the verdict in " + folder);
    for (const PartStamp& input : manifest->inputs) add(input.file, "by the result in " + folder);
  }
  const auto job = nlohmann::json::parse(text_of(root / "job.json"), nullptr, false);
  for_each_text(job, [&](const std::string& text) { add(name_of_text(text), "by " + (root / "job.json").string()); });
  for (const char* name : {"job.json", "tool.json", "path.json", "blank.json"})
    files.add((root / name).string(), "as a file of the result");
  return files;
}

}  // namespace flank::internal
