#include "flank/report/report_file.h"

#include <nlohmann/json.hpp>

#include "flank/error.h"

namespace flank::internal {
namespace {

/// Throws InputError unless the file states this schema.
void require_schema(const nlohmann::json& json, const std::string& file, const std::string& schema) {
  if (json.is_object() && json.contains("schema") && json["schema"] == schema) return;
  throw InputError(file + ": expected schema \"" + schema + "\"");
}

/// Files of lengths are in millimetres, those of angles or of several kinds say so themselves.
void require_units(const nlohmann::json& json, const std::string& file, const std::string& schema) {
  if (schema == schema_of("engagement.json") || schema == schema_of("motion.json") || !json.contains("units")) return;
  if (json["units"] != "mm") throw InputError(file + ": units: is " + json["units"].dump() + "; expected \"mm\"");
}

/// Throws InputError where the page would look for a list or a figure and find something else. Files by hand leave keys
/// out; texts are only shown.
void require_types(const nlohmann::json& json, const std::string& file) {
  const auto require = [&](const std::string& key, const char* type, bool right) {
    if (!right) throw InputError(file + ": " + key + ": expected " + type);
  };
  for (const auto& [key, value] : json.items()) {
    // In the other files, `faces` is a text and `strips` a number.
    const bool list = (key == "faces" && json["schema"] == schema_of("verify.json")) ||
                      (key == "strips" && json["schema"] == schema_of("view.json"));
    if (list || key == "bodies" || key == "joints" || key == "time_s" || key == "feed_mm_min" || key == "reasons" ||
        key == "worst_places")
      require(key, "a list", value.is_array());
    const bool text = (key == "faces" || key == "part") && json["schema"] == schema_of("view.json");
    if (text) require(key, "a text", value.is_string());
    if (key == "tolerance_mm" || key == "least_coverage")
      require(key, "a number", value.is_number() || value.is_null());
    if (key == "pass" || key == "within") require(key, "true or false", value.is_boolean());
  }
}

}  // namespace

std::string schema_of(const std::string& name) { return "openflank/" + name.substr(0, name.find('.')) + "/1"; }

void check_report_file(std::string_view text, const std::string& file, const std::string& schema) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) throw InputError(file + ": not JSON; give a file written by `flank fit`");
  require_schema(json, file, schema);
  require_units(json, file, schema);
  require_types(json, file);
}

}  // namespace flank::internal
