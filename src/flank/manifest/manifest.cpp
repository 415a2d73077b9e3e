#include "flank/manifest/manifest.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "flank/base/file_name.h"
#include "flank/error.h"

namespace flank::internal {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* kSchema = "openflank/manifest/1";

Json to_json(const PartStamp& part) { return {{"file", text_of_name(part.file)}, {"sha256", part.sha256}}; }

/// Throws nlohmann::json::exception for another type.
PartStamp stamp_of(const Json& json) {
  return {name_of_text(json.at("file").get<std::string>()), json.at("sha256").get<std::string>()};
}

/// A hash that says nothing about bytes would make anything a file of a result.
std::string hash_of(const Json& json, const std::string& name) {
  constexpr std::size_t kDigits = 64;
  auto text = json.get<std::string>();
  if (text.size() != kDigits || text.find_first_not_of("0123456789abcdef") != std::string::npos)
    throw InputError("\"" + name + "\": expected 64 hexadecimal digits; if the file was edited, remove it");
  return text;
}

Manifest read(const Json& json) {
  Manifest manifest;
  if (json.at("schema").get<std::string>() != kSchema)
    throw InputError(std::string("expected schema \"") + kSchema + "\"");
  manifest.made_by = json.at("made_by").get<std::string>();
  manifest.folder = name_of_text(json.at("folder").get<std::string>());
  manifest.part = stamp_of(json.at("part"));
  manifest.judged = stamp_of(json.at("judged"));
  for (const auto& [name, hash] : json.at("files").items()) {
    if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos)
      throw InputError("\"" + name + "\" is not a name of a file in a folder");
    manifest.files[name] = hash_of(hash, name);
  }
  // Earlier versions wrote none.
  if (json.contains("inputs"))
    for (const Json& input : json.at("inputs")) {
      const std::string file = name_of_text(input.at("file").get<std::string>());
      manifest.inputs.push_back({file, hash_of(input.at("sha256"), file)});
    }
  return manifest;
}

}  // namespace

std::string manifest_to_json(const Manifest& manifest) {
  Json json = {{"schema", kSchema},
               {"made_by", manifest.made_by},
               {"folder", text_of_name(manifest.folder)},
               {"part", to_json(manifest.part)},
               {"judged", to_json(manifest.judged)},
               {"inputs", Json::array()},
               {"files", Json::object()}};
  for (const PartStamp& input : manifest.inputs) json["inputs"].push_back(to_json(input));
  for (const auto& [name, hash] : manifest.files) json["files"][name] = hash;
  return json.dump(2) + "\n";
}

Manifest manifest_from_json(std::string_view text, const std::string& file) {
  try {
    return read(Json::parse(text));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file + ": not a manifest: " + error.what());
  } catch (const InputError& error) {
    throw InputError(file + ": " + error.what());
  }
}

std::string moved_with(const Manifest& manifest, const std::string& folder, const std::string& named) {
  std::error_code error;
  const fs::path here = fs::absolute(folder, error).lexically_normal();
  const fs::path beside = fs::path(named).lexically_relative(manifest.folder);
  if (error || manifest.folder.empty() || beside.empty()) return named;
  const fs::path moved = (here / beside).lexically_normal();
  return fs::is_regular_file(moved, error) ? moved.string() : named;
}

}  // namespace flank::internal
